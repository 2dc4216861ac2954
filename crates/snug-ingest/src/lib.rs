#![doc = include_str!("../README.md")]

mod channels;
mod condition_pattern;
pub mod csv;
pub mod declared;
mod error;
mod file_name;
mod finding_log;
mod ingested;
mod layout;
pub mod mat;
pub mod mcap;
mod memory;
mod range;
mod sampling;
mod signal;
mod signal_units;
mod source;
pub mod survey;
mod thesis_layout;

pub use condition_pattern::{ConditionPattern, Template};
pub use error::IngestError;
pub use ingested::Ingested;
pub use range::Range;
pub use signal::{Signal, Unit};
pub use source::{Format, Listing, Source, list, list_on, read, read_on};
pub use thesis_layout::ThesisLayout;
