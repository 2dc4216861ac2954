//! `verdict.json`: what is missing in the model, how large it is, how sure that is, and how the error fell.

use serde::Serialize;
use snug_campaign::{
    AddedEffect, Comparison, CorrectedEffect, Detectability, Diagnosis, Drift, Experiment,
    Location, NegativeControl, NoiseStatement, RankedEffect, Removal, Rung, UnlistedTerm, WorkDone,
};

/// The file's keys, those that other programs rely on first.
#[derive(Serialize)]
struct VerdictFile<'a> {
    format: u32,
    verdict: &'static str,
    headline: &'a str,
    reasons: &'a [String],
    stopped: Option<&'a str>,
    verb: &'a str,
    tightenings: usize,
    compared_output: &'a str,
    noise: &'a NoiseStatement,
    added: &'a [AddedEffect],
    corrected: &'a [CorrectedEffect],
    ladder: &'a [Rung],
    ranking: &'a [RankedEffect],
    removals: &'a [Removal],
    unlisted: Option<&'a UnlistedTerm>,
    experiment: Option<&'a Experiment>,
    control: Option<&'a NegativeControl>,
    detectability: &'a [Detectability],
    drift: &'a [Drift],
    comparison: &'a Comparison,
    location: &'a Location,
    final_location: Option<&'a Location>,
    work: WorkDone,
}

/// Everything a diagnosis found but the signals of its example tightening, which the report draws.
///
/// `format` is 1; intervals are 95 %; a number that is unknown or not finite is `null`.
pub fn verdict_json(diagnosis: &Diagnosis) -> String {
    let file = VerdictFile {
        format: 1,
        verdict: diagnosis.verdict.name(),
        headline: &diagnosis.headline,
        reasons: &diagnosis.reasons,
        stopped: diagnosis.stopped.as_deref(),
        verb: &diagnosis.verb,
        tightenings: diagnosis.tightenings,
        compared_output: &diagnosis.compared_output,
        noise: &diagnosis.noise,
        added: &diagnosis.added,
        corrected: &diagnosis.corrected,
        ladder: &diagnosis.ladder,
        ranking: &diagnosis.ranking,
        removals: &diagnosis.removals,
        unlisted: diagnosis.unlisted.as_ref(),
        experiment: diagnosis.experiment.as_ref(),
        control: diagnosis.control.as_ref(),
        detectability: &diagnosis.detectability,
        drift: &diagnosis.drift,
        comparison: &diagnosis.comparison,
        location: &diagnosis.location,
        final_location: diagnosis.final_location.as_ref(),
        work: diagnosis.work,
    };
    let mut text =
        serde_json::to_string_pretty(&file).expect("plain structs with text keys serialise");
    text.push('\n');
    text
}
