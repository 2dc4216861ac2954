//! Participant, strategy, joint and pace: the factors by which tightenings are grouped and compared.

use serde::{Deserialize, Serialize};

/// Under which conditions a file's tightenings were made; what the file does not say is `None`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Conditions {
    /// Who held the tool, for example `TP3`.
    pub participant: Option<String>,
    /// Tightening strategy: `QS` (Quick Step), `TT` (Turbo Tight) or a study's own word.
    pub strategy: Option<String>,
    /// Joint stiffness: `Soft`, `Hard` or a study's own word.
    pub joint: Option<String>,
    /// Tightenings per minute.
    pub pace_per_min: Option<f64>,
}
