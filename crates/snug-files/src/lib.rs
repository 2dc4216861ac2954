#![doc = include_str!("../README.md")]

mod disk;
mod error;
#[cfg(feature = "faults")]
pub mod fault;
mod identity;

pub use disk::{Disk, Host, Input, Output};
pub use error::{FilesError, remedy};
pub use identity::Identity;
