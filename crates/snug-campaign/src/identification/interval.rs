//! Intervals of confidence.

use serde::{Deserialize, Serialize};

/// A closed interval \[low, high\], in the unit of what it bounds; 95 % confidence unless said otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Standard errors to either side of an estimate that hold 95 % of a normal distribution \[–\]: Φ⁻¹(0.975).
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

impl Interval {
    /// value ± [`NORMAL_95`] standard errors.
    pub fn normal(value: f64, standard_error: f64) -> Self {
        let half = NORMAL_95 * standard_error;
        Self {
            low: value - half,
            high: value + half,
        }
    }

    /// The same with both ends `factor` times as large, as in another unit; the factor is above 0.
    pub fn times(self, factor: f64) -> Self {
        Self {
            low: self.low * factor,
            high: self.high * factor,
        }
    }
}
