//! What a study file says about the model, and the model it makes.

use crate::assembly::model::Model;
use crate::assembly::scale::Scale;
use crate::custom::settings::CustomEffectSettings;
use crate::effects::Effect;
use crate::error::ModelError;
use serde::{Deserialize, Serialize};
use snug_campaign::{Factor, Intersample, ParameterSource, Rig};
use std::collections::BTreeMap;

/// What a study says about the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ModelSettings {
    /// Effects added to the base model, by name, from the catalogue or from `custom`; default none.
    pub effects: Vec<String>,
    /// Laws that this study writes itself; they are in the model only where `effects` name them. Default none.
    pub custom: Vec<CustomEffectSettings>,
    /// What the input does between samples: `ZeroOrder`, `Linear` or `BandLimited`; default `Linear`, unless `improve` finds on a
    /// machine that with `ZeroOrder` less is missing.
    pub intersample: Option<Intersample>,
    /// Steps of a simulation from sample to sample, 1 to 100, of a held or straight input; default 1, and on a machine as many as its dry friction
    /// asks for.
    pub steps_per_sample: Option<usize>,
    /// How large torques, angles and times are on this rig, which starts and bounds of effects follow: `Automatic`,
    /// `HandOnTool` or `Rig(torque_nm: …, angle_rad: …, time_s: …)`; default `Automatic`.
    pub scale: Scale,
    /// Changes to single parameters, by name, for example `{"mass_kg": (value: 1.0, fixed: true)}`.
    pub parameters: BTreeMap<String, ParameterSettings>,
}

/// What a study says about one parameter; what it leaves out keeps its default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ParameterSettings {
    /// Starting value, or the value of a fixed parameter, in the parameter's unit.
    pub value: Option<f64>,
    /// Smallest allowed value, in the parameter's unit.
    pub minimum: Option<f64>,
    /// Largest allowed value, in the parameter's unit.
    pub maximum: Option<f64>,
    /// Held at its value instead of identified; default false.
    pub fixed: bool,
    /// Standard error of a fixed value that was found elsewhere, in the parameter's unit: it widens the intervals of what
    /// is identified beside it. Default none: the value is known exactly.
    pub standard_error: Option<f64>,
    /// Other values for groups of tightenings, for example `(factor: participant, values: {"TP3": (value: 4.0)})`; a group that is
    /// not named has `value`. Default none: all have the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_group: Option<ValuesByGroup>,
}

/// Values of a parameter that differ between groups of tightenings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValuesByGroup {
    /// What groups the tightenings: `participant`, `strategy`, `joint`, `pace`, `target_torque`, `file`; or their time:
    /// `from_number(13)` (those before and those from number 13 of a file on), `since((file: "…", number: 13))` (of the whole
    /// campaign, files in the order of their names), `course(first: 1, last: 30)` (evenly from what is at one number of a file to
    /// what is at another).
    pub factor: Factor,
    /// By the group's name.
    pub values: BTreeMap<String, GroupValue>,
}

/// The value of a parameter in one group; numbers in the parameter's unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupValue {
    /// In the parameter's unit.
    pub value: f64,
    /// Its standard error where it is fixed and was found elsewhere. Default none: the value is known exactly.
    #[serde(default)]
    pub standard_error: Option<f64>,
}

impl Default for ModelSettings {
    fn default() -> Self {
        Self {
            effects: Vec::new(),
            custom: Vec::new(),
            intersample: None,
            steps_per_sample: None,
            scale: Scale::Automatic,
            parameters: BTreeMap::new(),
        }
    }
}

impl ModelSettings {
    /// What the input does between samples.
    pub fn intersample(&self) -> Intersample {
        self.intersample.unwrap_or(Intersample::Linear)
    }

    /// Steps of a simulation from sample to sample.
    pub fn steps_per_sample(&self) -> usize {
        self.steps_per_sample.unwrap_or(1)
    }

    /// The model these settings describe, for one rig and no group of tightenings.
    ///
    /// # Errors
    /// [`ModelError::UnknownEffect`], [`ModelError::UnknownParameter`] and [`ModelError::ParameterRange`] name what the
    /// settings got wrong and what is allowed; otherwise as [`Model::new`] and [`ModelSettings::custom_effects`].
    pub fn model(&self, rig: Rig) -> Result<Model, ModelError> {
        self.model_of_group(rig, &|_| Vec::new())
    }

    /// The same for tightenings of which `group` says the group by each factor, or those between which they stand, with the share of
    /// each.
    ///
    /// # Errors
    /// As [`ModelSettings::model`].
    pub fn model_of_group(
        &self,
        rig: Rig,
        group: &dyn Fn(&Factor) -> Vec<(String, f64)>,
    ) -> Result<Model, ModelError> {
        let custom = self.custom_effects()?;
        let effects = self
            .effects
            .iter()
            .map(|name| self.scale.effect(named(name, &custom)?, &rig))
            .collect::<Result<Vec<_>, _>>()?;
        let mut model = Model::scaled(rig, &effects, self.scale)?;
        for (name, settings) in &self.parameters {
            let settings = settings.of_group(group);
            if self.scale == Scale::Automatic {
                settings.make_room(name, &mut model);
            }
            settings.apply(name, &mut model)?;
            settings.check_groups(name, &model)?;
        }
        Ok(model)
    }

