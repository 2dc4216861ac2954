//! Thresholds of residuals and of restarts along the measured motion.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Samples that are whitened together: four registers of eight. Measured: of 16, 32 and 64 the fastest.
pub(crate) const SIDE_BY_SIDE: usize = 32;
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
