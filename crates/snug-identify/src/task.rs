//! What is identified: one tightening with all it takes to fit it.

mod contradiction;
pub(crate) mod decimated;
mod in_motion;

pub use in_motion::{begin_elsewhere, begin_in_motion};

use crate::error::IdentifyError;
use crate::residual::restarts::motions_at;
use crate::residual::scoring::{Scoring, has_lines};
use crate::residual::thresholds::RESTARTED_EVERY_S;
use crate::residual::tightening::TighteningResidual;
use crate::residual::whitening::Whitening;
use crate::settings::IdentifySettings;
use snug_campaign::{Intersample, NoiseFloor, Quantity, Rig, Tightening};
use snug_model::{Effect, Input, Model, ModelError};
use std::borrow::Cow;

/// One tightening with all it takes to fit it; its parts are its own or lent to it.
#[derive(Debug, Clone)]
pub struct FitTask<'a> {
    /// The measurement.
    pub tightening: Cow<'a, Tightening>,
    /// The torque, as it behaves between its samples.
    pub input: Cow<'a, Input>,
    /// Its free parameters are identified.
    pub model: Cow<'a, Model>,
    /// How.
    pub settings: Cow<'a, IdentifySettings>,
}

impl<'a> FitTask<'a> {
    /// Of parts that belong to others.
    pub fn new(
        tightening: &'a Tightening,
        input: &'a Input,
        model: &'a Model,
        settings: &'a IdentifySettings,
    ) -> Self {
        Self {
            tightening: Cow::Borrowed(tightening),
            input: Cow::Borrowed(input),
            model: Cow::Borrowed(model),
            settings: Cow::Borrowed(settings),
        }
    }

