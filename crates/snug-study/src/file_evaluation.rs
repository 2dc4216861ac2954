//! One measurement file, from bytes to results.

use crate::evaluation::{Evaluated, fitted, validated, without_estimate};
use crate::{Study, StudyError};
use rayon::prelude::*;
use snug_campaign::{Estimate, Finding, FitStatus, Recording, Rejection, Severity, TighteningId};
use snug_files::Disk;
use snug_identify::SIDE_BY_SIDE;
use snug_ingest::IngestError;
use snug_preprocess::{Prepared, Preset, Window, preprocess};
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
}

/// Reads, prepares and evaluates one file. What cannot be used becomes a finding.
pub fn evaluate_file(
    study: &Study,
    disk: &dyn Disk,
    path: &Path,
) -> Result<FileEvaluation, StudyError> {
    let _span = tracing::info_span!("file", path = %path.display()).entered();
    let lever_arm_m = study.preprocess.rig.lever_arm_m;
    let ingested = match snug_ingest::read_on(disk, &study.source, path, lever_arm_m) {
        Ok(ingested) => ingested,
        Err(error) => {
            tracing::warn!(%error, "the file is left out");
            return Ok(FileEvaluation {
                recordings: Vec::new(),
                evaluated: Vec::new(),
                findings: vec![error.finding()],
                other_preset: other(study).map(|_| Vec::new()),
            });
        }
    };
    let mut findings = ingested.findings;
    let mut evaluated = Vec::new();
    let other = other(study);
    let mut other_preset = other.as_ref().map(|_| Vec::new());
    for recording in &ingested.recordings {
        evaluated.extend(evaluate(study, recording, &mut findings)?);
        if let (Some(other), Some(there)) = (&other, &mut other_preset) {
            let mut seen = Vec::new();
            there.extend(outcomes(&evaluate(other, recording, &mut seen)?));
            if study.preprocess.preset == Preset::Thesis {
                findings.extend(seen.into_iter().map(as_note));
            }
        }
    }
    tracing::info!(
        tightenings = evaluated.len(),
        findings = findings.len(),
        "the file is evaluated"
    );
    Ok(FileEvaluation {
        recordings: ingested.recordings,
        evaluated,
        findings,
        other_preset,
    })
}

/// Reads, prepares and evaluates one file under the study's own preset only; the inner error says why it cannot be read.
pub fn evaluate_alone(
    study: &Study,
    disk: &dyn Disk,
    path: &Path,
) -> Result<Result<Vec<Evaluated>, IngestError>, StudyError> {
    let lever_arm_m = study.preprocess.rig.lever_arm_m;
    let ingested = match snug_ingest::read_on(disk, &study.source, path, lever_arm_m) {
        Ok(ingested) => ingested,
        Err(error) => return Ok(Err(error)),
    };
    let mut evaluated = Vec::new();
    for recording in &ingested.recordings {
        evaluated.extend(evaluate(study, recording, &mut Vec::new())?);
    }
    Ok(Ok(evaluated))
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

/// Prepares and evaluates one recording: every segment gives a result, with an estimate or with the reason for none.
fn evaluate(
    study: &Study,
    recording: &Recording,
    findings: &mut Vec<Finding>,
) -> Result<Vec<Evaluated>, StudyError> {
    let prepared = preprocess(recording, &study.preprocess, study.identify.fitted_output)?;
    findings.extend(prepared.findings);
    let only_simulated = study.validation_segments();
    let (kept, to_fit): (Vec<&Prepared>, Vec<&Prepared>) = prepared
        .tightenings
        .iter()
        .partition(|one| only_simulated.contains(&one.tightening.id.number));
    let groups = (to_fit.par_chunks(SIDE_BY_SIDE))
        .map(|group| fitted(study, group))
        .collect::<Result<Vec<_>, StudyError>>()?;
    let mut evaluated = Vec::new();
    for (one, outcome) in to_fit.iter().zip(groups.into_iter().flatten()) {
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
    Ok(evaluated)
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
