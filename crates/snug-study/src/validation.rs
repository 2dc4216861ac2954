//! What is kept for validation: which ranges and files, and how well the parameters of the others predict it.

use crate::{Study, StudyError};
use serde::{Deserialize, Serialize};
use snug_campaign::{
    Estimate, FitStatus, Prediction, Quantity, RestartedPrediction, Tightening, Traces, Validation,
};
use snug_identify::{Simulation, agreement};
use snug_model::{Input, Model, Scale};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// Which tightenings are not fitted but only simulated, with the mean parameters of the fitted ones: those of a range with what was
/// fitted of the same recording, those of a file with what was fitted of all other files.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ValidationSettings {
    /// Names of the source's ranges; default none.
    pub ranges: Vec<String>,
    /// Names of files, in which `*` stands for any characters and `?` for one, for example `["TP6_*", "test-3.csv"]`; default
    /// none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// Samples at the start of each that are simulated but not scored; default 0.
    pub unscored_samples: usize,
}

impl ValidationSettings {
    /// Whether a file is kept as a whole.
    pub(crate) fn keeps(&self, file: &Path) -> bool {
        let name = name_of(file);
        self.files.iter().any(|pattern| matches(pattern, &name))
    }

    /// The files that are fitted and, behind them, those that are kept.
    ///
    /// # Errors
    /// [`StudyError::NoSuchValidationFile`] where a name or pattern stands for none of them, [`StudyError::NothingToFit`] where
    /// all are kept.
    pub(crate) fn last(&self, files: Vec<PathBuf>) -> Result<Vec<PathBuf>, StudyError> {
        let is_any = |pattern: &&String| !files.iter().any(|one| matches(pattern, &name_of(one)));
        if let Some(name) = self.files.iter().find(is_any) {
            return Err(StudyError::NoSuchValidationFile {
                name: name.clone(),
                known: files.iter().map(|file| name_of(file)).collect(),
            });
        }
        let (kept, mut all): (Vec<_>, Vec<_>) =
            files.into_iter().partition(|file| self.keeps(file));
        if all.is_empty() && !kept.is_empty() {
            return Err(StudyError::NothingToFit { files: kept.len() });
        }
        all.extend(kept);
        Ok(all)
    }
}

fn name_of(file: &Path) -> String {
    (file.file_name().unwrap_or_default())
        .to_string_lossy()
        .into_owned()
}

/// Whether `name` is what `pattern` says, in which `*` stands for any characters and `?` for one.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    // Where the latest star stands and how far it reaches: of several stars only the last has to be tried again.
    let (mut at, mut in_name, mut star) = (0, 0, None);
    while in_name < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, in_name));
                at += 1;
            }
            Some(&one) if one == '?' || one == name[in_name] => {
                (at, in_name) = (at + 1, in_name + 1);
            }
            _ => match star {
                Some((before, reach)) => {
                    star = Some((before, reach + 1));
                    (at, in_name) = (before + 1, reach + 1);
                }
                None => return false,
            },
        }
    }
    pattern[at..].iter().all(|one| *one == '*')
}

/// The mean of every parameter over converged fits, carried by the first of them; `None` where there is none.
pub(crate) fn mean_estimate<'a>(all: impl Iterator<Item = &'a Estimate>) -> Option<Estimate> {
    let is_end = |estimate: &&Estimate| {
        matches!(
            estimate.status,
            FitStatus::Converged | FitStatus::ConvergedAtConstraint
        )
    };
    let converged: Vec<&Estimate> = all.filter(is_end).collect();
    let mut mean = (*converged.first()?).clone();
    for (index, parameter) in mean.parameters.iter_mut().enumerate() {
        let sum: f64 = converged.iter().map(|e| e.parameters[index].value).sum();
        parameter.value = sum / converged.len() as f64;
    }
    Some(mean)
}

/// How well `values` predict the fitted output of a tightening: freely, as `free` simulated it under `input`, and restarted.
pub(crate) fn predicted(
    study: &Study,
    model: &Model,
    input: &Input,
    tightening: &Tightening,
    values: &[f64],
    free: &Traces,
) -> Validation {
    let quantity = study.identify.fitted_output;
    let against = |simulated: &[f64]| {
        let measured = tightening.motion.get(quantity)?;
        let unscored = study.validation.unscored_samples;
        let (y, s) = (measured.get(unscored..)?, simulated.get(unscored..)?);
        Some(Prediction {
            fit_percent: agreement::fit_percent(y, s),
            rms: (!y.is_empty()).then(|| agreement::rms_residual(y, s)),
        })
    };
    let restarted = || {
        let every_s = restarted_every_s(study, tightening)?;
        let input = Simulation::Restarted { every_s }.of(input.clone(), tightening);
        let mut output = vec![0.0; tightening.torque_nm.len()];
        model.output(values, &input, quantity, &mut output).ok()?;
        Some(RestartedPrediction {
            every_s,
            prediction: against(&output)?,
        })
    };
    Validation {
        free_run: (free.simulated.get(quantity).and_then(against)).unwrap_or_default(),
        restarted: restarted(),
    }
}

/// Restarts per period of the motion: short enough that small errors stay small, long enough that forces show.
const STRETCHES_PER_PERIOD: f64 = 8.0;
/// Fewest samples between restarts: fewer say nothing of a motion, and rigs so fast are sampled for a free run.
const FEWEST_SAMPLES: f64 = 8.0;

/// From one restart to the next \[s\]: as the study restarts the model, or as it would; `None` where it could not.
fn restarted_every_s(study: &Study, tightening: &Tightening) -> Option<f64> {
    let motion = &tightening.motion;
    let is_accelerometer = study.identify.fitted_output == Quantity::Acceleration
        || motion.acceleration_rad_per_s2.is_some();
    if is_accelerometer || motion.displacement_rad.is_none() {
        return None;
    }
    match (study.identify.simulation, study.model.scale) {
        (Simulation::Restarted { every_s }, _) => Some(every_s),
        (_, Scale::Rig { time_s, .. }) => every_s_of(TAU * time_s, tightening),
        _ => None,
    }
}

/// From one restart to the next where the motion has this period \[s\]; `None` where that is too fast for its sampling. Whole
/// samples, so that it does not depend on the unit of time.
pub(crate) fn every_s_of(period_s: f64, tightening: &Tightening) -> Option<f64> {
    let interval_s = tightening.time_base.interval_s;
    let samples = period_s / STRETCHES_PER_PERIOD / interval_s;
    let every_s = samples.round() * interval_s;
    // As people write it, who do not mean the last bits of a product.
    let every_s = format!("{every_s:.12e}").parse().unwrap_or(every_s);
    (samples >= FEWEST_SAMPLES).then_some(every_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_matched_as_on_a_command_line() {
        for (pattern, name, is_it) in [
            ("test.csv", "test.csv", true),
            ("test.csv", "test.csv2", false),
            ("TP6_*", "TP6_QS_Soft_8.mat", true),
            ("TP6_*", "TP16_QS_Soft_8.mat", false),
            ("*_8.mat", "TP6_8_8.mat", true),
            ("*Soft*8*", "TP6_QS_Soft_8.mat", true),
            ("run?.csv", "run7.csv", true),
            ("run?.csv", "run.csv", false),
            ("*", "", true),
            ("", "a", false),
            ("**a*b", "aab", true),
            ("*ab", "abaab", true),
        ] {
            assert_eq!(matches(pattern, name), is_it, "{pattern} {name}");
        }
    }
}
