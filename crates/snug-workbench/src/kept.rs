//! What was worked out and may be asked for again, by the models it is of.

pub(crate) mod fits;
pub(crate) mod looks;
pub(crate) mod results;
