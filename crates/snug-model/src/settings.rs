use crate::{Effect, Model, ModelError};
use serde::{Deserialize, Serialize};
use snug_campaign::{Intersample, ParameterSource, Rig};
use std::collections::BTreeMap;

/// What a study says about the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ModelSettings {
    /// Effects added to the base model, by name; default none.
    pub effects: Vec<String>,
    /// What the input does between samples: `ZeroOrder`, `Linear` or `BandLimited`; default `Linear`.
    pub intersample: Intersample,
    /// Changes to single parameters, by name, for example `{"mass_kg": (value: 1.0, fixed: true)}`.
    pub parameters: BTreeMap<String, ParameterSettings>,
}

/// What a study says about one parameter; what it leaves out keeps its default.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ParameterSettings {
    /// Starting value, or the value of a fixed parameter, in the parameter's unit.
    pub value: Option<f64>,
    /// Smallest allowed value.
    pub minimum: Option<f64>,
    /// Largest allowed value.
    pub maximum: Option<f64>,
    /// Held at its value instead of identified; default false.
    pub fixed: bool,
}

impl Default for ModelSettings {
    fn default() -> Self {
        Self {
            effects: Vec::new(),
            intersample: Intersample::Linear,
            parameters: BTreeMap::new(),
        }
    }
}

impl ModelSettings {
    /// The model these settings describe, for one rig.
    ///
    /// # Errors
    /// [`ModelError::UnknownEffect`], [`ModelError::UnknownParameter`] and [`ModelError::ParameterRange`] name what the
    /// settings got wrong and what is allowed; otherwise as [`Model::new`].
    pub fn model(&self, rig: Rig) -> Result<Model, ModelError> {
        let effects = self
            .effects
            .iter()
            .map(|name| {
                Effect::named(name).ok_or_else(|| ModelError::UnknownEffect {
                    name: name.clone(),
                    known: Effect::ALL.iter().map(|effect| effect.name()).collect(),
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        let mut model = Model::new(rig, &effects)?;
        for (name, settings) in &self.parameters {
            settings.apply(name, &mut model)?;
        }
        Ok(model)
    }
}

impl ParameterSettings {
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
        parameter.source = ParameterSource::Study;
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
