//! What all tightenings say together.

pub(crate) mod result;
