//! A study diagnosed: tightenings to the diagnosis, its models back into the study, every rung of the ladder evaluated.

use crate::cases::{chosen, unread_files};
use crate::comparable::Comparable;
use crate::evaluation::Evaluated;
use crate::file_evaluation::evaluate_alone;
use crate::output::Workplace;
use crate::run::{Outcome, RunSettings, pool, run_with};
use crate::settling::{Settled, settle};
use crate::{ProgressEvent, Study, StudyError};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use snug_campaign::{Diagnosis, Rejection, Rung, Showcase, TighteningId, Traces};
use snug_diagnose::{Answer, Case, DiagnoseError, Goal, Question, RungModel, Watch, examine};
use snug_files::Disk;
use snug_ingest::IngestError;
use snug_model::{Effect, ParameterSettings};
use snug_statistics::descriptive::median;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// How a study is diagnosed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DiagnosisSettings {
    /// Most tightenings from which effects are learnt, evenly spread over the files; what was learnt is then applied to
    /// all. Default 240.
    pub most_tightenings: usize,
    /// How the missing effect is looked for.
    pub search: snug_diagnose::DiagnoseSettings,
}

impl Default for DiagnosisSettings {
    fn default() -> Self {
        Self {
            most_tightenings: 240,
            search: snug_diagnose::DiagnoseSettings::default(),
        }
    }
}

