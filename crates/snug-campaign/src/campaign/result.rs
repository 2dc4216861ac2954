//! What an evaluated campaign hands to report and recording: presets compared, tightenings, conditions, tests.

use crate::diagnosis::result::Diagnosis;
use crate::identification::estimate::Interval;
use crate::measurement::finding::Finding;
use crate::measurement::signal_units::SignalUnits;
use crate::tightening::result::{Rejection, TighteningId, TighteningResult, Traces};
use crate::words::vocabulary::Vocabulary;
use serde::{Deserialize, Serialize};

/// How many tightenings were rejected for one reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RejectionCount {
    /// The reason.
    pub rejection: Rejection,
    /// Tightenings with this reason (one tightening may have several).
    pub tightenings: usize,
}

/// What one preset made of the campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PresetSummary {
    /// `snug` or `thesis`.
    pub preset: String,
    /// Tightenings found.
    pub tightenings: usize,
    /// Tightenings selected.
    pub selected: usize,
    /// Reasons, most frequent first.
    pub rejections: Vec<RejectionCount>,
    /// Per tightening the reasons (empty = selected), in campaign order.
    pub outcomes: Vec<(TighteningId, Vec<Rejection>)>,
}

/// Count, mean and spread of one quantity in one group, in the quantity's unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moments {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation (n − 1); `None` for fewer than two values.
    pub standard_deviation: Option<f64>,
    /// 95 % interval of the mean (Student t over tightenings); `None` for fewer than two values.
    pub mean_interval: Option<Interval>,
    /// Median.
    pub median: f64,
}

/// One quantity in one group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuantitySummary {
    /// Column name with unit suffix, for example `mass_kg`.
    pub quantity: String,
    /// Over the selected tightenings; `None` when there are none.
    pub selected: Option<Moments>,
    /// Over the rejected tightenings that have an estimate.
    pub rejected: Option<Moments>,
}

/// One level of one factor, for example strategy = QS.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ConditionSummary {
    /// `all`, `strategy`, `joint`, `pace_per_min`, `participant`, `target_torque_nm`.
    pub factor: String,
    /// The level as text; `all` for everything.
    pub level: String,
    /// Tightenings.
    pub tightenings: usize,
    /// Of them selected.
    pub selected: usize,
    /// Wilson 95 % interval of the selected share.
    pub selected_share_interval: Option<Interval>,
    /// Mass, damping, stiffness, natural frequency and effect parameters.
    pub quantities: Vec<QuantitySummary>,
}

/// How large a difference is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EffectSize {
    /// For example `hedges_g`, `eta_squared`.
    pub name: String,
    /// Its value; no unit.
    pub value: f64,
    /// 95 % interval where one is defined.
    pub interval: Option<Interval>,
}

/// How something that a test presumes stands. A check beside the test: it changes no result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AssumptionCheck {
    /// What is presumed: `normal_residuals` (about the groups' means) or `equal_variances`.
    pub assumption: String,
    /// How it is checked, for example `shapiro_wilk`, `brown_forsythe`.
    pub method: String,
    /// Name of the statistic: `W`, `F`.
    pub statistic_name: String,
    /// Its value; `None` when the check could not be made.
    pub statistic: Option<f64>,
    /// Degrees of freedom, none or two.
    pub degrees_of_freedom: Vec<f64>,
    /// p value, not adjusted: small where the presumption does not hold; `None` when the check could not be made.
    pub p: Option<f64>,
    /// Values that were looked at.
    pub values: usize,
    /// Their groups: a group of one value takes no part.
    pub groups: usize,
    /// Values whose distance from their group's mean another value shares.
    pub tied: usize,
    /// Why the check could not be made.
    pub note: Option<String>,
}

/// One test of one quantity against one factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TestRow {
    /// Column name with unit suffix.
    pub quantity: String,
    /// The factor tested.
    pub factor: String,
    /// Method, for example `welch_t`, `one_way_anova`, `mann_whitney`, `mixed_model`, `participant_permutation`.
    pub method: String,
    /// Whether the method respects that tightenings of one participant are not independent.
    pub respects_participants: bool,
    /// Name of the statistic: `t`, `F`, `H`, `U`, …
    pub statistic_name: String,
    /// Its value; `None` when the test could not be made.
    pub statistic: Option<f64>,
    /// Degrees of freedom, none, one or two.
    pub degrees_of_freedom: Vec<f64>,
    /// p value; `None` when the test could not be made.
    pub p: Option<f64>,
    /// p adjusted over the table by Benjamini and Hochberg, per method.
    pub p_adjusted: Option<f64>,
    /// Size of the difference.
    pub effect_size: Option<EffectSize>,
    /// How what the test presumes stands; empty where it presumes nothing that was checked.
    #[serde(default)]
    pub assumptions: Vec<AssumptionCheck>,
    /// Why the test could not be made, or what limits it.
    pub note: Option<String>,
}

/// What a parameter of one of the model's effects is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ParameterMeaning {
    /// Its column: name with unit suffix.
    pub name: String,
    /// Its effect.
    pub effect: String,
    /// What it is, in a few words, as its effect says it.
    pub meaning: String,
}

impl ParameterMeaning {
    /// Effect and parameter: `coulomb friction: friction force`; of an effect that is called like its only parameter once.
    pub fn words(&self) -> String {
        let effect = self.effect.replace('_', " ");
        match self.meaning == effect {
            true => effect,
            false => format!("{effect}: {}", self.meaning),
        }
    }
}

/// A campaign, evaluated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CampaignResult {
    /// Title of the study.
    pub title: String,
    /// The study as run, every default written out (RON).
    pub study_ron: String,
    /// Preset the results were made with.
    pub preset: String,
    /// Which quantity was fitted, in words, for example `acceleration`.
    pub fitted_output: String,
    /// In which units input and output are shown.
    pub units: SignalUnits,
    /// In whose words it is told.
    pub vocabulary: Vocabulary,
    /// Names of the effects in the model; empty for the base model.
    pub effects: Vec<String>,
    /// What their parameters are.
    pub meanings: Vec<ParameterMeaning>,
    /// Both presets side by side (the one in use first).
    pub presets: Vec<PresetSummary>,
    /// Every tightening, in campaign order.
    pub tightenings: Vec<TighteningResult>,
    /// Means and spreads per condition.
    pub conditions: Vec<ConditionSummary>,
    /// Tests per quantity and factor.
    pub tests: Vec<TestRow>,
    /// What was left out, repaired or is worth knowing.
    pub findings: Vec<Finding>,
    /// Signals of a bounded number of tightenings: index into `tightenings`, signals.
    pub examples: Vec<(usize, Traces)>,
    /// What is missing in the model; `None` when nobody asked.
    pub diagnosis: Option<Diagnosis>,
}
