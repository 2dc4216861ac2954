//! When something counts as found; every number without a unit unless it says one.

/// Share of what is told that may be false (Benjamini and Hochberg 1995), over all groups and quantities of one question.
/// Chosen: a plant of a thousand tools that all are well is told of hardly any.
pub const FALSE_DISCOVERY_RATE: f64 = 0.01;

/// Days on either side of a change, at least: one alone is an outlier.
pub const FEWEST_DAYS_BESIDE: usize = 2;

/// Days that a group must have for a change to be looked for: two on either side and two degrees of freedom more.
pub const FEWEST_DAYS: usize = 6;

/// Sisters that a group must have to be compared with them. Chosen.
pub const FEWEST_SISTERS: usize = 4;

/// Scaled median absolute deviations beyond which a sister is no yardstick for the others (Hampel 1974's 3.5, the usual choice).
pub const OUTLYING_MADS: f64 = 3.5;

/// Tools of which the page shows a tightening's curves. Chosen.
pub const MOST_CURVES: usize = 24;

/// Least change of a quantity that is called different \[share of the pooled daily spread\]: below it a year's days make a change
/// significant that nobody could feel.
pub const SMALLEST_SHIFT_SD: f64 = 1.0;
