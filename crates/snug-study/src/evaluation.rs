//! From files to results: one tightening, one file, with every rung of a ladder and what is kept for validation.

pub(crate) mod file;
pub(crate) mod prepared_file;
pub(crate) mod rungs;
pub(crate) mod tightening;
pub(crate) mod validation;
