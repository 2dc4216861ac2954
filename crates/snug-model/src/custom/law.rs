//! A study's own law: its expression compiled, checked at rest and in motion, and kept for the program's life.

use crate::custom::expression;
use crate::custom::expression::{Program, Surroundings};
use crate::custom::settings::{CustomEffectSettings, Place};
use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope};
use crate::error::ModelError;
use crate::law::{Instant, Kinematics, Law};
use crate::numeric::number::Number;
use std::hash::{Hash, Hasher};
use std::sync::{Mutex, PoisonError};

/// A law that a study wrote itself: an expression added to the force, to the torque or to the measured acceleration.
#[derive(Debug)]
pub struct CustomEffect {
    settings: CustomEffectSettings,
    program: Program,
    /// With what it holds against every motion \[N\], where it is dry friction.
    holds: Option<Program>,
    description: &'static Description,
}

/// Every custom effect of this program.
///
/// They are kept until the program ends, so that an effect stays a small word that can be copied, compared and sent
/// between threads, with texts that live as long as the catalogue's. The same declaration is kept once, so the memory
/// grows with the number of different laws only, not with the number of models.
static KNOWN: Mutex<Vec<&'static CustomEffect>> = Mutex::new(Vec::new());

impl CustomEffect {
    /// The law that `settings` declare.
    ///
    /// # Errors
    /// [`ModelError::CustomName`], [`ModelError::CustomParameter`], [`ModelError::CustomRange`],
    /// [`ModelError::Expression`] and [`ModelError::ExpressionValue`] say what is wrong with the declaration and what is
    /// allowed.
    pub(crate) fn intern(settings: &CustomEffectSettings) -> Result<&'static Self, ModelError> {
        settings.check()?;
        Self::intern_as(settings, None, |written| *written)
    }

    /// The same for a declaration of the catalogue's own, which people read about as `description` says; of dry friction `holds` is the
    /// expression of what it holds with.
    pub(crate) fn intern_as(
        settings: &CustomEffectSettings,
        holds: Option<String>,
        description: impl FnOnce(&'static Description) -> Description,
    ) -> Result<&'static Self, ModelError> {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(effect) = known.iter().find(|effect| effect.settings == *settings) {
            return Ok(effect);
        }
        let program = compile(settings)?;
        let holds = holds.map(|expression| {
            compile(&CustomEffectSettings {
                expression,
                ..settings.clone()
            })
        });
        let written = describe(settings, &program);
        let effect: &'static Self = Box::leak(Box::new(Self {
            settings: settings.clone(),
            description: Box::leak(Box::new(description(written))),
            program,
            holds: holds.transpose()?,
        }));
        known.push(effect);
        Ok(effect)
    }

    /// What declared it.
    pub fn settings(&self) -> &CustomEffectSettings {
        &self.settings
    }

    #[inline(always)]
    fn value<N: Number>(&self, p: &[N], at: &Instant<N>) -> N {
        Self::value_of(&self.program, p, at)
    }

    #[inline(always)]
    fn value_of<N: Number>(program: &Program, p: &[N], at: &Instant<N>) -> N {
        // A copy: what is handed out of line by its place in memory could not stay in registers for any effect.
        let at = *at;
        program.evaluate(
            p,
            &Surroundings {
                at: &at,
                acceleration_rad_per_s2: None,
            },
        )
    }
}

impl PartialEq for CustomEffect {
    /// The same declaration is the same place in memory.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for CustomEffect {}

impl Hash for CustomEffect {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.settings.name.hash(state);
    }
}

impl Law for CustomEffect {
    fn description(&self) -> &'static Description {
        self.description
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        (self.settings.place == Place::Force).then(|| self.value(p, at))
    }

    #[inline(always)]
    fn dry_friction_n<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        let holds = self.holds.as_ref()?;
        Some(Self::value_of(holds, p, at))
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        (self.settings.place == Place::Torque).then(|| self.value(p, at))
    }

    #[inline(always)]
    fn cross_sensitivity<N: Number>(
        &self,
        p: &[N],
        at: &Instant<N>,
        motion: &Kinematics<N>,
    ) -> Option<N> {
        (self.settings.place == Place::Measurement).then(|| {
            self.program.evaluate(
                p,
                &Surroundings {
                    at,
                    acceleration_rad_per_s2: Some(motion.acceleration_rad_per_s2),
                },
            )
        })
    }
}

