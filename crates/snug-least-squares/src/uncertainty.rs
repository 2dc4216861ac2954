//! Covariance and identifiability of what was fitted.

pub(crate) mod covariance;
pub(crate) mod identifiability;
pub(crate) mod leverage;
pub(crate) mod thresholds;
