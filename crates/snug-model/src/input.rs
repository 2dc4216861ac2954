//! The torque between its samples, and before them.

pub(crate) mod restart;
pub(crate) mod slope;
pub(crate) mod torque;
