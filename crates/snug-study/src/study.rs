//! The study file: the settings of every crate under one roof, read and written as RON, checked before work starts.

pub(crate) mod beginning;
pub(crate) mod rewriting;

use crate::error::StudyError;
use crate::settings::diagnosis::DiagnosisSettings;
use crate::settings::validation::ValidationSettings;
use crate::syntax;
use crate::syntax::position::Position;
use ron::extensions::Extensions;
use serde::{Deserialize, Serialize};
use snug_campaign::{Factor, Intersample, Quantity, Rig, Tightening};
use snug_identify::{ConstraintKind, IdentifyError, IdentifySettings};
use snug_ingest::Source;
use snug_model::{Model, ModelError, ModelSettings, ParameterSettings, Scale};
use snug_preprocess::{PreprocessSettings, Preset, Stretch, Window};
use snug_record::RecordSettings;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::settings::selection::SelectionSettings;

/// A study: which data, how they are prepared, which model is fitted how, and what is reported.
///
/// Every part belongs to the crate it configures; what a study file leaves out has its default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Study {
    /// Title of the report; default: the data folder's name.
    pub title: String,
    /// Where the data lie (relative to the study file) and how they are written; default: MAT files in the thesis' layout.
    pub source: Source,
    /// How recordings become tightenings.
    pub preprocess: PreprocessSettings,
    /// The model: effects, input behaviour, single parameters.
    pub model: ModelSettings,
    /// Which output is fitted and under which constraints.
    pub identify: IdentifySettings,
    /// When a tightening counts in the statistics.
    pub selection: SelectionSettings,
    /// What is only simulated, with the parameters of the others.
    pub validation: ValidationSettings,
    /// How the missing effect is looked for.
    pub diagnosis: DiagnosisSettings,
    /// The recording.
    pub record: RecordSettings,
    /// Seed of everything random (permutation tests); default 0.
    pub seed: u64,
}

impl Study {
    /// The default study on a folder in the thesis' file layout.
    pub fn on(data: PathBuf) -> Self {
        let mut study = Self::default();
        study.set_data(&data);
        study
    }

    /// Reads a study file (RON); its data path is taken relative to the file.
    ///
    /// # Errors
    /// [`StudyError::Read`] and [`StudyError::NotAStudy`] when the file cannot be read, [`StudyError::Syntax`] with line and column when it does not
    /// follow the format, [`StudyError::InFile`] with those of the field when a value is not allowed.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let text = text_of(path)?;
        let mut study = Self::parse(&text, path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        study.source.path = folder.join(&study.source.path);
        // What the file leaves out has the default preset's choices; they are to be those of the preset it names.
        study.follow(Preset::default(), study.preprocess.preset);
        study.check().map_err(|error| error.in_file(path, &text))?;
        Ok(study)
    }

    /// The study that `text` (RON), the content of the file at `path`, describes; its data path is taken as it stands.
    ///
    /// # Errors
    /// [`StudyError::Syntax`] with line and column.
    pub fn parse(text: &str, path: &Path) -> Result<Self, StudyError> {
        options().from_str(text).map_err(|source| {
            let (line, column) = (source.span.start.line, source.span.start.col);
            StudyError::Syntax {
                path: path.to_path_buf(),
                line,
                column,
                message: syntax::told(&source.code, text, Position { line, column }),
            }
        })
    }

    /// The study with every default written out, as RON that [`Study::read`] takes.
    ///
    /// # Errors
    /// [`StudyError::Serialize`] when a value has no RON form.
    pub fn to_ron(&self) -> Result<String, StudyError> {
        options()
            .to_string_pretty(self, ron::ser::PrettyConfig::default())
            .map_err(|source| StudyError::Serialize { source })
    }

    /// Numbers of the segments of a fitted file that are only simulated.
    pub(crate) fn validation_segments(&self) -> Vec<u32> {
        (1..)
            .zip(self.source.ranges())
            .filter(|(_, range)| self.validation.ranges.contains(&range.name))
            .map(|(number, _)| number)
            .collect()
    }

    /// Takes other data than the study's own.
    pub fn set_data(&mut self, data: &Path) {
        self.source.path = data.to_path_buf();
    }

    /// Changes the preset; fitted output, input behaviour and constraints follow where they are still as the preset that
    /// is left has them. What the study states otherwise is kept.
    pub fn set_preset(&mut self, preset: Preset) {
        let left = self.preprocess.preset;
        self.preprocess.preset = preset;
        self.follow(left, preset);
    }

    fn follow(&mut self, left: Preset, preset: Preset) {
        let (was, becomes) = (PresetChoices::of(left), PresetChoices::of(preset));
        if self.identify.fitted_output == was.fitted_output {
            self.identify.fitted_output = becomes.fitted_output;
        }
        if self.model.intersample == was.intersample {
            self.model.intersample = becomes.intersample;
        }
        if self.identify.constraints == was.constraints {
            self.identify.constraints = becomes.constraints;
        }
    }

