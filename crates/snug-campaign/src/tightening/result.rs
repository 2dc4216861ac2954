//! What was found out about one tightening.

use crate::identification::estimate::Estimate;
use crate::measurement::conditions::Conditions;
use crate::measurement::noise::NoiseFloor;
use crate::measurement::rig::Rig;
use crate::tightening::correction::Correction;
use crate::tightening::id::TighteningId;
use crate::tightening::measures::FitMeasures;
use crate::tightening::selection::Selection;
use crate::tightening::validation::Validation;
use serde::{Deserialize, Serialize};

/// What was found out about one tightening.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TighteningResult {
    /// Which one.
    pub id: TighteningId,
    /// When its segment began, on the clock of its file's events \[s\]; `None` where the file has none.
    #[serde(default)]
    pub started_at_s: Option<f64>,
    /// Its conditions.
    pub conditions: Conditions,
    /// The rig's constants for it.
    pub rig: Rig,
    /// Largest torque of the whole segment \[Nm\].
    pub peak_torque_nm: f64,
    /// Peak torque rounded to 5 Nm \[Nm\].
    pub target_torque_nm: f64,
    /// The identification; `None` when the data did not allow one.
    pub estimate: Option<Estimate>,
    /// Agreement of model and measurement.
    pub measures: FitMeasures,
    /// Whether it is selected.
    pub selection: Selection,
    /// What was taken out before the fit.
    pub corrections: Vec<Correction>,
    /// Noise of the fitted output.
    pub noise: Option<NoiseFloor>,
    /// How well it is predicted, if it was kept for validation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub validation: Option<Validation>,
}
