//! What the campaign says about the model.

use serde::{Deserialize, Serialize};

/// What the campaign says about the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nothing beyond the model is supported.
    Adequate,
    /// The ranking's first effect is supported by the data and not yet in the model.
    MissingEffect,
    /// Repeatable misfit remains that no effect of the catalogue explains.
    UnlistedEffect,
    /// Too little data to say.
    Undecided,
    /// No model was found that deserves the question.
    NotFitted,
}

impl Verdict {
    /// Stable snake-case name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Adequate => "adequate",
            Self::MissingEffect => "missing_effect",
            Self::UnlistedEffect => "unlisted_effect",
            Self::Undecided => "undecided",
            Self::NotFitted => "not_fitted",
        }
    }
}
