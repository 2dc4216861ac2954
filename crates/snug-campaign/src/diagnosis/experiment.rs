//! An experiment that would tell twins apart.

use serde::{Deserialize, Serialize};

/// An experiment that would tell twins apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// The effects it separates.
    pub between: Vec<String>,
    /// Conditions of the tightenings to make, in words.
    pub conditions: String,
    /// How many of them; `None` when none of the tried conditions separates them.
    pub tightenings: Option<usize>,
    /// Smallest refitted distance over noise per tightening under these conditions; no unit.
    pub distance_per_tightening: f64,
    /// In words.
    pub statement: String,
}
