//! `verdict.json`: what is missing in the model, how large it is, how sure that is, and how the error fell.

use crate::json;
use serde::Serialize;
use snug_campaign::{Comparison, Diagnosis, DiagnosisSummary, Location, RankedEffect, Rung};

/// The file's keys, those that other programs rely on first.
#[derive(Serialize)]
struct VerdictFile<'a> {
    format: u32,
    #[serde(flatten)]
    summary: DiagnosisSummary<'a>,
    ladder: &'a [Rung],
    ranking: &'a [RankedEffect],
    comparison: &'a Comparison,
    location: &'a Location,
    final_location: Option<&'a Location>,
}

/// Everything a diagnosis found but the signals of its example tightening, which the report draws.
///
/// `format` is 1; intervals are 95 %; a number that is unknown or not finite is `null`.
pub fn verdict_json(diagnosis: &Diagnosis) -> String {
    let file = VerdictFile {
        format: 1,
        summary: diagnosis.summary(),
        ladder: &diagnosis.ladder,
        ranking: &diagnosis.ranking,
        comparison: &diagnosis.comparison,
        location: &diagnosis.location,
        final_location: diagnosis.final_location.as_ref(),
    };
    json::text(&file)
}
