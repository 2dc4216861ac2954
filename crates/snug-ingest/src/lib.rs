//! Measurement files to recordings in SI units, and findings about what had to be left out or repaired.
#![doc = include_str!("../README.md")]

pub mod csv;
pub mod declared;
mod error;
mod file;
mod layout;
pub mod mat;
pub mod mcap;
mod memory;
mod recording;
mod signal;
mod source;
pub mod survey;
mod thesis_layout;
mod unit;

pub use error::IngestError;
pub use file::ingested::Ingested;
pub use recording::condition_pattern::{ConditionPattern, Template};
pub use recording::range::Range;
pub use signal::Signal;
pub use source::{Format, Listing, Source, list, list_on, read, read_on};
pub use thesis_layout::ThesisLayout;
pub use unit::Unit;
