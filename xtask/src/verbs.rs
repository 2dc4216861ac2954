//! One file per verb.

mod bench;
mod diagnose;
mod effects;
mod fixtures;
mod run;
mod test;
mod tidy;

pub use bench::bench;
pub use diagnose::{diagnose, remove};
pub use effects::effects;
pub use fixtures::fixtures;
pub use run::run;
pub use test::test;
pub use tidy::tidy;
