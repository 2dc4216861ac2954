//! An effect as a candidate for what the model lacks, and what speaks against it.

use crate::effect::size::EffectParameter;
use serde::{Deserialize, Serialize};

/// An effect as a candidate for what the model lacks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RankedEffect {
    /// Name in the catalogue, or of the study's custom effect.
    pub effect: String,
    /// `mechanical`, `muscular`, `measurement`, `trend` or `custom`.
    pub kind: String,
    /// True for a term that is in no catalogue and was tried to describe what is left.
    pub unlisted: bool,
    /// The expression of such a term.
    #[serde(default)]
    pub expression: Option<String>,
    /// Its size, refitted to all tightenings.
    pub parameters: Vec<EffectParameter>,
    /// T = Σ s_i / √Σ s_i² over tightenings, before any refit; no unit.
    pub score: f64,
    /// Share of all-effect sign flips whose largest T reaches this one.
    pub p_family: f64,
    /// Share of the misfit that it removes in tightenings that took no part in fixing it; negative when it does harm.
    pub heldout_gain: f64,
    /// Standard error of that share over tightenings.
    pub heldout_gain_error: f64,
    /// Error over noise with it, all tightenings pooled.
    pub error_over_noise: Option<f64>,
    /// Standard deviations by which the first of the ranking explains more, over tightenings; 0 for the first.
    pub behind_first: f64,
    /// Whether the data support it: beyond chance at the diagnosis' level, and a gain in held-out tightenings beyond its
    /// scatter.
    pub supported: bool,
    /// Effects that these data cannot tell from it.
    pub twins: Vec<String>,
    /// Whether its size is physically plausible: the fit settled, every estimate within its range.
    pub plausible: bool,
    /// What it is, how it shows, what to check at the bench: sentences for a tool engineer.
    pub explanation: Vec<String>,
}

impl RankedEffect {
    /// What speaks against it, whatever it explains.
    pub fn doubt(&self) -> Option<Doubt> {
        let mut sizes = self.parameters.iter();
        match (self.plausible, sizes.all(EffectParameter::is_plausible)) {
            (true, _) => None,
            (false, true) => Some(Doubt::NotSettled),
            (false, false) => Some(Doubt::ImplausibleSize),
        }
    }
}

/// Why a candidate may not be what it seems.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Doubt {
    /// Its fit did not settle.
    NotSettled,
    /// One of its sizes is beyond what is physically plausible.
    ImplausibleSize,
}
