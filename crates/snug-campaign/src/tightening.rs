//! One tightening on its way from preparation to its result, and the factors by which tightenings form groups.

pub(crate) mod correction;
pub(crate) mod factor;
pub(crate) mod id;
pub(crate) mod level;
pub(crate) mod measures;
pub(crate) mod prepared;
pub(crate) mod result;
pub(crate) mod selection;
pub(crate) mod target_torque;
pub(crate) mod traces;
pub(crate) mod validation;
