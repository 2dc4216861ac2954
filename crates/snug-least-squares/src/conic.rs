//! Convex constraints, and the conic programs that steps over them are.

pub(crate) mod active_set;
pub(crate) mod constraints;
pub(crate) mod inequalities;
pub(crate) mod interior_point;
pub(crate) mod program;
pub(crate) mod solution;
pub(crate) mod thresholds;
