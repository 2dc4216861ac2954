//! The thresholds of the data-quality checks, with default and allowed range.

use crate::error::{PreprocessError, in_range};
use serde::{Deserialize, Serialize};

/// From where on data count as faulty.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct QualitySettings {
    /// Smallest height of a torque pulse \[Nm\]; default 1.0.
    pub minimum_pulse_nm: f64,
    /// Longest run of missing samples (NaN, infinite) that is bridged by a straight line \[s\]; default 0.001.
    pub repair_gap_s: f64,
    /// Largest share of bridged samples in the window of a selected tightening; default 0.01.
    pub repaired_ratio: f64,
    /// Shortest run of identical samples that counts as a dropout in a noisy channel \[s\]; default 0.002.
    pub stuck_s: f64,
    /// Fewest successive samples at the very extreme that count as saturation; default 5.
    pub saturated_samples: usize,
    /// Height of a spike in standard deviations of the local sample-to-sample noise; default 12.
    pub spike_sd: f64,
}

impl Default for QualitySettings {
    fn default() -> Self {
        Self {
            minimum_pulse_nm: 1.0,
            repair_gap_s: 0.001,
            repaired_ratio: 0.01,
            stuck_s: 0.002,
            saturated_samples: 5,
            spike_sd: 12.0,
        }
    }
}

impl QualitySettings {
    pub(crate) fn check(&self) -> Result<(), PreprocessError> {
        let minimum = self.minimum_pulse_nm;
        in_range(
            "quality.minimum_pulse_nm",
            minimum,
            0.0,
            1e9,
            "0 or more (Nm)",
        )?;
        let gap = self.repair_gap_s;
        in_range("quality.repair_gap_s", gap, 0.0, 10.0, "0 to 10 (seconds)")?;
        in_range(
            "quality.repaired_ratio",
            self.repaired_ratio,
            0.0,
            1.0,
            "0 to 1",
        )?;
        in_range(
            "quality.stuck_s",
            self.stuck_s,
            1e-6,
            1e3,
            "above 0 (seconds)",
        )?;
        let samples = self.saturated_samples as f64;
        in_range("quality.saturated_samples", samples, 2.0, 1e9, "2 or more")?;
        in_range("quality.spike_sd", self.spike_sd, 3.0, 1e9, "3 or more")
    }
}
