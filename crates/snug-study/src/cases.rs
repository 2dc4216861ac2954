//! Tightenings as the diagnosis takes them.

use crate::evaluation::input;
use crate::{Study, StudyError};
use rayon::prelude::*;
use snug_campaign::{Finding, Rejection};
use snug_diagnose::Case;
use snug_preprocess::preprocess;
use std::path::{Path, PathBuf};

/// Reads and prepares at most `most` tightenings, evenly spread over the files and within each; tightenings with faulty
/// data and those kept for validation take no part.
pub fn cases(
    study: &Study,
    files: &[PathBuf],
    most: usize,
) -> Result<(Vec<Case>, Vec<Finding>), StudyError> {
    let stride = files.len().div_ceil(most.max(1)).max(1);
    let some: Vec<&PathBuf> = files.iter().step_by(stride).collect();
    let most_each = (most / some.len().max(1)).max(1);
    let read = some
        .par_iter()
        .map(|path| {
            let (mut cases, findings) = cases_of_file(study, path)?;
            let stride = cases.len().div_ceil(most_each).max(1);
            let mut index = 0;
            cases.retain(|_| {
                index += 1;
                (index - 1) % stride == 0
            });
            Ok((cases, findings))
        })
        .collect::<Vec<Result<_, StudyError>>>();
    let (mut cases, mut findings) = (Vec::new(), Vec::new());
    for file in read {
        let (some, found): (Vec<Case>, Vec<Finding>) = file?;
        cases.extend(some);
        findings.extend(found);
    }
    Ok((cases, findings))
}

fn cases_of_file(study: &Study, path: &Path) -> Result<(Vec<Case>, Vec<Finding>), StudyError> {
    let lever_arm_m = study.preprocess.rig.lever_arm_m;
    let ingested = match snug_ingest::read(&study.source, path, lever_arm_m) {
        Ok(ingested) => ingested,
        Err(error) => return Ok((Vec::new(), vec![error.finding()])),
    };
    let only_simulated = study.validation_segments();
    let (mut cases, mut findings) = (Vec::new(), ingested.findings);
    for recording in &ingested.recordings {
        let prepared = preprocess(recording, &study.preprocess, study.identify.fitted_output)?;
        findings.extend(prepared.findings);
        for one in prepared.tightenings {
            let faulty = one.rejections().contains(&Rejection::DataQuality);
            if faulty || only_simulated.contains(&one.tightening.id.number) {
                continue;
            }
            let input = input(study, &one);
            let tightening = one.tightening;
            let fitted = study.identify.fitted_output;
            // The noise is known of what was measured: that is where model and measurement are best compared.
            let quantity = tightening
                .noise
                .as_ref()
                .map(|noise| noise.quantity)
                .filter(|&quantity| tightening.motion.get(quantity).is_some())
                .unwrap_or(fitted);
            let case = Case {
                model: study.model.model(tightening.rig)?,
                input,
                quantity,
                unscored: study.identify.unscored_samples,
                constraints: study.identify.constraints.clone(),
                tightening,
            };
            if case.is_comparable() {
                cases.push(case);
            }
        }
    }
    Ok((cases, findings))
}
