//! What was found out about the model itself: where it fails, what it lacks, and how the error falls.

pub(crate) mod became;
pub(crate) mod comparison;
pub(crate) mod drift;
pub(crate) mod experiment;
mod in_words;
pub(crate) mod location;
pub(crate) mod negative_control;
pub(crate) mod noise;
mod own_axis;
pub(crate) mod removal;
pub(crate) mod result;
pub(crate) mod rung;
pub(crate) mod summary;
pub(crate) mod verdict;
pub(crate) mod work;