    /// Checks every part before work starts.
    ///
    /// # Errors
    /// The first setting that is not allowed, with its field, value and what is allowed.
    pub fn check(&self) -> Result<(), StudyError> {
        self.preprocess.check()?;
        (self.identify.solver.check()).map_err(IdentifyError::from)?;
        self.record.check()?;
        self.diagnosis.check()?;
        self.selection.check()?;
        self.source.check()?;
        self.check_scored()?;
        self.check_steps()?;
        let known = self.source.ranges();
        for name in &self.validation.ranges {
            if !known.iter().any(|range| range.name == *name) {
                return Err(StudyError::UnknownRange {
                    name: name.clone(),
                    known: known.iter().map(|range| range.name.clone()).collect(),
                });
            }
        }
        let model = self.model_before_data()?;
        let positive = self
            .identify
            .constraints
            .contains(&ConstraintKind::Positive);
        for parameter in model.parameters().iter().take(3) {
            if parameter.fixed && positive && parameter.value < 0.0 {
                return Err(StudyError::FixedAgainstConstraint {
                    parameter: parameter.name.clone(),
                    value: parameter.value,
                });
            }
        }
        Ok(())
    }

    /// The model as far as it is known before any data. Where the scale of a rig is found from those, so are the bounds of effects.
    fn model_before_data(&self) -> Result<Model, ModelError> {
        let mut model = self.model.clone();
        if model.scale == Scale::Automatic && self.preprocess.window != Window::Whole {
            model.scale = Scale::HandOnTool;
        }
        model.model(self.any_rig())
    }

    /// The model of one tightening, with what its groups have of the sizes.
    pub(crate) fn model_for(&self, tightening: &Tightening) -> Result<Model, ModelError> {
        let group = |factor: &Factor| {
            let shares = factor.shares(tightening).unwrap_or_default().into_iter();
            shares.map(|(level, share)| (level.name, share)).collect()
        };
        let mut model = self.model.model_of_group(tightening.rig, &group)?;
        beginning::as_measured(&mut model, tightening, &self.model);
        Ok(model)
    }

    /// The settings by which one tightening is identified: before the stretch that counts nothing is scored.
    pub(crate) fn identify_settings(&self, tightening: &Tightening) -> Cow<'_, IdentifySettings> {
        let Some(stretch) = self.preprocess.stretch else {
            return Cow::Borrowed(&self.identify);
        };
        let before = stretch.samples_before(tightening.time_base.interval_s);
        let mut settings = self.identify.clone();
        settings.unscored_samples = settings.unscored_samples.max(before);
        Cow::Owned(settings)
    }

    /// Which setting leaves samples of every window out of account, in a clause; `None` where all count.
    pub(crate) fn what_counts(&self) -> Option<String> {
        match (self.preprocess.stretch, self.identify.unscored_samples) {
            (Some(Stretch { from_s, to_s }), _) => Some(format!(
                "only what is from {from_s} to {to_s} s in a window counts (preprocess.stretch)"
            )),
            (None, 0) => None,
            (None, first) => Some(format!(
                "the first {first} samples of a window do not count (identify.unscored_samples)"
            )),
        }
    }

    /// The parameters that differ between groups of tightenings, and what groups these.
    pub(crate) fn sizes_by_group(&self) -> Vec<(String, Factor)> {
        let by_group = |(name, told): (&String, &ParameterSettings)| {
            Some((name.clone(), told.by_group.as_ref()?.factor.clone()))
        };
        self.model.parameters.iter().filter_map(by_group).collect()
    }

    /// Its rig with nothing on it: a model's parameters do not depend on what a tightening knows of the inertia.
    pub(crate) fn any_rig(&self) -> Rig {
        Rig {
            lever_arm_m: self.preprocess.rig.lever_arm_m,
            known_inertia_kg_m2: 0.0,
        }
    }

    fn check_steps(&self) -> Result<(), StudyError> {
        match self.model.steps_per_sample {
            Some(steps) if !ALLOWED_STEPS.contains(&steps) => Err(StudyError::Setting {
                setting: "model.steps_per_sample",
                value: steps as f64,
                allowed: "1 to 100",
            }),
            _ => Ok(()),
        }
    }

    /// Of every range something must be scored.
    fn check_scored(&self) -> Result<(), StudyError> {
        for range in self.source.ranges() {
            let (setting, unscored) = if self.validation.ranges.contains(&range.name) {
                (
                    "validation.unscored_samples",
                    self.validation.unscored_samples,
                )
            } else {
                ("identify.unscored_samples", self.identify.unscored_samples)
            };
            let samples = range.end - range.start;
            if unscored >= samples {
                return Err(StudyError::NothingScored {
                    setting,
                    unscored,
                    range: range.name.clone(),
                    samples,
                });
            }
        }
        Ok(())
    }

    /// Checks that effects exist and are not yet in the model.
    ///
    /// # Errors
    /// [`StudyError::Model`] names the known ones, [`StudyError::AlreadyInModel`] what is there.
    pub fn check_effects(&self, names: &[String]) -> Result<(), StudyError> {
        for (index, name) in names.iter().enumerate() {
            let effect = self.model.effect(name)?.name();
            if names[..index].contains(name) {
                return Err(ModelError::DuplicateEffect { effect }.into());
            }
            if self.model.effects.contains(name) {
                return Err(StudyError::AlreadyInModel {
                    effect: name.clone(),
                });
            }
        }
        Ok(())
    }

    /// The study's title, or the data's name where it has none.
    pub fn title(&self) -> String {
        if self.title.is_empty() {
            let path = &self.source.path;
            // `.` and `..` are called as the folder is.
            let path = match path.file_name() {
                Some(_) => path.clone(),
                None => path.canonicalize().unwrap_or_else(|_| path.clone()),
            };
            let name = path.file_name().unwrap_or(path.as_os_str());
            name.to_string_lossy().into_owned()
        } else {
            self.title.clone()
        }
    }
}

