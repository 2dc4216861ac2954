//! Levenberg–Marquardt over a convex set: linearise, optimality, step, trial, accept.

pub(crate) mod damping;
pub(crate) mod fit;
pub(crate) mod levenberg_marquardt;
pub(crate) mod plain_multistart;
pub(crate) mod settings;
pub(crate) mod solve;
pub(crate) mod step;
pub(crate) mod thresholds;
