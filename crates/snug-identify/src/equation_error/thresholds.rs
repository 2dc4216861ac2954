//! Thresholds of the regression of the equation of motion.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Fewest samples to either side of an average: with fewer the weight's derivatives are no longer sums. Chosen.
pub(crate) const LEAST_HALF_WIDTH: usize = 4;
/// Parts of half an average between the instants at which laws are asked. Chosen.
pub(crate) const PARTS_OF_A_HALF: usize = 16;
/// Parts of half an average over which the motion is smoothed that laws are asked along. Chosen: what the average lets pass is
/// slower by far.
pub(crate) const MOTION_FINER: usize = 4;
/// Fewest samples to either side of that: with the middle one, one more than a cubic has coefficients.
pub(crate) const LEAST_OF_MOTION: usize = 2;
/// Places per half of an average: neighbouring averages share three quarters. Chosen.
pub(crate) const PLACES_PER_HALF: usize = 2;
/// Fewest averages per unknown that share no sample: with fewer a regression explains by chance. Chosen.
pub(crate) const AVERAGES_PER_UNKNOWN: usize = 5;
/// Share of the acceleration's power that the torque alone must account for before a regression says anything \[–\]: pure noise
/// and a free vibration obey an equation without any torque. Chosen.
pub(crate) const LEAST_BY_TORQUE: f64 = 0.02;
/// What the regression does not show of m, c, k starts at this share of what it shows \[–\]. Chosen, as with the spectra.
pub(crate) const LEAST_SHARE: f64 = 1e-3;
/// Squared share of a term below which a difference is rounding \[–\]. Chosen.
pub(crate) const ROUNDING: f64 = 1e-12;
/// Share of all samples that the recordings may hold which are too short for an average, or rest \[–\]: they are passed over, so that one
/// which broke off takes nothing from the others. Chosen.
pub(crate) const MOST_PASSED_OVER: f64 = 0.1;
/// Most places of all recordings together: more say nothing new, and take longer. Chosen.
pub(crate) const MOST_PLACES: usize = 6000;
/// Velocity over its root mean square below which the rig is taken to rest \[–\]. Chosen: with a motor that breaks away after a second
/// of standing still, the regression explains 91 % of the acceleration's power with that second and 99 % without.
pub(crate) const AT_REST: f64 = 0.05;
/// Part of an average over which the rig must move \[–\]. Chosen.
pub(crate) const MOSTLY: f64 = 0.75;
/// Share of its own length that an instrument must keep beside others to be new \[–\]: less is rounding. Chosen.
pub(crate) const NEW: f64 = 1e-7;