/// Steps from sample to sample that a study may ask for: with more, an input is larger than the record it is made from by as much. Chosen.
const ALLOWED_STEPS: std::ops::RangeInclusive<usize> = 1..=100;

/// Longest study file that is read \[bytes\]; every default written out takes 4000.
const LONGEST_BYTES: u64 = 1 << 20;

/// The text of a study file.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::NotAStudy`] for what is no regular file or longer than any study.
pub(crate) fn text_of(path: &Path) -> Result<String, StudyError> {
    let read = |source| StudyError::Read {
        path: path.to_path_buf(),
        source,
    };
    // A pipe or device would be waited for, or read without end.
    let metadata = std::fs::metadata(path).map_err(read)?;
    if !metadata.is_file() || metadata.len() > LONGEST_BYTES {
        return Err(StudyError::NotAStudy {
            path: path.to_path_buf(),
            bytes: metadata.is_file().then_some(metadata.len()),
            most: LONGEST_BYTES,
        });
    }
    std::fs::read_to_string(path).map_err(read)
}

/// What a preset decides beyond the preparation.
struct PresetChoices {
    fitted_output: Quantity,
    intersample: Option<Intersample>,
    constraints: Vec<ConstraintKind>,
}

impl PresetChoices {
    fn of(preset: Preset) -> Self {
        match preset {
            Preset::Snug => Self {
                fitted_output: Quantity::Acceleration,
                intersample: None,
                constraints: vec![ConstraintKind::Positive, ConstraintKind::LightlyDamped],
            },
            Preset::Thesis => Self {
                fitted_output: Quantity::Displacement,
                intersample: Some(Intersample::ZeroOrder),
                constraints: vec![ConstraintKind::Stable],
            },
        }
    }
}

/// `Option` fields are written as plain values, and `Csv(channels: …)` needs no second pair of parentheses.
pub(crate) fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_that_lie_here_are_called_as_the_folder_is() {
        let text = r#"(source: (path: ".", format: Csv(
            channels: [
                (column: Name("u"), signal: Force, unit: Newton),
                (column: Name("y"), signal: Displacement, unit: Metre),
            ],
            sampling: Rate(hz: 1000.0),
        )), identify: (fitted_output: Displacement))"#;
        let study = Study::parse(text, Path::new("rig.ron")).expect("it is a study");
        // Tests run in the crate's folder.
        assert_eq!(study.title(), "snug-study");
    }

    /// A stiffening spring of 4 · 10¹⁰ N/m³ moves by micrometres; no hand has one.
    #[test]
    fn a_start_may_be_as_large_as_the_rig_whose_scale_the_data_tell() {
        let told = |window: &str, bounds: &str| {
            let text = format!(
                r#"(source: (path: ".", format: Csv(
                    channels: [
                        (column: Name("u"), signal: Force, unit: Newton),
                        (column: Name("y"), signal: Displacement, unit: Metre),
                    ],
                    sampling: Rate(hz: 1000.0),
                )), {window} identify: (fitted_output: Displacement), model: (
                    effects: ["cubic_stiffness"],
                    parameters: {{"k3_n_per_m3": (value: 4e10{bounds})}},
                ))"#
            );
            let study = Study::parse(&text, Path::new("rig.ron")).expect("it is a study");
            study.check().map_err(|error| error.to_string())
        };
        assert_eq!(told("preprocess: (window: Whole),", ""), Ok(()));
        let of_a_hand = told("", "").expect_err("no hand has it");
        assert!(of_a_hand.contains("`k3_n_per_m3`"), "{of_a_hand}");
        let beyond_its_own =
            told("preprocess: (window: Whole),", ", maximum: 1e10").expect_err("the study says so");
        assert!(beyond_its_own.contains("10000000000"), "{beyond_its_own}");
    }
}
