//! An effect in the model, with the evidence for it.

use crate::effect::size::EffectParameter;
use crate::effect::size_comparison::SizeComparison;
use serde::{Deserialize, Serialize};

/// An effect in the model, with the evidence for it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AddedEffect {
    /// Its name.
    pub effect: String,
    /// `mechanical`, `muscular`, `measurement`, `trend` or `custom`.
    pub kind: String,
    /// The expression of a custom effect.
    pub expression: Option<String>,
    /// Effects that these data cannot tell from it.
    pub twins: Vec<String>,
    /// `shared` by all tightenings, `per tightening`, or what differs in it: `per participant`, `per joint` and so on.
    #[serde(default)]
    pub size: String,
    /// Its size.
    pub parameters: Vec<EffectParameter>,
    /// Family-wise p at the rung where it was added; `None` when the study already had it.
    pub p_family: Option<f64>,
    /// Share of the misfit at that rung that it removed in held-out tightenings.
    pub heldout_gain: Option<f64>,
    /// Loss of fit when it alone is removed from the final model: growth of the pooled squared error over noise, as a
    /// share of it.
    pub needed: Option<f64>,
    /// Sentences for a tool engineer.
    pub explanation: Vec<String>,
    /// Whether its size differs between conditions and people.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub comparisons: Vec<SizeComparison>,
}
