//! Whether the size of an effect differs between conditions and people.

use crate::tightening::factor::Factor;
use serde::{Deserialize, Serialize};

/// Whether the size of an effect differs between the groups of a factor, by the sizes that single tightenings ask for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SizeComparison {
    /// What groups them.
    pub factor: Factor,
    /// `mixed_model` or `welch_anova`, as in statistics.json.
    pub method: String,
    /// Name of the statistic.
    pub statistic_name: String,
    /// The statistic; no unit.
    pub statistic: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: Vec<f64>,
    /// Chance of as much where all groups are alike.
    pub p: f64,
    /// The same, adjusted over all comparisons of the model's effects (Benjamini and Hochberg).
    pub p_adjusted: f64,
}
