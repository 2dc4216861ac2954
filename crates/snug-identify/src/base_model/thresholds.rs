//! Threshold of fits in sweeps.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Column-scaled condition of J up to which JᵀJ gives the covariance to eight digits \[–\]: 10⁻¹⁶ · (10⁴)². A fit beyond it, or one
/// that does not converge, is done again with J factored by reflections.
pub(crate) const CLEAR: f64 = 1e4;
