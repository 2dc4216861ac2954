//! How the torque pulse and its onset are found.

use crate::error::{PreprocessError, in_range};
use serde::{Deserialize, Serialize};

/// How the torque pulse and its onset are found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OnsetSettings {
    /// Threshold in standard deviations of the quiet torque; default 5.
    pub threshold_sd: f64,
    /// Smallest threshold as a share of the peak; default 0.002.
    pub threshold_peak_ratio: f64,
    /// How long the torque must stay below the threshold to count as before the onset \[s\]; default 0.001.
    pub hold_s: f64,
    /// How far before the onset a window is put that has to be moved \[s\]; default 0.005.
    pub lead_s: f64,
    /// How far the torque must fall and rise again between two pulses, as a share of the peak; default 0.3.
    pub second_pulse_ratio: f64,
}

impl Default for OnsetSettings {
    fn default() -> Self {
        Self {
            threshold_sd: 5.0,
            threshold_peak_ratio: 0.002,
            hold_s: 0.001,
            lead_s: 0.005,
            second_pulse_ratio: 0.3,
        }
    }
}

impl OnsetSettings {
    pub(crate) fn check(&self) -> Result<(), PreprocessError> {
        in_range(
            "onset.threshold_sd",
            self.threshold_sd,
            1.0,
            1e3,
            "1 or more",
        )?;
        let ratio = self.threshold_peak_ratio;
        in_range("onset.threshold_peak_ratio", ratio, 0.0, 0.5, "0 to 0.5")?;
        in_range("onset.hold_s", self.hold_s, 0.0, 10.0, "0 to 10 (seconds)")?;
        in_range("onset.lead_s", self.lead_s, 0.0, 10.0, "0 to 10 (seconds)")?;
        let ratio = self.second_pulse_ratio;
        in_range(
            "onset.second_pulse_ratio",
            ratio,
            END_RATIO,
            1.0,
            "0.1 to 1",
        )
    }
}

/// Share of the peak below which a pulse has ended.
pub(crate) const END_RATIO: f64 = 0.1;
