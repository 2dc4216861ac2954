//! What one preset made of the campaign.

use crate::tightening::id::TighteningId;
use crate::tightening::selection::Rejection;
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
