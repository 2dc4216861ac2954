//! One measurement file, from bytes to results.

use crate::evaluation::{Evaluated, fitted, validated, without_estimate};
use crate::prepared_file::PreparedFile;
use crate::rungs::{Ladder, RungShare};
use crate::{Study, StudyError};
use snug_campaign::{Estimate, Finding, FitStatus, Recording, Rejection, Severity, TighteningId};
use snug_files::Disk;
use snug_identify::in_batches;
use snug_preprocess::{Prepared, Preprocessed, Preset, Window, preprocess};
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

/// Evaluates one file, which is read and prepared unless it was kept: with the run's own study, and with those of the rungs
/// before it. What cannot be used becomes a finding.
pub fn evaluate_file(
    study: &Study,
    ladder: Option<&Ladder>,
    disk: &dyn Disk,
    path: &Path,
    kept: Option<PreparedFile>,
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
    for (recording, prepared) in file.recordings {
        for (rung, share) in rungs_before(ladder).iter().zip(&mut whole.rungs) {
            let (evaluated, _) = evaluate(rung, &recording, &prepared)?;
            share.add(RungShare::of(&evaluated, ladder.and_then(Ladder::shown)));
        }
        let (evaluated, findings) = evaluate(study, &recording, &prepared)?;
        whole.findings.extend(prepared.findings);
        whole.findings.extend(findings);
        if let (Some(other), Some(there)) = (&other, &mut whole.other_preset) {
            let prepared = preprocess(&recording, &other.preprocess, other.identify.fitted_output)?;
            let (evaluated, findings) = evaluate(other, &recording, &prepared)?;
            there.extend(outcomes(&evaluated));
            if study.preprocess.preset == Preset::Thesis {
                let seen = prepared.findings.into_iter().chain(findings);
                whole.findings.extend(seen.map(as_note));
            }
        }
        if let (Some(ladder), Some(last)) = (ladder, whole.rungs.last_mut()) {
            last.add(RungShare::of(&evaluated, ladder.shown()));
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
    if study.preprocess.window == Window::Whole {
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
) -> Result<(Vec<Evaluated>, Vec<Finding>), StudyError> {
    let mut findings = Vec::new();
    let only_simulated = study.validation_segments();
    let (kept, to_fit): (Vec<&Prepared>, Vec<&Prepared>) = prepared
        .tightenings
        .iter()
        .partition(|one| only_simulated.contains(&one.tightening.id.number));
    let outcomes = in_batches(&to_fit, |batch| fitted(study, batch))?;
    let mut evaluated = Vec::new();
    for (one, outcome) in to_fit.iter().zip(outcomes) {
        match outcome {
            Ok(done) => evaluated.push(done),
            Err(error) => {
                findings.push(not_identified(&one.tightening.id, &error.to_string()));
            }
        }
    }
    if let Some(mean) = mean_estimate(&evaluated) {
        for one in kept {
            findings.extend(not_scored(study, one));
            evaluated.push(validated(study, one, &mean)?);
        }
    }
    let done: Vec<u32> = evaluated.iter().map(|one| one.result.id.number).collect();
    for segment in &prepared.segments {
        if !done.contains(&segment.number) {
            evaluated.push(without_estimate(study, recording, segment));
        }
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

/// The mean of every parameter over a file's converged fits, carried by the first of them.
fn mean_estimate(evaluated: &[Evaluated]) -> Option<Estimate> {
    let converged: Vec<&Estimate> = evaluated
        .iter()
        .filter_map(|one| one.result.estimate.as_ref())
        .filter(|estimate| {
            matches!(
                estimate.status,
                FitStatus::Converged | FitStatus::ConvergedAtConstraint
            )
        })
        .collect();
    let mut mean = (*converged.first()?).clone();
    for (index, parameter) in mean.parameters.iter_mut().enumerate() {
        let sum: f64 = converged.iter().map(|e| e.parameters[index].value).sum();
        parameter.value = sum / converged.len() as f64;
    }
    Some(mean)
}
