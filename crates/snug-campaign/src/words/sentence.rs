//! Sentences as data: a program reads the numbers, files hold the text.

mod said;

pub mod changes;
pub mod explained;
pub mod headline;
pub mod reason;
pub mod remark;
pub mod restarted;
pub mod statement;
pub mod stopped;
pub mod suspicion;
