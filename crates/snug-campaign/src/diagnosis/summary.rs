//! The part of a diagnosis that verdict.json and the recording share, so that both say the same of it.

use crate::diagnosis::drift::Drift;
use crate::diagnosis::experiment::Experiment;
use crate::diagnosis::negative_control::NegativeControl;
use crate::diagnosis::noise::NoiseStatement;
use crate::diagnosis::removal::Removal;
use crate::diagnosis::result::Diagnosis;
use crate::diagnosis::work::WorkDone;
use crate::effect::added::AddedEffect;
use crate::effect::corrected::CorrectedEffect;
use crate::effect::detectability::Detectability;
use crate::effect::unlisted::UnlistedTerm;
use crate::words::sentence::headline::Headline;
use crate::words::sentence::reason::Reason;
use crate::words::sentence::stopped::Stopped;
use serde::Serialize;

/// What every file says of a diagnosis: all of it but the ladder, the ranking, the comparison, the places of failure and
/// the signals, of which each file has its own form.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct DiagnosisSummary<'a> {
    verdict: &'static str,
    headline: &'a Headline,
    reasons: &'a [Reason],
    stopped: Option<&'a Stopped>,
    level: f64,
    interrupted: bool,
    verb: &'a str,
    tightenings: usize,
    compared_output: &'a str,
    noise: &'a NoiseStatement,
    added: &'a [AddedEffect],
    corrected: &'a [CorrectedEffect],
    removals: &'a [Removal],
    unlisted: Option<&'a UnlistedTerm>,
    experiment: Option<&'a Experiment>,
    control: Option<&'a NegativeControl>,
    detectability: &'a [Detectability],
    drift: &'a [Drift],
    work: WorkDone,
}

impl Diagnosis {
    /// What every file says of it.
    pub fn summary(&self) -> DiagnosisSummary<'_> {
        self.summary_with(self)
    }

    /// The same, its sentences those of `told`, which is the same diagnosis in other words.
    pub fn summary_with<'a>(&'a self, told: &'a Self) -> DiagnosisSummary<'a> {
        DiagnosisSummary {
            verdict: self.verdict.name(),
            headline: &told.headline,
            reasons: &told.reasons,
            stopped: told.stopped.as_ref(),
            level: self.level,
            interrupted: self.interrupted,
            verb: &self.verb,
            tightenings: self.tightenings,
            compared_output: &self.compared_output,
            noise: &self.noise,
            added: &self.added,
            corrected: &self.corrected,
            removals: &self.removals,
            unlisted: self.unlisted.as_ref(),
            experiment: self.experiment.as_ref(),
            control: self.control.as_ref(),
            detectability: &self.detectability,
            drift: &self.drift,
            work: self.work,
        }
    }
}
