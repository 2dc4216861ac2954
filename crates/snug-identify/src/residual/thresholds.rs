//! Thresholds of residuals and of restarts along the measured motion.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Samples that are whitened together. Chosen: four registers of eight. With sums that went through the cache lag by lag whitening was
/// a sixth of `improve`, with these it is a twentieth.
pub(crate) const WHITENED_AT_ONCE: usize = 32;
/// Fewest samples from one restart to the next \[samples\]. Chosen.
pub const FEWEST_APART: usize = 8;
/// Fewest samples on either side that a cubic is fitted to: with the middle one, one more than it has coefficients.
pub(crate) const LEAST_HALF_WIDTH: usize = 2;
/// Share of the restarts that says how much the motion bends otherwise than a cubic \[–\]. Chosen: of what rests at its goals more move, of a
/// sensor that slips less.
pub(crate) const MOST_RESTARTS: f64 = 0.95;
/// Variance that an error of the motion taken up may have on the way to the next restart, over that at the restart \[–\]. Chosen: of an armature near a
/// magnet whose errors grow e times as large on the way, the limit of 22 N of an amplifier was 21.81 N with 1 and 21.90 N with 4; where there are
/// ten samples only from one restart to the next, 4 takes 7 % off the noise.
pub(crate) const GROWN: f64 = 4.0;
/// Mean square of the smallest 95 % of a standard normal variable \[–\]: 1 − 2 z φ(z) / 0.95 with z = 1.96.
pub(crate) const MOST_OF_NORMAL: f64 = 0.7588;
/// Share of a motion's power that the cubics may leave from which it is taken up, beyond what those over the fewest samples do \[–\]. Chosen.
pub(crate) const MOST_OF_MOTION: f64 = 0.1;
/// Places at which a measurement is looked at. Chosen.
pub(crate) const PLACES: usize = 400;
/// Growth of the residual's spread up to which a wider cubic still describes the measurement as well \[–\]. Chosen.
pub(crate) const AS_WELL: f64 = 1.1;
/// From one restart along the measured motion to the next \[s\], on a hand: enough for a law to show in the velocity. Chosen.
pub(crate) const RESTARTED_EVERY_S: f64 = 3e-3;
