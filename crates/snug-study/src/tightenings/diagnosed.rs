//! Tightenings that were prepared before and are kept in a place of their own: a sample of them diagnosed, and all of them asked, one by
//! one, of the sizes that they share.

use crate::diagnosis::{Verb, climbed};
use crate::error::StudyError;
use crate::evaluation::file::outcomes;
use crate::evaluation::rungs::{RungShare, Simulated};
use crate::evaluation::tightening::{Evaluated, fitted};
use crate::progress::ProgressEvent;
use crate::run::examples::Examples;
use crate::run::{Collected, pool};
use crate::study::Study;
use crate::tasks::cases::case_of;
use crate::tasks::comparable::comparable;
use crate::tasks::own_effects::effects;
use serde::{Deserialize, Serialize};
use snug_campaign::{CampaignResult, Quantity, Tightening};
use snug_diagnose::{DiagnoseError, SharedBlock, SharedParameter};
use snug_identify::{FitTask, in_batches};
use snug_preprocess::Prepared;
use std::sync::atomic::AtomicBool;

/// What tightenings are compared by: only those that have it in common add up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Compared {
    /// The output.
    pub quantity: Quantity,
    /// Whether its noise is known, so that residuals are in units of it.
    pub is_over_noise: bool,
}

/// What a diagnosis of prepared tightenings came to.
#[derive(Debug, Clone)]
pub struct PreparedDiagnosis {
    /// Everything that was found out, of these tightenings.
    pub result: CampaignResult,
    /// The study with the model of each rung of the ladder; the first is the study's own.
    pub rungs: Vec<Study>,
    /// What they are compared by.
    pub compared: Compared,
}

/// Diagnoses prepared tightenings as [`crate::diagnose()`] diagnoses those of files, and evaluates every rung of the ladder on them;
/// nothing is read or written.
///
/// # Errors
/// As [`crate::diagnose()`].
pub fn diagnose_prepared(
    study: &Study,
    prepared: &[Prepared],
    verb: &Verb,
    threads: Option<usize>,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<PreparedDiagnosis, StudyError> {
    study.check()?;
    let comparable = comparable(cases_of(study, prepared)?);
    let compared = common(&comparable.cases)?;
    let pool = pool(threads)?;
    let (last, ladder) =
        pool.install(|| climbed(study, &comparable, verb, progress, interrupted))?;
    progress(ProgressEvent::Stage {
        what: "evaluating every rung",
    });
    let shown = ladder.shown().cloned();
    let mut rungs = ladder.before.clone();
    rungs.push(last);
    let (collected, shares) =
        pool.install(|| evaluated(&rungs, prepared, Examples::with(shown)))?;
    let last = &rungs[rungs.len() - 1];
    let mut result = collected.result(last, last.to_ron()?)?;
    // Only what was prepared is there: the other preset would prepare it anew.
    result.presets.truncate(1);
    result.diagnosis = Some(ladder.completed(shares));
    Ok(PreparedDiagnosis {
        result,
        rungs,
        compared,
    })
}

/// What most of these tightenings can be compared by.
///
/// # Errors
/// [`StudyError`] where none can be.
pub fn compared_by(study: &Study, prepared: &[Prepared]) -> Result<Compared, StudyError> {
    common(&comparable(cases_of(study, prepared)?).cases)
}

fn cases_of(study: &Study, prepared: &[Prepared]) -> Result<Vec<FitTask<'static>>, StudyError> {
    let cases = prepared.iter().map(|one| case_of(study, one));
    Ok((cases.collect::<Result<Vec<_>, _>>()?.into_iter().flatten()).collect())
}

/// What comparable cases have in common.
fn common(cases: &[FitTask<'_>]) -> Result<Compared, StudyError> {
    match cases.first() {
        Some(first) => Ok(compared(first)),
        None => Err(DiagnoseError::NothingToCompare {
            reason: "each is faulty or too short; the findings of the dataset say why".into(),
        }
        .into()),
    }
}

/// The tightenings with the model of every rung: results of the last, with what the first simulates beside it, and shares of all.
fn evaluated(
    rungs: &[Study],
    prepared: &[Prepared],
    examples: Examples,
) -> Result<(Collected, Vec<RungShare>), StudyError> {
    let all: Vec<&Prepared> = prepared.iter().collect();
    let mut collected = Collected::with(examples);
    let mut shares = Vec::new();
    let mut before = None;
    for (number, rung) in rungs.iter().enumerate() {
        let outcomes_of_rung = in_batches(&all, |batch| fitted(rung, batch))?;
        let mut evaluated: Vec<Evaluated> = outcomes_of_rung.into_iter().flatten().collect();
        shares.push(RungShare::of(&evaluated));
        if number + 1 < rungs.len() {
            before.get_or_insert_with(|| Simulated::of(evaluated));
            continue;
        }
        if let Some(before) = before.take() {
            before.stand_beside(&mut evaluated);
        }
        collected.here.extend(outcomes(&evaluated));
        for Evaluated { result, traces, .. } in evaluated {
            collected.keep(result, traces);
        }
    }
    Ok((collected, shares))
}

fn compared(case: &FitTask<'_>) -> Compared {
    Compared {
        quantity: case.quantity(),
        is_over_noise: case.whitening().is_some(),
    }
}

/// The sizes that tightenings like this one share in the study's model; those that the study holds are not among them.
///
/// # Errors
/// [`StudyError`] for a tightening that cannot be compared with the model, and for what the model refuses.
pub fn shared_parameters(
    study: &Study,
    prepared: &Prepared,
) -> Result<Vec<SharedParameter>, StudyError> {
    let Ok(case) = case_of(study, prepared)? else {
        let reason = "it is faulty or too short".into();
        return Err(DiagnoseError::NothingToCompare { reason }.into());
    };
    let effects = effects(study, &study.model.effects, std::slice::from_ref(&case))?;
    Ok(snug_diagnose::shared_parameters(&case, &effects)?)
}

/// What prepared tightenings say of the sizes that they share in the study's model, each at those that `sizes` gives it; `None` where
/// one cannot be compared as the others are, or not be fitted beside these sizes. One has the same bits whatever stands beside it.
///
/// # Errors
/// What the model refuses.
pub fn shared_blocks(
    study: &Study,
    compared_by: Compared,
    prepared: &[&Prepared],
    sizes: &dyn Fn(&Tightening) -> Vec<f64>,
) -> Result<Vec<Option<SharedBlock>>, StudyError> {
    let mut blocks = vec![None; prepared.len()];
    let mut places = Vec::new();
    let mut cases = Vec::new();
    for (place, one) in prepared.iter().enumerate() {
        let case = case_of(study, one)?
            .ok()
            .filter(|case| compared(case) == compared_by);
        if let Some(case) = case {
            places.push(place);
            cases.push(case);
        }
    }
    let effects = effects(study, &study.model.effects, &cases)?;
    let sizes: Vec<Vec<f64>> = cases.iter().map(|case| sizes(&case.tightening)).collect();
    if cases.is_empty() {
        return Ok(blocks);
    }
    let found = snug_diagnose::shared_blocks(&cases, &effects, &sizes)?;
    for (place, block) in places.into_iter().zip(found) {
        blocks[place] = block;
    }
    Ok(blocks)
}
