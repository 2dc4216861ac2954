#![doc = include_str!("../README.md")]

mod error;
mod cases;
mod evaluation;
mod examples;
mod file_evaluation;
mod position;
mod progress;
mod run;
mod selection;
mod statistics;
mod study;

pub use error::StudyError;
pub use progress::ProgressEvent;
pub use run::{Outcome, RunSettings, run};
pub use selection::SelectionSettings;
pub use snug_preprocess::Preset;
pub use study::{Study, ValidationSettings};
#[doc(hidden)]
pub use cases::cases;
