//! The parts of a study file that are of this crate alone.

pub(crate) mod diagnosis;
pub(crate) mod selection;
pub(crate) mod validation;
