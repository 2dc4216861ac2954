//! Thresholds of no room in particular.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Of every interval \[–\].
pub(crate) const CONFIDENCE: f64 = 0.95;
/// What keeps a strict inequality strict in floating point, in the parameter's own unit. Chosen.
pub(crate) const STRICT: f64 = 1e-9;
/// An interval narrower than this share of the value is rounding \[–\]: a constraint or fixed parameters hold the value there. Chosen.
pub(crate) const HELD_RATIO: f64 = 1e-6;
/// From one restart along the measured motion to the next \[s\]: enough for a law to show in the velocity. Chosen.
pub(crate) const RESTARTED_EVERY_S: f64 = 3e-3;
