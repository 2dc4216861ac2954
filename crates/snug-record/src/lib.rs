//! A campaign as an MCAP recording, numeric channels of any MCAP back, and cut recordings made whole.
#![doc = include_str!("../README.md")]

mod encoding;
mod error;
mod layout;
mod messages;
pub mod read;
mod recorder;
mod recover;
mod settings;
pub mod topic;

pub use error::RecordError;
pub use layout::layout;
pub use messages::window::Window;
pub use recorder::Recorder;
pub use recover::{LeftOut, Recovery, recover, recover_within};
pub use settings::{Compression, RecordSettings, Samples};

#[cfg(test)]
mod tests;
