//! The base model with effects on one rig, and the parameters that a fit, a ranking or a report sees.

use crate::assembly::layout::{Assembly, BASE_PARAMETERS, MAXIMUM_FREE, MAXIMUM_OWN_STATES, Part};
use crate::assembly::scale::{PlausibleRange, Scale};
use crate::description::ParameterSpec;
use crate::effects::Effect;
use crate::error::ModelError;
use crate::law::{AnsweredHooks, Law};
use snug_campaign::{Parameter, ParameterSource, Rig};

/// m, c, k as the thesis starts them \[kg, kg/s, N/m\].
pub const THESIS_START: [f64; 3] = [1.76, 38.26, 1837.27];

/// (I_n + m l²) dω/dt = T − l F with F = k x + c v + effects, x = l θ, v = l ω: simulated, with sensitivities.
///
/// Parameters are m, c, k and then each effect's own, in the order the effects were given.
#[derive(Debug, Clone)]
pub struct Model {
    assembly: Assembly,
    parameters: Vec<Parameter>,
    scale: Scale,
}

impl Model {
    /// The base model of `rig` with `effects` added, their starts and bounds those of a hand on a tool.
    ///
    /// # Errors
    /// As [`Model::scaled`].
    pub fn new(rig: Rig, effects: &[Effect]) -> Result<Self, ModelError> {
        Self::scaled(rig, effects, Scale::HandOnTool)
    }

    /// The base model of `rig` with `effects` added, their starts and bounds those of a rig of this `scale`.
    ///
    /// # Errors
    /// [`ModelError::DuplicateEffect`] when an effect is named twice, [`ModelError::Rig`] when the rig's constants are
    /// not finite, the lever arm is not positive or the known inertia is negative, [`ModelError::TooLarge`] when the
    /// effects need more states or parameters than a simulation carries.
    pub fn scaled(rig: Rig, effects: &[Effect], scale: Scale) -> Result<Self, ModelError> {
        check_rig(&rig)?;
        let mut parameters = base_parameters();
        let mut parts: Vec<Part> = Vec::new();
        let mut states = 0;
        for &effect in effects {
            if parts.iter().any(|part| part.effect.name() == effect.name()) {
                return Err(ModelError::DuplicateEffect {
                    effect: effect.name(),
                });
            }
            let description = effect.description();
            let first = parameters.len();
            let ranges = ranges(effect, &rig, scale);
            for (spec, range) in description.parameters.iter().zip(ranges) {
                let taken = parameters
                    .iter()
                    .any(|parameter| parameter.name == spec.name);
                parameters.push(effect_parameter(
                    spec,
                    &range,
                    taken.then_some(description.name),
                ));
            }
            let next = states + description.states.len();
            parts.push(Part {
                effect,
                answered: AnsweredHooks::of(&effect),
                parameters: first..parameters.len(),
                states: states..next,
            });
            states = next;
        }
        if states > MAXIMUM_OWN_STATES || parameters.len() > MAXIMUM_FREE {
            return Err(ModelError::TooLarge {
                states,
                parameters: parameters.len(),
                maximum_states: MAXIMUM_OWN_STATES,
                maximum_parameters: MAXIMUM_FREE,
            });
        }
        Ok(Self {
            assembly: Assembly {
                rig,
                corner: scale.corner(&rig),
                parts,
                parameter_count: parameters.len(),
                own_state_count: states,
            },
            parameters,
            scale,
        })
    }

    /// The same model with `effect` added; what is set of its other parameters stays.
    ///
    /// # Errors
    /// As [`Model::new`].
    pub fn with_effect(&self, effect: Effect) -> Result<Self, ModelError> {
        let effects: Vec<Effect> = self.effects().chain([effect]).collect();
        self.with_effects(&effects)
    }

    /// The same model without `effect`; what is set of its other parameters stays.
    ///
    /// # Errors
    /// [`ModelError::UnknownEffect`] when the model does not have it.
    pub fn without_effect(&self, effect: Effect) -> Result<Self, ModelError> {
        let effects: Vec<Effect> = self.effects().filter(|known| *known != effect).collect();
        if effects.len() == self.assembly.parts.len() {
            return Err(ModelError::UnknownEffect {
                name: effect.name().to_owned(),
                known: effects.iter().map(Effect::name).collect(),
            });
        }
        self.with_effects(&effects)
    }

