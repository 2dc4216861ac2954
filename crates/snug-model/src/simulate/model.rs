//! A model simulated by itself.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::model::Model;
use crate::error::ModelError;
use crate::input::torque::Input;
use crate::simulate::run::Run;
use crate::simulate::side_by_side::simulate_side_by_side;
use snug_campaign::{Motion, Quantity};

impl Model {
    /// The measured motion that `values` (all parameters) give under `input`.
    ///
    /// # Errors
    /// [`ModelError::Length`] where `values` are not one per parameter, [`ModelError::ParameterValue`] where one is no finite
    /// number, and as [`Input::check`].
    pub fn simulate(&self, values: &[f64], input: &Input) -> Result<Motion, ModelError> {
        self.check_simulation(values, input)?;
        let mut named = self.parameters().iter().zip(values);
        if let Some((parameter, &value)) = named.find(|(_, value)| !value.is_finite()) {
            return Err(ModelError::ParameterValue {
                name: parameter.name.clone(),
                value,
            });
        }
        let mut signals: [Vec<f64>; 3] =
            std::array::from_fn(|_| Vec::with_capacity(input.samples()));
        let inputs = SimulationInputs::new(0.0, |_| (self.assembly(), input));
        self.assembly().respond(values, &inputs, |_, motion| {
            signals[0].push(motion.displacement_rad);
            signals[1].push(motion.velocity_rad_per_s);
            signals[2].push(motion.acceleration_rad_per_s2);
        });
        let [displacement, velocity, acceleration] = signals;
        Ok(Motion {
            displacement_rad: Some(displacement),
            velocity_rad_per_s: Some(velocity),
            acceleration_rad_per_s2: Some(acceleration),
        })
    }

    /// One measured quantity into `output` (one value per sample).
    ///
    /// # Errors
    /// As [`simulate_side_by_side`].
    pub fn output(
        &self,
        values: &[f64],
        input: &Input,
        quantity: Quantity,
        output: &mut [f64],
    ) -> Result<(), ModelError> {
        self.sensitivities(values, &[], input, quantity, output, &mut [])
    }

    /// One measured quantity and its sensitivities.
    ///
    /// `output` gets one value per sample; `sensitivity` gets ∂output/∂values\[free\[j\]\], column-major, samples × free.
    ///
    /// # Errors
    /// As [`simulate_side_by_side`].
    pub fn sensitivities(
        &self,
        values: &[f64],
        free: &[usize],
        input: &Input,
        quantity: Quantity,
        output: &mut [f64],
        sensitivity: &mut [f64],
    ) -> Result<(), ModelError> {
        let mut alone = [Run {
            model: self,
            values,
            input,
            quantity,
            output,
            sensitivity,
        }];
        simulate_side_by_side(&mut alone, free)
    }
}
