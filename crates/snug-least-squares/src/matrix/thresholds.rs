//! Thresholds of small dense matrices.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Pivots below this share of their diagonal are rounding \[–\]. Chosen.
pub(crate) const ROUNDING: f64 = 1e-10;
/// Rows from which wide registers pay. Chosen.
pub(crate) const LONG: usize = 256;
