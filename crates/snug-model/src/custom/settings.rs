//! What a study file says of a law of its own, and which names and ranges it may have.

use crate::custom::expression;
use crate::custom::expression::Variable;
use crate::error::ModelError;
use serde::{Deserialize, Serialize};
use std::iter::once;

/// Where a custom effect's expression is added.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Place {
    /// To the hand force F \[N\] (acts as −l F on the tool).
    #[default]
    Force,
    /// To the torque that acts \[Nm\].
    Torque,
    /// To the measured acceleration \[rad/s²\]; what is integrated from it, from the first sample on, follows.
    Measurement,
}

impl Place {
    /// The variables an expression may use there.
    pub(crate) fn variables(self) -> &'static [Variable] {
        let all = &Variable::ALL;
        match self {
            Self::Force | Self::Torque => &all[..all.len() - 1],
            Self::Measurement => all,
        }
    }
}

/// A law that a study writes itself, for example
/// `(name: "x2v_damping", place: Force, expression: "p*x^2*v", parameters: [(name: "p", unit: "N s/m^3", maximum: 1e7)])`.
///
/// Variables: x \[m\] and v \[m/s\] at the grip, theta \[rad\], omega \[rad/s\], T \[Nm\] (the torque that acts), t (time
/// since onset, \[s\]), l (lever arm, \[m\]); for `Measurement` also a (true angular acceleration, \[rad/s²\]).
/// Operators: + − * / ^ and parentheses. Functions: abs, sign, sqrt, exp, log, sin, cos, tan, tanh, atan, step (0 or 1),
/// smooth_step (u² (3 − 2u) from 0 to 1), min, max. Constant: pi.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CustomEffectSettings {
    /// Name by which the study's `effects` call it; not one of the catalogue's. No default.
    pub name: String,
    /// What the expression is added to: `Force` \[N\], `Torque` \[Nm\] or `Measurement` \[rad/s²\]; default `Force`.
    pub place: Place,
    /// The expression. No default.
    pub expression: String,
    /// Its parameters; default none.
    pub parameters: Vec<CustomParameterSettings>,
}

/// One parameter of a custom effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CustomParameterSettings {
    /// Name, as the expression writes it. No default.
    pub name: String,
    /// Unit as people write it; default none.
    pub unit: String,
    /// Starting value in that unit; default 0.
    pub start: f64,
    /// Other values worth starting from, where one start does not lead to the best fit; default none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub further_starts: Vec<f64>,
    /// Smallest plausible value; default −∞.
    pub minimum: f64,
    /// Largest plausible value; default ∞.
    pub maximum: f64,
    /// A property of the rig, the same in all tightenings; otherwise each has its own. Default true.
    pub shared: bool,
}

impl Default for CustomParameterSettings {
    fn default() -> Self {
        Self {
            name: String::new(),
            unit: String::new(),
            start: 0.0,
            further_starts: Vec::new(),
            minimum: f64::NEG_INFINITY,
            maximum: f64::INFINITY,
            shared: true,
        }
    }
}

impl CustomEffectSettings {
    /// Checks names and ranges; the expression is checked where it is compiled.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        if !expression::is_name(&self.name) {
            return Err(ModelError::CustomName {
                name: self.name.clone(),
                problem: "must be a letter, then letters, digits and underscores",
            });
        }
        for (index, parameter) in self.parameters.iter().enumerate() {
            let reject = |problem| {
                Err(ModelError::CustomParameter {
                    effect: self.name.clone(),
                    parameter: parameter.name.clone(),
                    problem,
                })
            };
            if !expression::is_name(&parameter.name) {
                return reject("must be a letter, then letters, digits and underscores");
            }
            if expression::is_reserved(&parameter.name) {
                return reject("is a variable, function or constant of expressions; rename it");
            }
            if self.parameters[..index]
                .iter()
                .any(|earlier| earlier.name == parameter.name)
            {
                return reject("is declared twice");
            }
            parameter.check_range(&self.name)?;
        }
        Ok(())
    }
}

impl CustomParameterSettings {
    /// Every starting value, the usual one first.
    pub(crate) fn starts(&self) -> impl Iterator<Item = f64> + '_ {
        once(self.start).chain(self.further_starts.iter().copied())
    }

    fn check_range(&self, effect: &str) -> Result<(), ModelError> {
        let (minimum, maximum) = (self.minimum, self.maximum);
        let is_allowed = |start: &f64| {
            start.is_finite() && minimum < maximum && (minimum..=maximum).contains(start)
        };
        match self.starts().find(|start| !is_allowed(start)) {
            None => Ok(()),
            Some(start) => Err(ModelError::CustomRange {
                effect: effect.to_owned(),
                parameter: self.name.clone(),
                start,
                minimum,
                maximum,
            }),
        }
    }
}
