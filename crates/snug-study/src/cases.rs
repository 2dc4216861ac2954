//! Tightenings as the diagnosis takes them.

use crate::comparable::{Comparable, comparable};
use crate::evaluation::input;
use crate::{Study, StudyError};
use rayon::prelude::*;
use snug_campaign::Rejection;
use snug_diagnose::Case;
use snug_preprocess::preprocess;
use std::path::{Path, PathBuf};

/// Reads and prepares at most `most` tightenings, evenly spread over the files and within each; tightenings with faulty
/// data, those kept for validation and those that cannot be judged by the same measure as the others take no part.
pub fn cases(study: &Study, files: &[PathBuf], most: usize) -> Result<Vec<Case>, StudyError> {
    Ok(chosen(study, files, most)?.cases)
}

/// The same, with what is to be said of those that take no part.
pub(crate) fn chosen(
    study: &Study,
    files: &[PathBuf],
    most: usize,
) -> Result<Comparable, StudyError> {
    let stride = files.len().div_ceil(most.max(1)).max(1);
    let some: Vec<&PathBuf> = files.iter().step_by(stride).collect();
    let most_each = (most / some.len().max(1)).max(1);
    let read = some
        .par_iter()
        .map(|path| {
            let mut cases = cases_of_file(study, path)?;
            let stride = cases.len().div_ceil(most_each).max(1);
            let mut index = 0;
            cases.retain(|_| {
                index += 1;
                (index - 1) % stride == 0
            });
            Ok(cases)
        })
        .collect::<Vec<Result<_, StudyError>>>();
    let read = read.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(comparable(read.into_iter().flatten().collect()))
}

fn cases_of_file(study: &Study, path: &Path) -> Result<Vec<Case>, StudyError> {
    let lever_arm_m = study.preprocess.rig.lever_arm_m;
    // What cannot be read, and everything else that is left out, the run of the study names in its findings.
    let Ok(ingested) = snug_ingest::read(&study.source, path, lever_arm_m) else {
        return Ok(Vec::new());
    };
    let only_simulated = study.validation_segments();
    let mut cases = Vec::new();
    for recording in &ingested.recordings {
        let prepared = preprocess(recording, &study.preprocess, study.identify.fitted_output)?;
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
    Ok(cases)
}
