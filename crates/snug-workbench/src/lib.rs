#![doc = include_str!("../README.md")]

mod bench;
mod campaign;
mod changes;
mod error;
mod fits;
mod guard;
mod page;
mod routes;
mod save;
mod server;
mod session;
mod told;

pub use bench::Bench;
pub use error::WorkbenchError;
pub use server::{Doors, serve};
