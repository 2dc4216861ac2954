#![doc = include_str!("../README.md")]

mod diagnosis;
mod error;
mod estimate;
mod finding;
mod layout;
mod measurement;
pub mod read;
mod recorder;
mod recover;
mod schema;
mod settings;
mod shape;
mod signals;
mod statistics;
pub mod topic;
mod until_failure;
mod window;
mod wire;

pub use error::RecordError;
pub use layout::layout;
pub use recorder::Recorder;
pub use recover::{LeftOut, Recovery, recover, recover_within};
pub use settings::{Compression, RecordSettings, Samples};
pub use window::Window;

#[cfg(test)]
mod tests;
