//! Thresholds of residuals and of restarts along the measured motion.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Samples that are whitened together. Chosen: four registers of eight. With sums that went through the cache lag by lag whitening was
/// a sixth of `improve`, with these it is a twentieth.
pub(crate) const WHITENED_AT_ONCE: usize = 32;
/// Fewest samples from one restart to the next. Chosen.
pub(crate) const FEWEST_APART: usize = 8;
/// Fewest samples on either side that a cubic is fitted to: with the middle one, one more than it has coefficients.
pub(crate) const LEAST_HALF_WIDTH: usize = 2;
/// Places at which a measurement is looked at. Chosen.
pub(crate) const PLACES: usize = 400;
/// Growth of the residual's spread up to which a wider cubic still describes the measurement as well \[–\]. Chosen.
pub(crate) const AS_WELL: f64 = 1.1;
/// From one restart along the measured motion to the next \[s\], on a hand: enough for a law to show in the velocity. Chosen.
pub(crate) const RESTARTED_EVERY_S: f64 = 3e-3;
