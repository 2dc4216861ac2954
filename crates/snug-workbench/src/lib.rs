#![doc = include_str!("../README.md")]

mod bench;
mod campaign;
mod changes;
mod error;
mod focus;
mod groups;
mod guard;
mod kept;
mod look;
mod opening;
mod page;
mod results;
mod routes;
mod save;
mod server;
mod session;
mod told;

pub use bench::Bench;
pub use error::WorkbenchError;
pub use opening::{Notice, Opening, open};
pub use server::{Doors, serve};
