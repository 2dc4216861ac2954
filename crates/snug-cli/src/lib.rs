//! Snug's command line: the program `snug`, and its verbs for another front program.
#![doc = include_str!("../README.md")]

mod arguments;
mod diagnosis_summary;
mod effect_names;
mod embedded;
mod error;
mod estimates;
pub mod exit;
mod front;
mod logging;
mod progress;
mod signals;
mod summary;
mod terminal;
mod verbs;

pub use arguments::{ChangeOptions, PresetName, RunOptions, WorkbenchOptions};
pub use embedded::campaign;
pub use error::CliError;
pub use front::{Front, Notify};
pub use terminal::{complain, say};
pub use verbs::{Verb, refused, study};
