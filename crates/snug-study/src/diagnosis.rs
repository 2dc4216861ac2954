//! A study diagnosed: tightenings to the diagnosis, its models back into the study, every rung of the ladder evaluated.

mod restarted;
mod search;

use crate::error::StudyError;
use crate::evaluation::rungs::Ladder;
use crate::progress::ProgressEvent;
use crate::run::output::Workplace;
use crate::run::settings::RunSettings;
use crate::run::{Outcome, Task, pool, run_with};
use crate::study::Study;
use crate::tasks::cases::{chosen, with_settled};
use crate::tasks::comparable::Comparable;
use crate::tasks::settling::{Settled, settle};
use restarted::{Found, Restarted};
use search::Search;
use snug_campaign::{GroupSize, GroupSizes};
use snug_diagnose::{Answer, Begun, DiagnoseError, Goal, Question, RungModel};
use snug_identify::FitTask;
use snug_model::{Effect, GroupValue, ParameterSettings, Scale, ValuesByGroup};
use std::sync::atomic::{AtomicBool, Ordering};

/// A verb of the diagnosis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verb {
    /// Model against measurement, and where it fails.
    Compare,
    /// The same, and which effect is missing; the study stays as it is.
    Diagnose,
    /// These effects are added to the study's model.
    Add(Vec<String>),
    /// Effects are added as long as the data justify it, or until it is interrupted.
    Improve,
}

impl Verb {
    /// The effects it names.
    pub fn effects(&self) -> &[String] {
        match self {
            Self::Add(effects) => effects,
            _ => &[],
        }
    }
}

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

/// What is found with a study, simulated in shorter steps as long as it asks for them, and the study with those.
fn in_short_enough_steps<T>(
    mut study: Study,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    find: impl Fn(&Study) -> Result<T, StudyError>,
) -> Result<(Study, T), StudyError> {
    loop {
        match find(&study) {
            Err(StudyError::Diagnose(DiagnoseError::Unresolved { steps })) => {
                let what = format!("simulating in {steps} steps from sample to sample");
                progress(ProgressEvent::Stage { what: &what });
                study.model.steps_per_sample = Some(steps);
            }
            found => return found.map(|found| (study, found)),
        }
    }
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

/// The named effects, the study's own among them, as they act on its rig.
pub(crate) fn effects(
    study: &Study,
    names: &[String],
    cases: &[FitTask<'_>],
) -> Result<Vec<Effect>, StudyError> {
    let Some(first) = cases.first() else {
        return Ok(Vec::new());
    };
    let scale = study.model.scale;
    let named = names.iter().map(|name| {
        let effect = study.model.effect(name)?;
        scale.effect(effect, &first.tightening.rig)
    });
    Ok(named.collect::<Result<_, _>>()?)
}

/// The study with the model of the last rung, and the ladder up to there.
fn climb(study: &Study, answer: Answer) -> (Study, Ladder) {
    let changes = answer.models.len() > 1;
    let mut before: Vec<Study> = (answer.models.iter())
        .map(|model| with_model(study, model, changes))
        .collect();
    let last = before.pop().unwrap_or_else(|| study.clone());
    let diagnosis = answer.diagnosis;
    (last, Ladder { diagnosis, before })
}

/// The sizes of groups as a study says them.
fn values_by_group(sizes: &GroupSizes) -> ValuesByGroup {
    let value = |one: &GroupSize| GroupValue {
        value: one.value,
        standard_error: one.standard_error,
    };
    let values = sizes
        .groups
        .iter()
        .map(|one| (one.group.clone(), value(one)));
    ValuesByGroup {
        factor: sizes.factor.clone(),
        values: values.collect(),
    }
}

/// The study with the model of the last rung.
fn with_last_model(study: &Study, answer: &Answer) -> Study {
    let last = answer.models.last();
    last.map_or_else(|| study.clone(), |model| with_model(study, model, true))
}

/// These effects one after the other as the rungs of `answer` have them; where none has just these, as its last has them.
fn begun(effects: Vec<Effect>, answer: &Answer) -> Vec<Begun> {
    let names: Vec<&str> = effects.iter().map(Effect::name).collect();
    let with = |first: &[&str]| {
        let has_just = |rung: &&RungModel| {
            rung.effects.len() == first.len()
                && first
                    .iter()
                    .all(|name| rung.effects.iter().any(|one| one == name))
        };
        let mut rungs = answer.models.iter().rev();
        rungs.find(has_just).or(answer.models.last())
    };
    (effects.iter().enumerate())
        .map(|(place, &effect)| Begun {
            effect,
            values: with(&names[..=place]).map_or_else(Vec::new, RungModel::values),
        })
        .collect()
}

/// The study with a rung's model. What all tightenings share is held where they put it together.
fn with_model(study: &Study, model: &RungModel, changes: bool) -> Study {
    let mut study = study.clone();
    if !changes {
        return study;
    }
    study.model.effects.clone_from(&model.effects);
    for declaration in &model.declarations {
        if !study
            .model
            .custom
            .iter()
            .any(|known| known.name == declaration.name)
        {
            study.model.custom.push(declaration.clone());
        }
    }
    for (name, value) in &model.base {
        let told = study.model.parameters.entry(name.clone()).or_default();
        told.value = Some(*value);
    }
    for parameter in &model.parameters {
        if parameter.per_tightening {
            continue;
        }
        let told: &mut ParameterSettings = study
            .model
            .parameters
            .entry(parameter.name.clone())
            .or_default();
        if told.fixed && told.standard_error.is_none() {
            continue;
        }
        told.value = Some(parameter.value);
        told.fixed = true;
        told.standard_error = parameter.standard_error.or(Some(0.0));
        told.by_group = parameter.by_group.as_ref().map(values_by_group);
    }
    study
}
