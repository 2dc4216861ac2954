//! One measurement file, from bytes to results.

use crate::error::StudyError;
use crate::evaluation::prepared_file::PreparedFile;
use crate::evaluation::rungs::{Ladder, RungShare, Simulated};
use crate::evaluation::tightening::{Evaluated, fitted, validated, without_estimate};
use crate::evaluation::validation::mean_estimate;
use crate::study::Study;
use snug_campaign::{Estimate, Finding, Recording, Rejection, Severity, TighteningId};
use snug_files::Disk;
use snug_identify::{IdentifyError, in_batches};
use snug_preprocess::{Prepared, Preprocessed, Preset, Window, preprocess};
use std::iter;
use std::path::Path;

/// What became of one file.
pub struct FileEvaluation {
    /// The recordings, as they were read; none when the file could not be.
    pub recordings: Vec<Recording>,
    /// Tightenings in file order.
    pub evaluated: Vec<Evaluated>,
    /// What was left out, repaired or is worth knowing.
    pub findings: Vec<Finding>,
    /// Per tightening the reasons for which the other preset rejects it; `None` where that preset does not apply.
    pub other_preset: Option<Vec<(TighteningId, Vec<Rejection>)>>,
    /// What the file says of every rung of a diagnosis' ladder; empty without one.
    pub rungs: Vec<RungShare>,
}

/// What is done with the tightenings of a file.
#[derive(Clone, Copy)]
pub enum Purpose<'a> {
    /// They are fitted, but for ranges that are kept for validation.
    Fit,
    /// All are simulated with what was found of other files, if anything was.
    Validate(Option<&'a Estimate>),
}

/// Evaluates one file, which is read and prepared unless it was kept: with the run's own study, and, if it is fitted, with those of
/// the rungs before it. What cannot be used becomes a finding.
pub fn evaluate_file(
    study: &Study,
    ladder: Option<&Ladder>,
    disk: &dyn Disk,
    path: &Path,
    kept: Option<PreparedFile>,
    purpose: Purpose<'_>,
) -> Result<FileEvaluation, StudyError> {
    let _span = tracing::info_span!("file", path = %path.display()).entered();
    let read = match kept {
        Some(file) => Ok(file),
        None => PreparedFile::read(study, disk, path)?,
    };
    let file = match read {
        Ok(file) => file,
        Err(error) => {
            tracing::debug!(%error, "the file is left out");
            return Ok(FileEvaluation {
                findings: vec![error.finding()],
                ..FileEvaluation::nothing(study, ladder)
            });
        }
    };
    let mut whole = FileEvaluation::nothing(study, ladder);
    whole.findings = file.findings;
    let other = other(study);
    let rungs_before = match purpose {
        Purpose::Fit => rungs_before(ladder),
        Purpose::Validate(_) => &[],
    };
    for (recording, prepared) in file.recordings {
        let mut before = None;
        for (rung, share) in rungs_before.iter().zip(&mut whole.rungs) {
            let (evaluated, _) = evaluate(rung, &recording, &prepared, purpose)?;
            share.add(RungShare::of(&evaluated));
            before.get_or_insert_with(|| Simulated::of(evaluated));
        }
        let (mut evaluated, findings) = evaluate(study, &recording, &prepared, purpose)?;
        if let Some(before) = before {
            before.stand_beside(&mut evaluated);
        }
        whole.findings.extend(prepared.findings);
        whole.findings.extend(findings);
        if let (Some(other), Some(there)) = (&other, &mut whole.other_preset) {
            let prepared = preprocess(&recording, &other.preprocess, other.identify.fitted_output)?;
            let (evaluated, findings) = evaluate(other, &recording, &prepared, purpose)?;
            there.extend(outcomes(&evaluated));
            if study.preprocess.preset == Preset::Thesis {
                let seen = prepared.findings.into_iter().chain(findings);
                whole.findings.extend(seen.map(as_note));
            }
        }
        if let Some(last) = whole.rungs.last_mut() {
            last.add(RungShare::of(&evaluated));
        }
        whole.recordings.push(recording);
        whole.evaluated.extend(evaluated);
    }
    tracing::info!(
        tightenings = whole.evaluated.len(),
        findings = whole.findings.len(),
        "the file is evaluated"
    );
    Ok(whole)
}

impl FileEvaluation {
    fn nothing(study: &Study, ladder: Option<&Ladder>) -> Self {
        let rungs = ladder.map_or(0, |ladder| ladder.before.len() + 1);
        Self {
            recordings: Vec::new(),
            evaluated: Vec::new(),
            findings: Vec::new(),
            other_preset: other(study).map(|_| Vec::new()),
            rungs: (0..rungs).map(|_| RungShare::default()).collect(),
        }
    }
}

fn rungs_before(ladder: Option<&Ladder>) -> &[Study] {
    ladder.map_or(&[], |ladder| &ladder.before)
}

