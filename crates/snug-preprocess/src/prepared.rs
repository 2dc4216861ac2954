//! What preprocessing hands on: tightenings with what it holds against them, and findings for the segments left out.

use crate::thesis::checks::ThesisChecks;
use serde::{Deserialize, Serialize};
use snug_campaign::{Finding, Rejection, Segment, Tightening};

/// A tightening that can be fitted, with what preprocessing holds against it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Prepared {
    /// The signals, ready for identification.
    pub tightening: Tightening,
    /// The original program's look at the displacement; `None` unless the preset is `Thesis`.
    pub thesis_checks: Option<ThesisChecks>,
    /// Index into the window of the sample whose displacement was taken as zero; `None` unless the preset is `Thesis`.
    pub zero_sample: Option<usize>,
    /// Whether a fault of the data (see the findings) keeps it out of the statistics.
    pub data_quality_rejects: bool,
}

impl Prepared {
    /// What preprocessing rejects it for; empty when nothing.
    pub fn rejections(&self) -> Vec<Rejection> {
        self.thesis_checks
            .and_then(ThesisChecks::rejection)
            .into_iter()
            .chain(self.data_quality_rejects.then_some(Rejection::DataQuality))
            .collect()
    }
}

/// What became of a recording.
///
/// Every segment is either one of `tightenings`, or has a finding of severity `LeftOut` that says why not.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Preprocessed {
    /// The tightenings' places: the recording's segments, or what preset `snug` divided a file without events into.
    pub segments: Vec<Segment>,
    /// Tightenings in file order.
    pub tightenings: Vec<Prepared>,
    /// What was noticed, repaired or left out, in file order. `LeftOut` also marks a tightening that is kept for the fit
    /// but out of the statistics (`data_quality_rejects`).
    pub findings: Vec<Finding>,
}
