//! Tests of one quantity against one factor, and how what they presume stands.

use crate::identification::interval::Interval;
use serde::{Deserialize, Serialize};

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
