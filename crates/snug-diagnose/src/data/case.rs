use snug_campaign::{Quantity, Tightening};
use snug_identify::{ConstraintKind, IdentifySettings, Whitening, motions_at};
use snug_model::{Effect, Input, Model};

use crate::error::DiagnoseError;

/// From one restart along the measured motion to the next \[s\]: enough for a law to show in the velocity.
const RESTARTED_EVERY_S: f64 = 3e-3;

/// One tightening as the diagnosis sees it: measurement, input and the study's own model for its rig.
#[derive(Debug, Clone)]
pub struct Case {
    /// The measurement.
    pub tightening: Tightening,
    /// The study's own model, with everything the study says about its parameters.
    pub model: Model,
    /// The input as the study says it behaves.
    pub input: Input,
    /// The output that is compared.
    pub quantity: Quantity,
    /// Samples at the window's start that count for nothing.
    pub unscored: usize,
    /// What must hold of m, c, k.
    pub constraints: Vec<ConstraintKind>,
}

impl Case {
    /// The measured output that is compared.
    pub(crate) fn measured(&self) -> &[f64] {
        self.tightening.motion.get(self.quantity).unwrap_or(&[])
    }

    /// The filter that whitens the measured noise, where it is of the compared output.
    pub(crate) fn whitening(&self) -> Option<Whitening> {
        Whitening::of(&self.tightening, self.quantity)
    }

    /// How it is identified by itself.
    pub(crate) fn settings(&self) -> IdentifySettings {
        IdentifySettings {
            fitted_output: self.quantity,
            constraints: self.constraints.clone(),
            unscored_samples: self.unscored,
            ..IdentifySettings::default()
        }
    }

    /// Whether residuals of the compared output can be told in multiples of its measured noise.
    pub fn has_noise(&self) -> bool {
        self.whitening().is_some()
    }

    /// Whether anything can be compared.
    pub fn is_comparable(&self) -> bool {
        self.measured().len() > self.unscored + 100
    }

    /// Its first `samples` samples.
    pub(crate) fn beginning(&self, samples: usize) -> Self {
        let mut beginning = self.clone();
        beginning.input = self.input.beginning(samples);
        let Tightening {
            torque_nm, motion, ..
        } = &mut beginning.tightening;
        torque_nm.truncate(samples);
        for quantity in Quantity::ALL {
            if let Some(signal) = motion.get(quantity) {
                let signal = signal[..samples.min(signal.len())].to_vec();
                motion.set(quantity, signal);
            }
        }
        beginning
    }

    /// The same with the simulation led along the measured motion: every few milliseconds it takes up the angle and the
    /// velocity there. `None` where another quantity than the acceleration is compared, which restarts hide, or the rest
    /// of the motion is not known.
    pub(crate) fn along_motion(&self) -> Option<Self> {
        let motion = &self.tightening.motion;
        let angle_rad = motion.get(Quantity::Displacement)?;
        let velocity_rad_per_s = motion.get(Quantity::Velocity)?;
        if self.quantity != Quantity::Acceleration || self.input.is_restarted() {
            return None;
        }
        let apart = (RESTARTED_EVERY_S / self.tightening.time_base.interval_s).ceil() as usize;
        let motions = motions_at(angle_rad, velocity_rad_per_s, apart);
        let mut led = self.clone();
        led.input = led.input.with_restarts(apart, motions);
        Some(led)
    }

    /// The study's own model with other effects after its own; what the study says of shared parameters stays.
    pub(crate) fn model_with(&self, effects: &[Effect]) -> Result<Model, DiagnoseError> {
        let mut model = Model::scaled(*self.model.rig(), effects, self.model.scale())?;
        for parameter in model.parameters_mut() {
            let own = self.model.parameters();
            if let Some(said) = own.iter().find(|own| own.name == parameter.name) {
                *parameter = said.clone();
                // A size that was found from all tightenings together is looked for again.
                if parameter.standard_error.take().is_some() {
                    parameter.fixed = false;
                }
            }
        }
        Ok(model)
    }
}
