//! How much work a diagnosis was.

use serde::{Deserialize, Serialize};

/// How much work a diagnosis was: counts, no times, the same on every run and for any number of threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct WorkDone {
    /// Rankings of all candidates, those for looking ahead included.
    pub rankings: usize,
    /// Simulations of a tightening for how a candidate would push it.
    pub signatures: usize,
    /// Fits of tightenings together.
    pub pooled_fits: usize,
    /// Steps tried in them.
    pub steps: usize,
    /// Simulations of a tightening with sensitivities in them.
    pub linearizations: usize,
    /// Conic programs solved in them.
    pub conic_solves: usize,
}
