//! What was found out about the model itself: where it fails, what it lacks, and how the error falls.

pub(crate) mod comparison;
pub(crate) mod location;
pub(crate) mod result;
pub(crate) mod rung;
pub(crate) mod summary;
