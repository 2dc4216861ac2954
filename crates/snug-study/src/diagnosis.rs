//! A study diagnosed: tightenings to the diagnosis, its models back into the study, every rung of the ladder evaluated.

mod restarted;
mod rung_study;
mod search;
mod shorter_steps;
mod verb;

use crate::error::StudyError;
use crate::evaluation::rungs::Ladder;
use crate::progress::ProgressEvent;
use crate::run::output::Workplace;
use crate::run::settings::RunSettings;
use crate::run::{Outcome, Task, pool, run_with};
use crate::study::Study;
use crate::tasks::cases::{chosen, with_settled};
use crate::tasks::comparable::Comparable;
use crate::tasks::own_effects::effects;
use crate::tasks::settling::{Settled, settle};
use restarted::{Found, Restarted};
use rung_study::with_rung;
use search::Search;
use shorter_steps::in_short_enough_steps;
use snug_diagnose::{Answer, DiagnoseError, Goal, Question, RungModel};
use snug_identify::FitTask;
use snug_model::Scale;
use std::sync::atomic::{AtomicBool, Ordering};
pub use verb::Verb;

/// The study as it is, whose findings name the reason; an error where it has tightenings all the same.
fn nothing_to_compare(
    study: &Study,
    workplace: Workplace,
    settings: &RunSettings,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<Outcome, StudyError> {
    let outcome = run_with(Task::of(study), workplace, settings, progress, interrupted)?;
    match (
        outcome.result.tightenings.len(),
        outcome.nothing_identified(),
    ) {
        // The outcome says of the first why it could not be used.
        (0, _) | (_, Some(_)) => Ok(outcome),
        (_, None) => Err(DiagnoseError::NothingToCompare {
            reason: outcome
                .first_left_out()
                .unwrap_or_else(|| "each is kept for validation or too short".to_owned()),
        }
        .into()),
    }
}

/// Diagnoses a study and runs it with the model that came of it.
///
/// The outcome's `study.ron` holds that model, sizes that all tightenings share held at their estimates with their
/// standard errors, so that it can be run again and diagnosed further.
///
/// When `interrupted` becomes true, the search goes no further, and everything is written, and marked, for the model it has
/// reached.
///
/// # Errors
/// As [`crate::run()`]; [`StudyError::Interrupted`] while the tightenings are still being read; and when there are tightenings, but none can be compared with the model.
pub fn diagnose(
    study: &Study,
    verb: &Verb,
    settings: &RunSettings,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<Outcome, StudyError> {
    study.check()?;
    let workplace = Workplace::new(study, settings, interrupted)?;
    let (disk, files) = (&*settings.disk, workplace.listing.files.clone());
    progress(ProgressEvent::Stage {
        what: "reading tightenings",
    });
    let pool = pool(settings.threads)?;
    let most = study.diagnosis.most_tightenings;
    let (comparable, kept) = pool.install(|| chosen(study, disk, &files, most, &|_| ()))?;
    if interrupted.load(Ordering::Relaxed) {
        return Err(StudyError::Interrupted);
    }
    if comparable.cases.is_empty() {
        return nothing_to_compare(study, workplace, settings, progress, interrupted);
    }
    let (last, ladder) =
        pool.install(|| climbed(study, &comparable, verb, progress, interrupted))?;
    // Who ended the search wants to see what it found of all tightenings.
    let never = AtomicBool::new(false);
    let interrupted = match interrupted.load(Ordering::Relaxed) {
        true => &never,
        false => interrupted,
    };
    let task = Task {
        ladder: Some(ladder),
        kept,
        ..Task::of(&last)
    };
    run_with(task, workplace, settings, progress, interrupted)
}

/// What a verb makes of a study with these tightenings, of which there are some: the study with the model of the last rung, and the
/// ladder up to there.
pub(crate) fn climbed(
    study: &Study,
    comparable: &Comparable,
    verb: &Verb,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<(Study, Ladder), StudyError> {
    let may_ask = study.model.steps_per_sample.is_none();
    let (_, climbed) = in_short_enough_steps(study.clone(), progress, |study| {
        climbed_in_steps(study, may_ask, comparable, verb, progress, interrupted)
    })?;
    Ok(climbed)
}

/// The same, simulated as the study says; asking for shorter steps where it may.
fn climbed_in_steps(
    study: &Study,
    may_ask: bool,
    comparable: &Comparable,
    verb: &Verb,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<(Study, Ladder), StudyError> {
    let (recorded, left_out) = (&comparable.cases, &comparable.reasons);
    let settled = settle(study, recorded);
    let as_told = study;
    let lent = || recorded.iter().map(FitTask::lent).collect();
    let (study, cases, reasons) = match &settled {
        Some(Settled { study, reasons, .. }) => {
            (study, with_settled(study, lent())?, reasons.as_slice())
        }
        None => (study, lent(), [].as_slice()),
    };
    let mut search = study.diagnosis.search.clone();
    search.seed = search.seed.wrapping_add(study.seed);
    search.for_prediction |= study.validation.keeps_any();
    let question = Question {
        cases: &cases,
        effects: effects(study, &study.model.effects, &cases)?,
        by_group: study.sizes_by_group(),
        custom: study.model.custom_effects()?,
        goal: goal(study, verb, &cases)?,
        may_ask_for_steps: may_ask && matches!(study.model.scale, Scale::Rig { .. }),
        until: None,
        units: study.source.units(study.preprocess.rig.lever_arm_m),
    };
    let search = Search {
        settings: &search,
        verb,
        progress,
        interrupted,
    };
    let may_run_freely = settled
        .as_ref()
        .is_some_and(|settled| settled.may_run_freely);
    let Found {
        mut answer,
        study: other,
        runs_freely,
        ..
    } = match may_run_freely && *verb == Verb::Improve {
        true => Restarted { study, as_told }.answer(&lent, &question, &search)?,
        false => Found::as_searched(search.answer(study, &question)?),
    };
    let told = &mut answer.diagnosis.reasons;
    if !runs_freely {
        told.extend_from_slice(reasons);
    }
    told.extend_from_slice(left_out);
    Ok(climb(other.as_ref().unwrap_or(study), answer))
}

fn goal(study: &Study, verb: &Verb, cases: &[FitTask<'_>]) -> Result<Goal, StudyError> {
    Ok(match verb {
        Verb::Compare => Goal::Compare,
        Verb::Diagnose => Goal::Diagnose,
        Verb::Add(names) => Goal::Add(effects(study, names, cases)?),
        Verb::Improve => Goal::Improve,
    })
}

/// The study with the model of the last rung, and the ladder up to there.
fn climb(study: &Study, answer: Answer) -> (Study, Ladder) {
    let has_changed = answer.models.len() > 1;
    let of_rung = |rung: &RungModel| match has_changed {
        true => with_rung(study, rung),
        false => study.clone(),
    };
    let mut before: Vec<Study> = answer.models.iter().map(of_rung).collect();
    let last = before.pop().unwrap_or_else(|| study.clone());
    let diagnosis = answer.diagnosis;
    (last, Ladder { diagnosis, before })
}