    /// The effect that this study calls `name`: one of its own or of the catalogue.
    ///
    /// # Errors
    /// [`ModelError::UnknownEffect`] when there is none; otherwise as [`ModelSettings::custom_effects`].
    pub fn effect(&self, name: &str) -> Result<Effect, ModelError> {
        named(name, &self.custom_effects()?)
    }

    /// The study's own effects, whether the model has them or not.
    ///
    /// # Errors
    /// [`ModelError::CustomName`] when two have one name; otherwise as [`Effect::custom`].
    pub fn custom_effects(&self) -> Result<Vec<Effect>, ModelError> {
        let mut effects: Vec<Effect> = Vec::new();
        for settings in &self.custom {
            let effect = Effect::custom(settings)?;
            if effects.iter().any(|known| known.name() == effect.name()) {
                return Err(ModelError::CustomName {
                    name: settings.name.clone(),
                    problem: "is declared twice; a custom effect needs a name of its own",
                });
            }
            effects.push(effect);
        }
        Ok(effects)
    }
}

/// Standard error of a value between others that are known independently of each other.
fn error_between(values: &[(GroupValue, f64)]) -> Option<f64> {
    let squares = values
        .iter()
        .map(|(one, share)| Some((share * one.standard_error?).powi(2)));
    squares.sum::<Option<f64>>().map(f64::sqrt)
}

fn named(name: &str, custom: &[Effect]) -> Result<Effect, ModelError> {
    let known = custom.iter().chain(Effect::ALL);
    match known.clone().find(|effect| effect.name() == name) {
        Some(effect) => Ok(*effect),
        None => Err(ModelError::UnknownEffect {
            name: name.to_owned(),
            known: known.map(Effect::name).collect(),
        }),
    }
}

impl ParameterSettings {
    /// What it says of tightenings of which `group` says the group by each factor, or those between which they stand.
    fn of_group(&self, group: &dyn Fn(&Factor) -> Vec<(String, f64)>) -> Self {
        let Some(by_group) = &self.by_group else {
            return self.clone();
        };
        let known = group(&by_group.factor).into_iter();
        let known: Vec<(GroupValue, f64)> = known
            .filter_map(|(name, share)| Some((*by_group.values.get(&name)?, share)))
            .filter(|(_, share)| *share > 0.0)
            .collect();
        match known.as_slice() {
            [] => self.clone(),
            [(own, _)] => Self {
                value: Some(own.value),
                standard_error: own.standard_error.or(self.standard_error),
                ..self.clone()
            },
            several => Self {
                value: Some(several.iter().map(|(one, share)| share * one.value).sum()),
                standard_error: error_between(several).or(self.standard_error),
                ..self.clone()
            },
        }
    }

    /// Refuses the value of a group that the parameter may not have.
    fn check_groups(&self, name: &str, model: &Model) -> Result<(), ModelError> {
        let Some(by_group) = &self.by_group else {
            return Ok(());
        };
        let all = model.parameters().iter().find(|p| p.name == name);
        let (minimum, maximum) = all.map_or((0.0, 0.0), |p| (p.minimum, p.maximum));
        let values = by_group.values.values().map(|group| group.value);
        match values
            .into_iter()
            .find(|value| !(minimum..=maximum).contains(value))
        {
            Some(value) => Err(ModelError::ParameterRange {
                name: name.to_owned(),
                value,
                minimum,
                maximum,
            }),
            None => Ok(()),
        }
    }

    /// Lets a parameter be where the study says, which gives it no bounds: they are those of a hand until it is known how large things are on
    /// the rig.
    fn make_room(&self, name: &str, model: &mut Model) {
        let mut parameters = model.parameters_mut().iter_mut();
        if let Some(parameter) = parameters.find(|one| one.name == name)
            && let Some(value) = self.value.filter(|value| value.is_finite())
        {
            parameter.minimum = parameter.minimum.min(value);
            parameter.maximum = parameter.maximum.max(value);
        }
    }

    fn apply(&self, name: &str, model: &mut Model) -> Result<(), ModelError> {
        let known: Vec<String> = model.parameters().iter().map(|p| p.name.clone()).collect();
        let Some(parameter) = model.parameters_mut().iter_mut().find(|p| p.name == name) else {
            return Err(ModelError::UnknownParameter {
                name: name.to_owned(),
                known,
            });
        };
        parameter.minimum = self.minimum.unwrap_or(parameter.minimum);
        parameter.maximum = self.maximum.unwrap_or(parameter.maximum);
        parameter.value = self.value.unwrap_or(parameter.value);
        parameter.fixed = self.fixed;
        parameter.standard_error = self.standard_error;
        parameter.source = ParameterSource::Study;
        if let Some(standard_error) = self.standard_error
            && !(self.fixed && standard_error >= 0.0 && standard_error.is_finite())
        {
            return Err(ModelError::StandardError {
                name: name.to_owned(),
                standard_error,
            });
        }
        let (value, minimum, maximum) = (parameter.value, parameter.minimum, parameter.maximum);
        if value.is_finite() && minimum < maximum && (minimum..=maximum).contains(&value) {
            Ok(())
        } else {
            Err(ModelError::ParameterRange {
                name: name.to_owned(),
                value,
                minimum,
                maximum,
            })
        }
    }
}