    /// The same model with these effects in place of its own; what is set of parameters that both have stays. They are matched
    /// by their effect, since their names depend on its company.
    ///
    /// # Errors
    /// As [`Model::scaled`].
    pub fn with_effects(&self, effects: &[Effect]) -> Result<Self, ModelError> {
        let mut model = Self::scaled(*self.rig(), effects, self.scale)?;
        let keep = |to: &mut [Parameter], from: &[Parameter]| {
            for (to, from) in to.iter_mut().zip(from) {
                let name = std::mem::take(&mut to.name);
                *to = Parameter {
                    name,
                    ..from.clone()
                };
            }
        };
        let base = BASE_PARAMETERS.len();
        keep(&mut model.parameters[..base], &self.parameters[..base]);
        for part in &model.assembly.parts {
            let mut known = self.assembly.parts.iter();
            if let Some(old) = known.find(|old| old.effect.name() == part.effect.name()) {
                keep(
                    &mut model.parameters[part.parameters.clone()],
                    &self.parameters[old.parameters.clone()],
                );
            }
        }
        Ok(model)
    }

    /// The rig's constants.
    pub fn rig(&self) -> &Rig {
        &self.assembly.rig
    }

    /// All parameters: m, c, k, then the effects'.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// All parameters, to change values, bounds or what is fixed.
    pub fn parameters_mut(&mut self) -> &mut [Parameter] {
        &mut self.parameters
    }

    /// The scale that starts and bounds of effects follow.
    pub fn scale(&self) -> Scale {
        self.scale
    }

    /// Starts and bounds of each parameter of `effect`, whether the model has it or not.
    pub fn ranges(&self, effect: Effect) -> Vec<PlausibleRange> {
        ranges(effect, self.rig(), self.scale)
    }

    /// The effects, in order.
    pub fn effects(&self) -> impl Iterator<Item = Effect> + '_ {
        self.assembly.parts.iter().map(|part| part.effect)
    }

    /// Indices of the parameters that are not fixed.
    pub fn free(&self) -> Vec<usize> {
        (0..self.parameters.len())
            .filter(|&index| !self.parameters[index].fixed)
            .collect()
    }

    /// Other starting values worth trying: for each effect parameter with several, one set per further value.
    pub fn further_starts(&self) -> Vec<Vec<f64>> {
        let usual: Vec<f64> = self.parameters.iter().map(|p| p.value).collect();
        let mut further = Vec::new();
        for part in &self.assembly.parts {
            let ranges = self.ranges(part.effect);
            for (index, range) in part.parameters.clone().zip(ranges) {
                if self.parameters[index].fixed {
                    continue;
                }
                for &start in range.starts.iter().skip(1) {
                    let mut values = usual.clone();
                    values[index] = start;
                    further.push(values);
                }
            }
        }
        further
    }

    pub(crate) fn assembly(&self) -> &Assembly {
        &self.assembly
    }
}

fn check_rig(rig: &Rig) -> Result<(), ModelError> {
    let reject = |field, value, allowed| {
        Err(ModelError::Rig {
            field,
            value,
            allowed,
        })
    };
    if !(rig.lever_arm_m > 0.0 && rig.lever_arm_m.is_finite()) {
        return reject(
            "lever_arm_m",
            rig.lever_arm_m,
            "a positive number of metres",
        );
    }
    if !(rig.known_inertia_kg_m2 >= 0.0 && rig.known_inertia_kg_m2.is_finite()) {
        return reject(
            "known_inertia_kg_m2",
            rig.known_inertia_kg_m2,
            "zero or a positive number of kg m²",
        );
    }
    Ok(())
}

fn base_parameters() -> Vec<Parameter> {
    BASE_PARAMETERS
        .iter()
        .zip(["kg", "kg/s", "N/m"])
        .zip(THESIS_START)
        .map(|((name, unit), value)| Parameter {
            name: (*name).to_owned(),
            unit: unit.to_owned(),
            value,
            minimum: f64::NEG_INFINITY,
            maximum: f64::INFINITY,
            fixed: false,
            standard_error: None,
            source: ParameterSource::Default,
        })
        .collect()
}

/// Starts and bounds of an effect's parameters; a study's own law has those that the study says, on any rig.
fn ranges(effect: Effect, rig: &Rig, scale: Scale) -> Vec<PlausibleRange> {
    let scale = match effect {
        Effect::Custom(_) => Scale::HandOnTool,
        _ => scale,
    };
    let specs = effect.description().parameters.iter();
    specs.map(|spec| scale.range(spec, rig)).collect()
}

/// A parameter whose name another effect already has is called after its own effect: `torque_lag_tau_s`.
fn effect_parameter(
    spec: &ParameterSpec,
    range: &PlausibleRange,
    qualified_by: Option<&str>,
) -> Parameter {
    Parameter {
        name: match qualified_by {
            Some(effect) => format!("{effect}_{}", spec.name),
            None => spec.name.to_owned(),
        },
        unit: spec.unit.to_owned(),
        value: range.starts[0],
        minimum: range.limits.0,
        maximum: range.limits.1,
        fixed: false,
        standard_error: None,
        source: ParameterSource::Default,
    }
}