impl DiagnosisSettings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`StudyError::Setting`] names the first that is not allowed.
    pub fn check(&self) -> Result<(), StudyError> {
        let search = &self.search;
        let checks = [
            (
                "diagnosis.most_tightenings",
                self.most_tightenings as f64,
                self.most_tightenings >= 8,
                "at least 8",
            ),
            (
                "diagnosis.search.sign_flips",
                search.sign_flips as f64,
                search.sign_flips >= 99,
                "at least 99",
            ),
            (
                "diagnosis.search.level",
                search.level,
                search.level > 0.0 && search.level < 1.0,
                "between 0 and 1",
            ),
            (
                "diagnosis.search.smallest_gain",
                search.smallest_gain,
                (0.0..1.0).contains(&search.smallest_gain),
                "0 or more and below 1",
            ),
            (
                "diagnosis.search.smallest_gain_at_noise",
                search.smallest_gain_at_noise,
                (0.0..1.0).contains(&search.smallest_gain_at_noise),
                "0 or more and below 1",
            ),
            (
                "diagnosis.search.starts",
                search.starts as f64,
                search.starts >= 1,
                "at least 1",
            ),
        ];
        match checks.into_iter().find(|(_, _, is_allowed, _)| !is_allowed) {
            Some((setting, value, _, allowed)) => Err(StudyError::Setting {
                setting,
                value,
                allowed,
            }),
            None => Ok(()),
        }
    }
}

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
    let outcome = run_with(study, None, workplace, settings, progress, interrupted)?;
    match outcome.result.tightenings.len() {
        0 => Ok(outcome),
        tightenings => Err(DiagnoseError::NothingToCompare {
            tightenings,
            reason: "each is faulty or kept for validation; findings.json says why",
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
    let Comparable {
        cases,
        remarks: left_out,
    } = pool.install(|| chosen(study, disk, &files, most))?;
    if interrupted.load(Ordering::Relaxed) {
        return Err(StudyError::Interrupted);
    }
    if cases.is_empty() {
        return nothing_to_compare(study, workplace, settings, progress, interrupted);
    }
    let settled = pool.install(|| settle(study, &cases));
    let (study, cases, remarks) = match &settled {
        Some(Settled { study, remarks }) => {
            let again = pool.install(|| chosen(study, disk, &files, most))?;
            (study, again.cases, remarks.as_slice())
        }
        None => (study, cases, [].as_slice()),
    };
    let mut search = study.diagnosis.search.clone();
    search.seed = search.seed.wrapping_add(study.seed);
    let question = Question {
        cases: &cases,
        effects: effects(study, &study.model.effects, &cases)?,
        custom: study.model.custom_effects()?,
        goal: match verb {
            Verb::Compare => Goal::Compare,
            Verb::Diagnose => Goal::Diagnose,
            Verb::Add(names) => Goal::Add(effects(study, names, &cases)?),
            Verb::Improve => Goal::Improve,
        },
    };
    let tell = |what: &str| progress(ProgressEvent::Stage { what });
    let watch = Watch::new(&tell).until(interrupted);
    let mut answer = pool.install(|| examine(&question, &search, &watch))?;
    answer.diagnosis.reasons.extend_from_slice(remarks);
    answer.diagnosis.reasons.extend(left_out);
    drop(cases);
    let (last, diagnosis) = pool.install(|| climb(study, answer, disk, &files, progress))?;
    // Who ended the search wants to see what it found of all tightenings.
    let never = AtomicBool::new(false);
    let interrupted = match interrupted.load(Ordering::Relaxed) {
        true => &never,
        false => interrupted,
    };
    let told = Some(diagnosis);
    run_with(&last, told, workplace, settings, progress, interrupted)
}

/// The named effects, the study's own among them, as they act on its rig.
fn effects(study: &Study, names: &[String], cases: &[Case]) -> Result<Vec<Effect>, StudyError> {
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

/// Evaluates the study with the model of every rung; returns the last of these studies and the finished diagnosis.
fn climb(
    study: &Study,
    answer: Answer,
    disk: &dyn Disk,
    files: &[PathBuf],
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
) -> Result<(Study, Diagnosis), StudyError> {
    let mut diagnosis = answer.diagnosis;
    let shown = diagnosis
        .comparison
        .tightenings
        .first()
        .map(|worst| worst.id.clone());
    let changes = answer.models.len() > 1;
    let mut showcase: Vec<Option<Traces>> = Vec::new();
    let mut last = study.clone();
    for (rung, model) in diagnosis.ladder.iter_mut().zip(&answer.models) {
        last = with_model(study, model, changes);
        let text = match rung.effects.as_slice() {
            [] => "evaluating the base model".to_owned(),
            some => format!("evaluating {}", some.join(" + ")),
        };
        progress(ProgressEvent::Stage { what: &text });
        let mut unread = Vec::new();
        let traces = measure(&last, disk, files, rung, shown.as_ref(), &mut unread)?;
        showcase.push(traces);
        let remark = unread_files(&unread);
        (diagnosis.reasons).extend(remark.filter(|remark| !diagnosis.reasons.contains(remark)));
    }
    let ends = (
        showcase.first_mut().and_then(Option::take),
        showcase.last_mut().and_then(Option::take),
    );
    if let (Some(id), (Some(before), Some(after))) = (shown, ends) {
        diagnosis.showcase = Some(Showcase { id, before, after });
    }
    Ok((last, diagnosis))
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
    }
    study
}

/// Fills in what only an evaluation of the whole study can tell of a rung, and why files could not be read for it; returns
/// the signals of one tightening.
fn measure(
    study: &Study,
    disk: &dyn Disk,
    files: &[PathBuf],
    rung: &mut Rung,
    shown: Option<&TighteningId>,
    unread: &mut Vec<IngestError>,
) -> Result<Option<Traces>, StudyError> {
    let evaluated = files.par_iter().map(|path| {
        let mut all = evaluate_alone(study, disk, path)?;
        for one in all.iter_mut().flatten() {
            one.traces = one.traces.take().filter(|_| Some(&one.result.id) == shown);
        }
        Ok(all)
    });
    let evaluated: Vec<Result<Result<Vec<Evaluated>, IngestError>, StudyError>> =
        evaluated.collect();
    let (mut squares, mut fits, mut selected, mut count) =
        (Vec::new(), Vec::new(), 0_usize, 0_usize);
    let mut traces = None;
    for file in evaluated {
        let all = file?.unwrap_or_else(|error| {
            unread.push(error);
            Vec::new()
        });
        for one in all {
            if one
                .result
                .selection
                .rejections
                .contains(&Rejection::Validation)
            {
                continue;
            }
            count += 1;
            selected += usize::from(one.result.selection.selected());
            squares.extend(
                one.result
                    .measures
                    .rms_displacement_rad
                    .map(|rms| rms * rms),
            );
            fits.extend(one.result.measures.fit_percent);
            traces = traces.or(one.traces);
        }
    }
    rung.selected_fraction = selected as f64 / count.max(1) as f64;
    rung.fit_percent_median = median(&fits).ok();
    rung.rms_displacement_rad =
        (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt());
    Ok(traces)
}
