//! What one simulation is given and where its answer goes.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::model::Model;
use crate::error::ModelError;
use crate::input::torque::Input;
use snug_campaign::Quantity;

/// One of several simulations that run side by side.
pub struct Run<'a> {
    /// Rig and effects.
    pub model: &'a Model,
    /// All parameters of the model, each in its unit.
    pub values: &'a [f64],
    /// The torque.
    pub input: &'a Input,
    /// What is measured.
    pub quantity: Quantity,
    /// Gets the measured quantity, one value per sample, in its unit \[rad\], \[rad/s\] or \[rad/s²\].
    pub output: &'a mut [f64],
    /// Gets ∂output/∂values\[free\[j\]\], column-major, samples × free, in the quantity's unit per the
    /// parameter's.
    pub sensitivity: &'a mut [f64],
}

impl Run<'_> {
    /// Checks values, input and the room for the answer, before anything is simulated.
    pub(super) fn check(&self, free: &[usize]) -> Result<(), ModelError> {
        self.model.check_simulation(self.values, self.input)?;
        let (samples, parameters) = (self.input.samples(), self.values.len());
        check_length("output", self.output, samples)?;
        check_length("sensitivity", self.sensitivity, samples * free.len())?;
        match free.iter().find(|&&index| index >= parameters) {
            Some(&index) => Err(ModelError::ParameterIndex { index, parameters }),
            None => Ok(()),
        }
    }

    /// Whether the two take the same steps with the same laws, in which case one vector register can hold both.
    pub(super) fn is_alike(&self, other: &Run<'_>) -> bool {
        SimulationInputs::<f64>::are_alike(self.input, other.input)
            && self.quantity == other.quantity
            && self.model.effects().eq(other.model.effects())
    }
}

impl Model {
    /// Checks what a simulation is given.
    ///
    /// # Errors
    /// As [`Model::simulate`].
    pub(crate) fn check_simulation(&self, values: &[f64], input: &Input) -> Result<(), ModelError> {
        check_length("values", values, self.parameters().len())?;
        input.check()
    }
}

/// Checks that what is called `what` is as long as it must be.
///
/// # Errors
/// [`ModelError::Length`].
pub(crate) fn check_length(
    what: &'static str,
    found: &[f64],
    expected: usize,
) -> Result<(), ModelError> {
    match found.len() {
        found if found == expected => Ok(()),
        found => Err(ModelError::Length {
            what,
            found,
            expected,
        }),
    }
}
