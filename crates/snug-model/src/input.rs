//! The torque between its samples, and before them.

mod position;
pub(crate) mod restart;
pub(crate) mod slope;
pub(crate) mod torque;