/// What preset `snug` found, for a run of the original program, which looks for nothing: told, without consequence.
fn as_note(finding: Finding) -> Finding {
    Finding {
        severity: Severity::Note,
        message: format!(
            "by preset snug, without consequence here: {}",
            finding.message
        ),
        ..finding
    }
}

/// The same study under the other preset, where that makes sense.
pub fn other(study: &Study) -> Option<Study> {
    let preprocess = &study.preprocess;
    if preprocess.window == Window::Whole || preprocess.stretch.is_some() {
        return None;
    }
    let mut other = study.clone();
    other.set_preset(match study.preprocess.preset {
        Preset::Snug => Preset::Thesis,
        Preset::Thesis => Preset::Snug,
    });
    Some(other)
}

/// Which tightenings were rejected for what.
pub fn outcomes(evaluated: &[Evaluated]) -> Vec<(TighteningId, Vec<Rejection>)> {
    evaluated
        .iter()
        .map(|one| {
            (
                one.result.id.clone(),
                one.result.selection.rejections.clone(),
            )
        })
        .collect()
}

/// Evaluates one recording: every segment gives a result, with an estimate or with the reason for none, which is a finding.
fn evaluate(
    study: &Study,
    recording: &Recording,
    prepared: &Preprocessed,
    purpose: Purpose<'_>,
) -> Result<(Vec<Evaluated>, Vec<Finding>), StudyError> {
    let mut findings = Vec::new();
    let only_simulated = study.validation_segments();
    let is_kept = |number: u32| match purpose {
        Purpose::Fit => only_simulated.contains(&number),
        Purpose::Validate(_) => true,
    };
    let (kept, to_fit): (Vec<&Prepared>, Vec<&Prepared>) =
        (prepared.tightenings.iter()).partition(|one| is_kept(one.tightening.id.number));
    let outcomes = in_batches(&to_fit, |batch| fitted(study, batch))?;
    let mut evaluated = Vec::new();
    for (one, outcome) in to_fit.iter().zip(outcomes) {
        match outcome {
            Ok(done) => evaluated.push(done),
            Err(error) => {
                let is_short = matches!(error, IdentifyError::TooShort { .. });
                let counts = is_short.then(|| study.what_counts()).flatten();
                let why = iter::once(error.to_string()).chain(counts);
                let why: Vec<String> = why.collect();
                findings.push(not_identified(&one.tightening.id, &why.join("; ")));
            }
        }
    }
    let found_here = || {
        mean_estimate(
            evaluated
                .iter()
                .filter_map(|one| one.result.estimate.as_ref()),
        )
    };
    let found = match purpose {
        Purpose::Fit => found_here(),
        Purpose::Validate(found) => found.cloned(),
    };
    for one in kept {
        match &found {
            Some(found) => {
                findings.extend(not_scored(study, one));
                evaluated.push(validated(study, one, found)?);
            }
            None => findings.push(nothing_to_validate(&one.tightening.id)),
        }
    }
    let done: Vec<u32> = evaluated.iter().map(|one| one.result.id.number).collect();
    for segment in &prepared.segments {
        if !done.contains(&segment.number) {
            let mut without = without_estimate(study, recording, segment);
            if is_kept(segment.number) {
                let rejections = &mut without.result.selection.rejections;
                rejections.push(Rejection::Validation);
            }
            evaluated.push(without);
        }
    }
    for one in &mut evaluated {
        let mut segments = prepared.segments.iter();
        let own = segments.find(|segment| segment.number == one.result.id.number);
        let times_s = own.and_then(|segment| segment.event_times_s);
        one.result.started_at_s = times_s.map(|[start_s, ..]| start_s);
    }
    evaluated.sort_by_key(|one| one.result.id.number);
    Ok((evaluated, findings))
}

/// Says that a validation window ends before its scored samples begin.
fn not_scored(study: &Study, prepared: &Prepared) -> Option<Finding> {
    let tightening = &prepared.tightening;
    let (unscored, samples) = (
        study.validation.unscored_samples,
        tightening.torque_nm.len(),
    );
    (unscored >= samples).then(|| Finding {
        severity: Severity::LeftOut,
        code: "nothing_scored".to_owned(),
        file: tightening.id.file.clone(),
        tightening: Some(tightening.id.number),
        channel: None,
        message: format!(
            "validation.unscored_samples is {unscored}, but only {samples} samples are there; nothing is scored"
        ),
    })
}

fn nothing_to_validate(id: &TighteningId) -> Finding {
    Finding {
        severity: Severity::LeftOut,
        code: "nothing_to_validate".to_owned(),
        file: id.file.clone(),
        tightening: Some(id.number),
        channel: None,
        message: "kept for validation, but no fit of what is not kept found an optimum whose parameters it could be simulated with"
            .to_owned(),
    }
}

fn not_identified(id: &TighteningId, why: &str) -> Finding {
    Finding {
        severity: Severity::LeftOut,
        code: "not_identified".to_owned(),
        file: id.file.clone(),
        tightening: Some(id.number),
        channel: None,
        message: format!("{why}; the tightening is left out"),
    }
}
