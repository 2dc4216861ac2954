//! Thresholds of what the data determine.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// A parameter that moves by less than this share along every free direction is blocked \[–\]. Chosen.
pub(crate) const BLOCKED: f64 = 1e-8;
/// A parameter with at least this share in an undetermined direction is not determined \[–\]. Chosen.
pub(crate) const UNDETERMINED: f64 = 1e-6;
/// Share of an estimate's information that one sample of thousands may hold in a motion without jumps \[–\]. Chosen.
pub(crate) const MOST_LEVERAGE: f64 = 0.01;
