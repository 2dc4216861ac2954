//! A page on this machine where physical effects are switched on and off, and the error falls.
#![doc = include_str!("../README.md")]

mod bench;
mod campaign;
mod changes;
mod error;
mod kept;
mod opening;
mod page;
mod server;
mod session;
mod told;

pub use bench::Bench;
pub use error::WorkbenchError;
pub use opening::{Notice, Opening, open};
pub use server::{Doors, runtime, serve};
