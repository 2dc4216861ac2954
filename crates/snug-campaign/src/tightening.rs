//! One tightening on its way from preparation to its result, and the factors by which tightenings form groups.

pub(crate) mod factor;
pub(crate) mod result;
pub(crate) mod validation;
