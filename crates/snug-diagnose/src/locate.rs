//! Where a model fails: over time, phase, frequency, amplitude and conditions, and as a missing force.

use snug_campaign::{Comparison, Drift, Estimate, Location, Motion, Tightening};

/// One tightening with what a model makes of it.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// The measurement.
    pub tightening: &'a Tightening,
    /// The model's motion with the tightening's own estimate.
    pub simulated: &'a Motion,
    /// The estimate.
    pub estimate: &'a Estimate,
    /// Samples at the window's start that count for nothing.
    pub unscored: usize,
}

/// Model against measurement per tightening and pooled.
pub fn compare(_seen: &[Seen<'_>]) -> Comparison {
    Comparison::default()
}

/// Where the model fails.
pub fn locate(_seen: &[Seen<'_>], _seed: u64) -> Location {
    Location::default()
}

/// What the fitted m, c, k drift with.
pub fn drifts(_seen: &[Seen<'_>]) -> Vec<Drift> {
    Vec::new()
}
