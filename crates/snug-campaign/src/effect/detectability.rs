//! How large an effect would have to be to be seen.

use crate::tightening::factor::Factor;
use serde::{Deserialize, Serialize};

/// How large an effect would have to be to be seen in these data; sizes in its parameter's unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Detectability {
    /// The effect.
    pub effect: String,
    /// The parameter whose size is meant.
    pub parameter: String,
    /// What that parameter is, in a few words, as its effect says it; empty where nothing says it.
    #[serde(default)]
    pub meaning: String,
    /// Its unit.
    pub unit: String,
    /// Absent or smaller than this (95 % power at the family-wise level).
    pub smallest_detectable: Option<f64>,
    /// The largest plausible size, to compare with.
    pub largest_plausible: f64,
    /// The same where only some people or tools have it; `None` where tightenings form no groups.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_some_groups: Option<InSomeGroups>,
    /// In words.
    pub statement: String,
}

/// How large an effect that only some groups have would have to be to be seen, and how few may have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InSomeGroups {
    /// What groups the tightenings.
    pub factor: Factor,
    /// How many groups there are.
    pub groups: usize,
    /// Size from which it is found in a single group, in the parameter's unit; `None` where that is not plausible.
    pub in_one: Option<f64>,
    /// Fewest groups in which it is found at its largest plausible size; `None` where even all are too few.
    pub fewest: Option<usize>,
}
