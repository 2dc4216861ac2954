//! Thresholds of linearisations.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Relative rank tolerance when R comes from a factorisation of J itself \[–\]. Chosen.
pub(crate) const FACTORED_RANK_TOLERANCE: f64 = 1e-11;
/// The same when R comes from JᵀJ, whose rounding is the square root of that \[–\]. Chosen.
pub(crate) const NORMAL_RANK_TOLERANCE: f64 = 1e-7;
/// Part of a step over which its second derivative is measured \[–\] (Transtrum & Sethna: h = 0.1).
pub(crate) const PROBE_SHARE: f64 = 0.1;
