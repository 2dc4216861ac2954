//! What one file gave.

use snug_campaign::{Finding, Recording};

/// What one file gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Ingested {
    /// Recordings, mostly one; a recording that Snug wrote holds one per measurement file.
    pub recordings: Vec<Recording>,
    /// What a reader of the results must know about the file.
    pub findings: Vec<Finding>,
}
