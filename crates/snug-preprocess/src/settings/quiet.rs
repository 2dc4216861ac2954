//! How the quiet part before the pulse is used.

use crate::error::{PreprocessError, in_range};
use serde::{Deserialize, Serialize};

/// How the quiet part before the pulse is used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct QuietSettings {
    /// Distance kept from the detected onset \[s\]; default 0.005.
    pub guard_s: f64,
    /// Shortest quiet part that is measured \[s\]; default 0.1.
    pub minimum_s: f64,
    /// Largest order of the noise's autoregression; default 30.
    pub maximum_order: usize,
    /// Standard errors beyond which an offset counts as significant; default 3.9: one false alarm in 10 000.
    pub significance: f64,
    /// Standard errors by which the mean of a quarter of the quiet part may differ from the whole; default 6.
    pub drift: f64,
}

impl Default for QuietSettings {
    fn default() -> Self {
        Self {
            guard_s: 0.005,
            minimum_s: 0.1,
            maximum_order: 30,
            significance: 3.9,
            drift: 6.0,
        }
    }
}

impl QuietSettings {
    pub(crate) fn check(&self) -> Result<(), PreprocessError> {
        in_range(
            "quiet.guard_s",
            self.guard_s,
            0.0,
            1e3,
            "0 or more (seconds)",
        )?;
        in_range(
            "quiet.minimum_s",
            self.minimum_s,
            1e-6,
            1e3,
            "above 0 (seconds)",
        )?;
        let order = self.maximum_order as f64;
        in_range("quiet.maximum_order", order, 0.0, 200.0, "0 to 200")?;
        in_range(
            "quiet.significance",
            self.significance,
            0.0,
            1e3,
            "0 or more",
        )?;
        in_range("quiet.drift", self.drift, 1.0, 1e6, "1 or more")
    }
}
