//! Whether the parts of a task contradict each other.

use super::FitTask;
use crate::error::IdentifyError;
use snug_campaign::Quantity;
use snug_signal::first_not_finite;

/// Two grids of times are the same up to this part of their interval: who divides and multiplies by a rate rounds.
const SAME_INTERVAL_RATIO: f64 = 1e-9;

impl FitTask<'_> {
    /// Checks what can be known before anything is computed: that the fitted output was measured, that every channel is as
    /// long as the torque and holds finite numbers, and that input and model are those of the tightening.
    ///
    /// # Errors
    /// [`IdentifyError::MissingOutput`], [`IdentifyError::UnequalLengths`], [`IdentifyError::NotFinite`],
    /// [`IdentifyError::InputLength`], [`IdentifyError::InputTorque`], [`IdentifyError::InputInterval`],
    /// [`IdentifyError::OtherRig`], [`IdentifyError::Noise`], [`IdentifyError::FixedParameter`]; [`IdentifyError::Model`] for
    /// an input that cannot be simulated.
    pub fn check(&self) -> Result<(), IdentifyError> {
        let quantity = self.quantity();
        if self.tightening.motion.get(quantity).is_none() {
            return Err(IdentifyError::MissingOutput { quantity });
        }
        self.check_channels()?;
        self.input.check()?;
        self.check_input()?;
        self.check_rig()?;
        self.check_noise()?;
        let mut parameters = self.model.parameters().iter();
        match parameters.find(|one| one.fixed && !one.value.is_finite()) {
            Some(parameter) => Err(IdentifyError::FixedParameter {
                name: parameter.name.clone(),
                value: parameter.value,
            }),
            None => Ok(()),
        }
    }

    fn check_channels(&self) -> Result<(), IdentifyError> {
        let torque_nm = self.tightening.torque_nm.as_slice();
        let measured = Quantity::ALL.into_iter().filter_map(|quantity| {
            let samples = self.tightening.motion.get(quantity)?;
            Some((quantity.name(), samples))
        });
        for (channel, samples) in [("torque", torque_nm)].into_iter().chain(measured) {
            if samples.len() != torque_nm.len() {
                return Err(IdentifyError::UnequalLengths {
                    channel,
                    samples: samples.len(),
                    torque_samples: torque_nm.len(),
                });
            }
            if let Some(sample) = first_not_finite(samples) {
                return Err(IdentifyError::NotFinite {
                    channel,
                    sample,
                    value: samples[sample],
                });
            }
        }
        Ok(())
    }

    fn check_input(&self) -> Result<(), IdentifyError> {
        let (logged_nm, torque_nm) = (self.input.logged_nm(), &self.tightening.torque_nm);
        if logged_nm.len() != torque_nm.len() {
            return Err(IdentifyError::InputLength {
                input_samples: logged_nm.len(),
                output_samples: torque_nm.len(),
            });
        }
        let pairs = || logged_nm.iter().zip(torque_nm);
        // Without a way out of it the loop runs in vector registers.
        if !pairs().fold(true, |same, (one, other)| same & (one == other)) {
            let sample = pairs().position(|(one, other)| one != other).unwrap_or(0);
            return Err(IdentifyError::InputTorque {
                sample,
                input_nm: logged_nm[sample],
                tightening_nm: torque_nm[sample],
            });
        }
        let input_s = self.input.interval_s();
        let tightening_s = self.tightening.time_base.interval_s;
        match (input_s - tightening_s).abs() <= SAME_INTERVAL_RATIO * input_s {
            true => Ok(()),
            false => Err(IdentifyError::InputInterval {
                input_s,
                tightening_s,
            }),
        }
    }

    /// A standard deviation of 0 is allowed: a channel that was still in its quiet part has it, and is not whitened.
    fn check_noise(&self) -> Result<(), IdentifyError> {
        let Some(noise) = &self.tightening.noise else {
            return Ok(());
        };
        let refused = |what, value, allowed| {
            Err(IdentifyError::Noise {
                what,
                value,
                allowed,
            })
        };
        for (what, value) in [
            ("standard_deviation", noise.standard_deviation),
            ("innovation_sd", noise.innovation_sd),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return refused(what, value, "0 or a positive, finite number");
            }
        }
        match first_not_finite(&noise.autoregression) {
            Some(at) => refused("autoregression", noise.autoregression[at], "finite numbers"),
            None => Ok(()),
        }
    }

    fn check_rig(&self) -> Result<(), IdentifyError> {
        let (model, tightening) = (self.model.rig(), &self.tightening.rig);
        let fields = [
            ("lever_arm_m", model.lever_arm_m, tightening.lever_arm_m),
            (
                "known_inertia_kg_m2",
                model.known_inertia_kg_m2,
                tightening.known_inertia_kg_m2,
            ),
        ];
        match fields.into_iter().find(|(_, one, other)| one != other) {
            Some((field, model, tightening)) => Err(IdentifyError::OtherRig {
                field,
                model,
                tightening,
            }),
            None => Ok(()),
        }
    }
}
