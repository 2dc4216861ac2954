//! An effect that preparation took out before the fit.

use serde::{Deserialize, Serialize};

/// An effect that preparation measured in the quiet part and took out before the fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CorrectedEffect {
    /// Name in the catalogue.
    pub effect: String,
    /// Share of tightenings in which it is significant, 0 to 1.
    pub share: f64,
    /// Its typical (root-mean-square) size, in its unit.
    pub size: f64,
    /// Unit of the size.
    pub unit: String,
}
