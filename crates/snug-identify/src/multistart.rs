//! Fits from several starts where a cost has more than one minimum.

pub(crate) mod decimated;
pub(crate) mod early_stopping;
pub(crate) mod integral_start;
pub(crate) mod multiple_shooting;
pub(crate) mod search;
pub(crate) mod smoothing;
pub(crate) mod thresholds;
