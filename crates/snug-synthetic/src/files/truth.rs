//! The truth file: the numbers that identification and diagnosis of a simulated campaign should come to.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What was really there in one tightening.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TighteningTruth {
    /// What the file calls itself, for example `TP3_QS_Soft_8`.
    pub file: String,
    /// 0-based number within the file.
    pub index: usize,
    /// Hand–arm mass \[kg\].
    pub m: f64,
    /// Damping \[kg/s\].
    pub c: f64,
    /// Stiffness \[N/m\].
    pub k: f64,
    /// Peak torque \[Nm\].
    pub target: f64,
    /// Hidden effects with their numbers; `none` with no numbers where nothing is hidden.
    pub used: BTreeMap<String, Vec<f64>>,
    /// Constant acceleration bias, hidden or nuisance \[rad/s²\].
    pub bias: f64,
    /// Largest true angle \[rad\].
    pub peak_rad: f64,
    /// What is wrong with the data; absent where nothing is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fault: Option<String>,
}

/// What was really there in a campaign, as it is written beside it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
    /// Names of the hidden effects; `none` where nothing is hidden.
    pub effects: Vec<String>,
    /// How strong they are, as the plan has it; no unit.
    pub strength: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// `white` or `coloured`.
    pub noise: String,
    /// Whether there is any bias or vibration that is not a hidden effect.
    pub nuisance: bool,
    /// Every tightening, file by file.
    pub tightenings: Vec<TighteningTruth>,
}

impl Truth {
    /// As JSON, one space per level, with a newline at the end.
    ///
    /// # Errors
    /// Not with finite numbers.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        let mut json = Vec::new();
        let formatter = serde_json::ser::PrettyFormatter::with_indent(b" ");
        self.serialize(&mut serde_json::Serializer::with_formatter(
            &mut json, formatter,
        ))?;
        json.push(b'\n');
        Ok(String::from_utf8(json).expect("serde_json writes UTF-8"))
    }
}
