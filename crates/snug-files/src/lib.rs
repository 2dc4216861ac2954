//! The door to the disk: a folder that holds one run's results, whole, whatever happens to run or disk.
#![doc = include_str!("../README.md")]

mod apart;
mod digest;
mod disk;
mod error;
pub mod fault;
mod identity;
mod journal;
mod lock;
mod manifest;
mod results;
mod whole_file;

pub use apart::{Inputs, keep_apart};
pub use disk::{Disk, Host, Input, Output};
pub use error::{FilesError, remedy};
pub use identity::Identity;
pub use lock::{Lock, Waiting};
pub use results::{Exchanged, Growing, Results};
pub use whole_file::{WholeFile, write_new, write_whole};

#[cfg(test)]
mod tests;
