//! What a simulation gives: measurement files as the thesis' layout has them, and the truth beside them.

pub(crate) mod campaign;
pub(crate) mod file;
pub(crate) mod layout;
pub(crate) mod mat5;
pub(crate) mod truth;
