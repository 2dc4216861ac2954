//! Thresholds of the conic programs.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Relative rounding that is no violation of an inequality \[–\]. Chosen.
pub(crate) const NO_VIOLATION: f64 = 1e-12;
/// Newton steps before an active set is given up. Chosen.
pub(crate) const NEWTON_LIMIT: usize = 25;
/// Feasibility and stationarity, relative to the size of the step and of the gradient (both about 1) \[–\]. Chosen.
pub(crate) const TOLERANCE: f64 = 1e-11;
