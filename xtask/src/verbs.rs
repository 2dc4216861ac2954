//! One file per verb.

mod bench;
mod effects;
mod fixtures;
mod run;
mod test;

pub use bench::bench;
pub use effects::effects;
pub use fixtures::fixtures;
pub use run::run;
pub use test::test;
