//! `compare`, `diagnose`, `add`, `improve` and `remove`; the last three rewrite a study file where they are told to.

use super::run::{carry_out, refused, study_of};
use crate::arguments::{ChangeOptions, RunOptions};
use crate::error::CliError;
use crate::front::Front;
use snug_study::{Outcome, Study, StudyError, Verb};
use std::process::ExitCode;
use std::time::Duration;

/// How long `improve` looks for effects where nobody says how long. Chosen: with what is looked at afterwards less than five minutes; most
/// rigs take one or two.
const LONGEST_SEARCH: Duration = Duration::from_secs(240);

/// Model against measurement: `compare`, `diagnose`.
pub fn diagnose(options: &RunOptions, front: &Front, verb: &Verb) -> ExitCode {
    match study_of(options, front) {
        Ok(study) => evaluate(&study, options, verb, &repeated(options), false),
        Err(error) => refused(&error),
    }
}

/// A model that changes: `add`, `improve`.
pub fn change(options: &ChangeOptions, front: &Front, verb: &Verb) -> ExitCode {
    let study = study_of(&options.run, front).and_then(|study| {
        study.check_effects(verb.effects())?;
        Ok(study)
    });
    match study {
        Ok(study) => {
            let again = repeated(&options.run);
            evaluate(&study, &options.run, verb, &again, options.write)
        }
        Err(error) => refused(&error),
    }
}

/// Takes effects out of the study's model and compares what is left with the measurement.
pub fn remove(options: &ChangeOptions, front: &Front, effects: &[String]) -> ExitCode {
    let study = study_of(&options.run, front).and_then(|mut study| {
        let present = &mut study.model.effects;
        if let Some(effect) = effects.iter().find(|effect| !present.contains(effect)) {
            let (effect, present) = (effect.clone(), present.clone());
            return Err(CliError::from(StudyError::NotInModel { effect, present }));
        }
        present.retain(|effect| !effects.contains(effect));
        Ok(study)
    });
    match study {
        Ok(study) => {
            let again = format!("--study {}", options.run.out.join("study.ron").display());
            evaluate(&study, &options.run, &Verb::Compare, &again, options.write)
        }
        Err(error) => refused(&error),
    }
}

/// Evaluates, and puts the model's effects into the study file where it is to be written; `again` are the options with which
/// the next command goes on.
fn evaluate(
    study: &Study,
    options: &RunOptions,
    verb: &Verb,
    again: &str,
    write: bool,
) -> ExitCode {
    let longest = (*verb == Verb::Improve).then_some(LONGEST_SEARCH);
    let longest = options.time.or(longest);
    carry_out(
        options,
        longest,
        again,
        |settings, progress, interrupted| {
            let outcome = snug_study::diagnose(study, verb, settings, progress, interrupted)?;
            if write {
                write_back(options, &outcome)?;
            }
            Ok(outcome)
        },
    )
}

/// A study file gets a model that is complete, or none.
fn write_back(options: &RunOptions, outcome: &Outcome) -> Result<(), StudyError> {
    let is_complete = |one: &snug_campaign::Diagnosis| !one.interrupted;
    match &options.study {
        Some(path) if outcome.result.diagnosis.as_ref().is_some_and(is_complete) => {
            let laws = Study::parse(&outcome.result.study_ron, path)?.model.custom;
            snug_study::rewrite_effects(path, &outcome.result.effects, &laws)
        }
        _ => Ok(()),
    }
}

/// The options to repeat in the next command.
fn repeated(options: &RunOptions) -> String {
    let mut words = Vec::new();
    if let Some(study) = &options.study {
        words.push(format!("--study {}", study.display()));
    }
    if let Some(data) = &options.data {
        words.push(format!("--data {}", data.display()));
    }
    if let Some(preset) = options.preset {
        words.push(format!("--preset {}", format!("{preset:?}").to_lowercase()));
    }
    words.join(" ")
}
