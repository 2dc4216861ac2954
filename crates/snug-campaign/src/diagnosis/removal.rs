//! Attempts to do without an added term.

use serde::{Deserialize, Serialize};

/// What became of a term that was tried to be removed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Removal {
    /// The effect.
    pub effect: String,
    /// Whether it was removed.
    pub removed: bool,
    /// In words.
    pub statement: String,
}
