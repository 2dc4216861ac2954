//! What a user may set about how the missing effect is looked for.

use serde::{Deserialize, Serialize};

/// How the missing effect is looked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DiagnoseSettings {
    /// Sign flips of whole tightenings behind a family-wise p; default 1999.
    pub sign_flips: usize,
    /// Largest family-wise p at which an effect counts as supported \[–\]; default 0.05.
    pub level: f64,
    /// Smallest share of the squared residual that an effect must remove in held-out tightenings to matter; default 0.01
    /// (half a percent of the error). Less than that may be a piece of what else is missing.
    pub smallest_gain: f64,
    /// The same where the model already comes down to the noise, and nothing else is missing \[–\]; default 0.003. Less than that
    /// is within reach of torque noise and of how samples are held.
    pub smallest_gain_at_noise: f64,
    /// Starts from which each effect is tried along the measured motion, the most promising freely as well; default 8.
    pub starts: usize,
    /// Campaigns of nothing but noise on which the ranking is tried as a negative control; default 200.
    pub control_campaigns: usize,
    /// Seed of everything random; default 0.
    pub seed: u64,
    /// Whether recordings move loads that differ a hundredfold, which otherwise looks like a unit that is wrong; default false.
    pub loads_differ: bool,
    /// Whether the model is to predict: an effect then counts by what it takes of what is left, too, however little that is of all.
    /// Default false; a study that keeps ranges or files for validation asks for it.
    pub for_prediction: bool,
}

impl Default for DiagnoseSettings {
    fn default() -> Self {
        Self {
            sign_flips: 1999,
            level: 0.05,
            smallest_gain: 0.01,
            smallest_gain_at_noise: 0.003,
            starts: 8,
            control_campaigns: 200,
            seed: 0,
            loads_differ: false,
            for_prediction: false,
        }
    }
}
