//! When samples were taken: one uniform grid per recording or tightening, so that no channel carries times of its own.

use serde::{Deserialize, Serialize};

/// A uniform sampling grid: sample `i` was taken at `start_s + i · interval_s`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TimeBase {
    /// Time of sample 0 \[s\].
    pub start_s: f64,
    /// Time between samples \[s\], positive.
    pub interval_s: f64,
}

impl TimeBase {
    /// Time of sample `index` \[s\].
    pub fn at(&self, index: usize) -> f64 {
        self.start_s + index as f64 * self.interval_s
    }

    /// Samples per second \[Hz\].
    pub fn rate_hz(&self) -> f64 {
        1.0 / self.interval_s
    }
}
