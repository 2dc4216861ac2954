//! The torque between its samples, and before them.

mod grid;
mod position;
pub(crate) mod restart;
mod restarted;
pub(crate) mod slope;
pub(crate) mod torque;