    /// From arrays: the torque \[Nm\] and what it made of one `quantity` \[rad\], \[rad/s\] or \[rad/s²\], both sampled every
    /// `interval_s` \[s\], on a rig.
    ///
    /// The torque runs straight from sample to sample; the model is mass, damping and stiffness alone, the settings are the
    /// usual ones.
    ///
    /// # Errors
    /// [`IdentifyError::Model`] for a rig or an interval that cannot be, and as [`FitTask::check`].
    pub fn from_arrays(
        rig: Rig,
        interval_s: f64,
        torque_nm: Vec<f64>,
        quantity: Quantity,
        output: Vec<f64>,
    ) -> Result<FitTask<'static>, IdentifyError> {
        let task = FitTask {
            input: Cow::Owned(Input::new(&torque_nm, interval_s, Intersample::Linear)),
            model: Cow::Owned(Model::new(rig, &[])?),
            settings: Cow::Owned(IdentifySettings {
                fitted_output: quantity,
                ..IdentifySettings::default()
            }),
            tightening: Cow::Owned(
                Tightening::from_torque(rig, interval_s, torque_nm).with(quantity, output),
            ),
        };
        task.check().map(|()| task)
    }

    /// The same with the noise of what was measured.
    pub fn with_noise(mut self, noise: NoiseFloor) -> Self {
        self.tightening.to_mut().noise = Some(noise);
        self
    }

    /// The same, lent.
    pub fn lent(&self) -> FitTask<'_> {
        FitTask::new(&self.tightening, &self.input, &self.model, &self.settings)
    }

    /// The same, lent, with another model.
    pub fn with_model<'b>(&'b self, model: &'b Model) -> FitTask<'b> {
        FitTask::new(&self.tightening, &self.input, model, &self.settings)
    }

    /// The output that is fitted.
    pub fn quantity(&self) -> Quantity {
        self.settings.fitted_output
    }

    /// Samples at the window's start that count for nothing.
    pub fn unscored(&self) -> usize {
        self.settings.unscored_samples
    }

    /// The measured output that is fitted; empty where it was not measured.
    pub fn measured(&self) -> &[f64] {
        self.tightening.motion.get(self.quantity()).unwrap_or(&[])
    }

    /// How long it lasts \[s\].
    pub fn lasts_s(&self) -> f64 {
        self.measured().len() as f64 * self.tightening.time_base.interval_s
    }

    /// The filter that whitens the measured noise, where that is of the fitted output.
    pub fn whitening(&self) -> Option<Whitening> {
        Whitening::of(&self.tightening, self.quantity())
    }

    /// What counts of what a model leaves of it.
    pub fn scoring(&self) -> Scoring {
        let whitening = self.whitening();
        Scoring::new(self.quantity(), &self.input, whitening, self.unscored())
    }

    /// Measured minus simulated by a `model`, as the solver sees it.
    ///
    /// # Errors
    /// As [`TighteningResidual::new`].
    pub fn residual<'b>(
        &'b self,
        model: &'b Model,
    ) -> Result<TighteningResidual<'b>, IdentifyError> {
        let (measured, quantity) = (self.measured(), self.quantity());
        TighteningResidual::new(model, &self.input, measured, quantity, self.scoring())
    }

    /// What counts of measured − `simulated`, in the output's unit, whether the noise is known or not; see [`Scoring`].
    pub fn left(&self, simulated: &[f64]) -> Vec<f64> {
        let scoring = Scoring::new(self.quantity(), &self.input, None, self.unscored());
        let mut counts = vec![0.0; scoring.count()];
        scoring.weigh(&self.missed(simulated), &mut counts);
        counts
    }

    /// Measured − `simulated` of every sample, in the output's unit.
    pub fn missed(&self, simulated: &[f64]) -> Vec<f64> {
        let pairs = self.measured().iter().zip(simulated);
        pairs.map(|(y, s)| y - s).collect()
    }

    /// Whether straight lines from restart to restart count only where they are no errors of the motion taken up; see [`Scoring`].
    pub fn is_beside_lines(&self) -> bool {
        has_lines(self.quantity(), &self.input) && self.whitening().is_none()
    }

    /// Σ of squares of what is [`left`](Self::left), in the output's unit squared, where `model` has these values of all its
    /// parameters.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn squares_left(&self, model: &Model, values: &[f64]) -> Result<f64, ModelError> {
        let simulated = self.simulated(model, values)?;
        Ok(self.left(&simulated).iter().map(|r| r * r).sum())
    }

    /// The fitted output of every sample, in its unit, where `model` has these values of all its parameters.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn simulated(&self, model: &Model, values: &[f64]) -> Result<Vec<f64>, ModelError> {
        let mut simulated = vec![0.0; self.measured().len()];
        model.output(values, &self.input, self.quantity(), &mut simulated)?;
        Ok(simulated)
    }

    /// Its first `samples` samples.
    pub fn beginning(&self, samples: usize) -> FitTask<'static> {
        let mut tightening = self.tightening.clone().into_owned();
        tightening.torque_nm.truncate(samples);
        if let Some(force_n) = &mut tightening.grip_force_n {
            force_n.truncate(samples);
        }
        for quantity in Quantity::ALL {
            if let Some(signal) = tightening.motion.get(quantity) {
                let signal = signal[..samples.min(signal.len())].to_vec();
                tightening.motion.set(quantity, signal);
            }
        }
        FitTask {
            tightening: Cow::Owned(tightening),
            input: Cow::Owned(self.input.beginning(samples)),
            model: Cow::Owned(self.model.clone().into_owned()),
            settings: Cow::Owned(self.settings.clone().into_owned()),
        }
    }

    /// The same with the simulation led along the measured motion: every few milliseconds it takes up the angle and the
    /// velocity there (multiple shooting from measured states). `None` where another quantity than the acceleration is
    /// fitted, which restarts hide, or the rest of the motion is not known.
    pub fn along_motion(&self) -> Option<FitTask<'_>> {
        let motion = &self.tightening.motion;
        let angle_rad = motion.get(Quantity::Displacement)?;
        let velocity_rad_per_s = motion.get(Quantity::Velocity)?;
        if self.quantity() != Quantity::Acceleration || self.input.is_restarted() {
            return None;
        }
        let every_s = RESTARTED_EVERY_S * self.model.scale().times_hand("s", self.model.rig());
        let apart = (every_s / self.tightening.time_base.interval_s).ceil() as usize;
        let motions = motions_at(angle_rad, velocity_rad_per_s, apart);
        let input = self
            .input
            .clone()
            .into_owned()
            .with_restarts(apart, motions);
        Some(FitTask {
            input: Cow::Owned(input),
            ..self.lent()
        })
    }

    /// Its model with other effects; what is said of parameters that both have stays.
    ///
    /// # Errors
    /// [`ModelError`] where the effects do not go together.
    pub fn model_with(&self, effects: &[Effect]) -> Result<Model, ModelError> {
        let mut model = self.model.with_effects(effects)?;
        for parameter in model.parameters_mut() {
            // A size that was found from all tightenings together is looked for again.
            if parameter.standard_error.take().is_some() {
                parameter.fixed = false;
            }
        }
        Ok(model)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_campaign::{Intersample, Rig};
    use snug_model::{CustomEffectSettings, CustomParameterSettings, Place};

    fn law(name: &str, expression: &str) -> Effect {
        Effect::custom(&CustomEffectSettings {
            name: name.to_owned(),
            place: Place::Force,
            expression: expression.to_owned(),
            parameters: vec![CustomParameterSettings {
                name: "p".to_owned(),
                unit: "N".to_owned(),
                ..CustomParameterSettings::default()
            }],
        })
        .unwrap()
    }

    /// Both laws call their size p; the second is `second_p` beside the first.
    #[test]
    fn what_is_said_of_an_effect_is_said_of_no_other_of_the_same_name() {
        let rig = Rig {
            lever_arm_m: 0.33,
            known_inertia_kg_m2: 0.275,
        };
        let (first, second) = (law("first", "p*x^3"), law("second", "p*v^3"));
        let mut model = Model::new(rig, &[first, second]).unwrap();
        for (parameter, value) in model.parameters_mut().iter_mut().zip(1..) {
            parameter.value = f64::from(value);
        }
        let tightening = Tightening::from_torque(rig, 1e-3, vec![0.0; 3]);
        let input = Input::new(&tightening.torque_nm, 1e-3, Intersample::Linear);
        let settings = IdentifySettings::default();
        let task = FitTask::new(&tightening, &input, &model, &settings);
        let values = |effects: &[Effect]| -> Vec<f64> {
            let model = task.model_with(effects).unwrap();
            model.parameters().iter().map(|p| p.value).collect()
        };
        assert_eq!(values(&[second]), [1.0, 2.0, 3.0, 5.0]);
        assert_eq!(values(&[law("third", "p*v")]), [1.0, 2.0, 3.0, 0.0]);
        assert_eq!(values(&[second, first]), [1.0, 2.0, 3.0, 5.0, 4.0]);
    }
}
