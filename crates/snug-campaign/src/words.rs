//! How results are said: numbers, sizes, chances, verdicts and their reasons, for someone who knows nutrunners, not
//! statistics. Terminal, report, recording and verdict.json take their words from here.

pub(crate) mod excerpt;
mod grammar;
mod group_size;
pub(crate) mod likely_name;
mod over_time;
pub(crate) mod sentence;

pub mod chance;
pub mod effect_name;
pub mod groups;
pub mod number;
pub mod program;
pub mod size;
pub mod vocabulary;

pub use grammar::{capitalised, counted, joined};
pub use sentence::{
    changes, explained, headline, reason, remark, restarted, statement, stopped, suspicion,
};
