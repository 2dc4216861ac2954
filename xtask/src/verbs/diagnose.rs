//! `cargo xtask compare`, `diagnose`, `add`, `improve` and `remove`; the last three may rewrite the study file.

use super::run::{carry_out, refused, study};
use crate::arguments::RunOptions;
use crate::exit;
use crate::terminal::say;
use snug_study::{StudyError, Verb};
use std::path::Path;
use std::process::ExitCode;

/// Model against measurement: `compare`, `diagnose`, `add`, `improve`.
pub fn diagnose(options: &RunOptions, verb: &Verb) -> ExitCode {
    let study = match study(options).and_then(|study| {
        study.check_effects(verb.effects())?;
        Ok(study)
    }) {
        Ok(study) => study,
        Err(error) => return refused(&error),
    };
    carry_out(
        options,
        &repeated(options),
        |settings, progress, interrupted| {
            let outcome = snug_study::diagnose(&study, verb, settings, progress, interrupted)?;
            let diagnosis = outcome.result.diagnosis.as_ref();
            // A study file gets a model that is complete, or none.
            let is_complete = diagnosis.is_some_and(|one| !one.interrupted);
            if let (Some(path), Verb::Add(_) | Verb::Improve, true) =
                (&options.study, verb, is_complete)
            {
                let laws = snug_study::Study::parse(&outcome.result.study_ron, path)?
                    .model
                    .custom;
                snug_study::rewrite_effects(path, &outcome.result.effects, &laws)?;
            }
            Ok(outcome)
        },
    )
}

/// Takes an effect out of a study file's model.
pub fn remove(study: &Path, effect: &str) -> ExitCode {
    let taken_out = snug_study::Study::read(study).and_then(|known| {
        let mut effects = known.model.effects;
        if !effects.iter().any(|name| name == effect) {
            return Err(StudyError::NotInModel {
                effect: effect.to_owned(),
                present: effects,
            });
        }
        effects.retain(|name| name != effect);
        snug_study::rewrite_effects(study, &effects, &[])?;
        Ok(effects)
    });
    match taken_out {
        Ok(effects) => {
            let left = match effects.as_slice() {
                [] => "the base model".to_owned(),
                some => some.join(" + "),
            };
            let told = format!(
                "{}: {effect} is taken out; the model is {left}\n",
                study.display()
            );
            say(&told, exit::DONE)
        }
        Err(error) => refused(&error),
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
