//! A term that is in no catalogue.

use serde::{Deserialize, Serialize};

/// The simplest term that describes what no effect of the catalogue explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnlistedTerm {
    /// Expression of a custom effect, for example `p*x^2*v`.
    pub expression: String,
    /// RON to paste into the study's `model.custom` list.
    pub ron: String,
    /// Share of the remaining misfit that it removes in held-out tightenings.
    pub heldout_gain: f64,
    /// In words.
    pub statement: String,
}