/// The expression as a program that has a value at rest and in motion, and that depends on every parameter.
fn compile(settings: &CustomEffectSettings) -> Result<Program, ModelError> {
    let names: Vec<&str> = settings
        .parameters
        .iter()
        .map(|parameter| parameter.name.as_str())
        .collect();
    let program = expression::compile(&settings.expression, &names, settings.place.variables())
        .map_err(|fault| ModelError::Expression {
            effect: settings.name.clone(),
            expression: settings.expression.clone(),
            position: fault.position,
            found: fault.found,
            allowed: fault.allowed,
        })?;
    if let Some(index) = (0..names.len()).find(|&index| !program.uses_parameter(index)) {
        return Err(ModelError::CustomParameter {
            effect: settings.name.clone(),
            parameter: names[index].to_owned(),
            problem: "does not occur in the expression, so no measurement can tell its value",
        });
    }
    let starts: Vec<f64> = settings.parameters.iter().map(|p| p.start).collect();
    for (x_m, v_m_per_s, torque_nm, since_onset_s) in [
        (0.0, 0.0, 0.0, 0.0),
        (0.01, 0.3, 10.0, 0.05),
        (-0.01, -0.3, -10.0, -0.05),
    ] {
        let at = Instant {
            torque_nm,
            x_m,
            v_m_per_s,
            since_onset_s,
            lever_arm_m: 1.0,
        };
        let around = Surroundings {
            at: &at,
            acceleration_rad_per_s2: Some(100.0 * x_m),
        };
        let value = program.evaluate(&starts, &around);
        if !value.is_finite() {
            return Err(ModelError::ExpressionValue {
                effect: settings.name.clone(),
                expression: settings.expression.clone(),
                value,
                x_m,
                v_m_per_s,
                torque_nm,
                since_onset_s,
            });
        }
    }
    Ok(program)
}

/// What people read about it, kept until the program ends.
fn describe(settings: &CustomEffectSettings, program: &Program) -> &'static Description {
    let kept = |text: String| -> &'static str { Box::leak(text.into_boxed_str()) };
    let parameters: Vec<ParameterSpec> = settings
        .parameters
        .iter()
        .map(|parameter| ParameterSpec {
            name: kept(parameter.name.clone()),
            meaning: kept(parameter.name.clone()),
            unit: kept(parameter.unit.clone()),
            starts: parameter.starts().collect::<Vec<f64>>().leak(),
            minimum: parameter.minimum,
            maximum: parameter.maximum,
            limits: (parameter.minimum, parameter.maximum),
            vanishes_at: None,
            scope: if parameter.shared {
                Scope::Shared
            } else {
                Scope::PerTightening
            },
        })
        .collect();
    let used: Vec<&str> = settings
        .place
        .variables()
        .iter()
        .filter(|variable| program.uses(**variable))
        .map(|variable| variable.name())
        .collect();
    let (symbol, what) = match settings.place {
        Place::Force => ("F", "the force between tool and hand"),
        Place::Torque => ("T", "the torque that acts"),
        Place::Measurement => ("a", "the measured acceleration"),
    };
    let expression = &settings.expression;
    Box::leak(Box::new(Description {
        name: kept(settings.name.clone()),
        kind: Kind::Custom,
        acts_on: ActsOn::Anything,
        summary: kept(format!(
            "A law that the study wrote itself: {expression} is added to {what}."
        )),
        equation: kept(format!("{symbol} + {expression}")),
        parameters: Box::leak(parameters.into_boxed_slice()),
        states: &[],
        twins: &[],
        excited_by: if used.is_empty() {
            "nothing: it is there at rest"
        } else {
            kept(format!("whatever changes {}", used.join(", ")))
        },
        shows_as: kept(format!("misfit that follows {expression}")),
        check: "Whether anything at the rig acts as this law says: the study's author knows what is meant.",
        on_machine: None,
        valid_for: "what the study's author means it for",
        source: "the study file",
    }))
}
