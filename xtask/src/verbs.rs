//! One file per verb.

mod bench;
mod diagnose;
mod effects;
mod fixtures;
mod fuzz;
mod recover;
mod run;
mod test;
mod tidy;

pub use bench::bench;
pub use diagnose::{diagnose, remove};
pub use effects::effects;
pub use fixtures::fixtures;
pub use fuzz::fuzz;
pub use recover::recover;
pub use run::run;
pub use test::test;
pub use tidy::tidy;
