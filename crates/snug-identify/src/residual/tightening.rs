//! Measured minus simulated, whitened, with its sensitivities: a tightening as the solver sees it.

use crate::batch::SimulationRequest;
use crate::error::IdentifyError;
use crate::residual::scoring::Scoring;
use crate::residual::smoothing::smooth;
use snug_campaign::Quantity;
use snug_least_squares::{EvaluationError, Residual};
use snug_model::{Effect, Input, Model, ScoredRecord};

/// Measured minus simulated output of one tightening over the model's free parameters, whitened where the noise is known.
#[derive(Clone)]
pub struct TighteningResidual<'a> {
    model: &'a Model,
    input: &'a Input,
    measured: &'a [f64],
    quantity: Quantity,
    scoring: Scoring,
    /// Samples to either side over which the residual is averaged.
    half_width: usize,
    free: Vec<usize>,
    values: Vec<f64>,
    output: Vec<f64>,
    sensitivity: Vec<f64>,
    prefetched: Foreseen,
}

/// Why its simulations are not refused.
const CHECKED: &str = "input and lengths were checked when the residual was made";

/// A simulation that was made before it was asked for.
#[derive(Clone, Default)]
struct Foreseen {
    /// Of all parameters.
    values: Vec<f64>,
    with_slopes: bool,
    output: Vec<f64>,
    sensitivity: Vec<f64>,
}

impl<'a> TighteningResidual<'a> {
    /// Of a measured `quantity`, of which that counts which `scoring` says.
    ///
    /// # Errors
    /// [`IdentifyError::InputLength`] unless there is one measured sample per sample of the input, and
    /// [`IdentifyError::Model`] for an input that cannot be simulated.
    pub fn new(
        model: &'a Model,
        input: &'a Input,
        measured: &'a [f64],
        quantity: Quantity,
        scoring: Scoring,
    ) -> Result<Self, IdentifyError> {
        input.check()?;
        if input.samples() != measured.len() {
            return Err(IdentifyError::InputLength {
                input_samples: input.samples(),
                output_samples: measured.len(),
            });
        }
        let free = model.free();
        Ok(Self {
            model,
            input,
            measured,
            quantity,
            scoring,
            half_width: 0,
            values: model.parameters().iter().map(|p| p.value).collect(),
            output: Vec::new(),
            sensitivity: Vec::new(),
            prefetched: Foreseen::default(),
            free,
        })
    }

    /// The same averaged over `half_width` samples to either side, see [`smooth`].
    pub(crate) fn smoothed(&self, half_width: usize) -> Self {
        Self {
            half_width,
            ..self.clone()
        }
    }

    /// Number of samples, scored or not.
    pub fn samples(&self) -> usize {
        self.measured.len()
    }

    /// The fitted quantity.
    pub fn quantity(&self) -> Quantity {
        self.quantity
    }

    /// Another quantity, simulated with these free values.
    pub fn simulate(&mut self, free_values: &[f64], quantity: Quantity) -> Vec<f64> {
        let mut output = vec![0.0; self.samples()];
        let (model, input) = (self.model, self.input);
        model
            .output(self.all_values(free_values), input, quantity, &mut output)
            .expect(CHECKED);
        output
    }

    /// What counts of it.
    pub(crate) fn scoring(&self) -> &Scoring {
        &self.scoring
    }

    /// Whether the residual is whitened with a known noise.
    pub fn is_whitened(&self) -> bool {
        self.scoring.whitening().is_some()
    }

    /// Whether one of the model's effects lets go of the hand's spring, at instants between which the residual jumps.
    pub(crate) fn has_unilateral_contact(&self) -> bool {
        self.model.effects().any(Effect::has_unilateral_contact)
    }

    /// Refuses fewer residuals than free parameters.
    ///
    /// # Errors
    /// [`IdentifyError::TooShort`].
    pub fn check_length(&self) -> Result<(), IdentifyError> {
        let (residuals, parameters) = (self.residual_count(), self.parameter_count());
        if residuals > parameters {
            Ok(())
        } else {
            Err(IdentifyError::TooShort {
                residuals,
                parameters,
            })
        }
    }

    /// Whether sweeps of the base model fit it: they know no effects and no restarts.
    pub(crate) fn is_base(&self) -> bool {
        self.model.effects().next().is_none() && !self.input.is_restarted() && !self.free.is_empty()
    }

    /// Grid points of the input per sample.
    pub(crate) fn substeps(&self) -> usize {
        self.input.substeps()
    }

    /// What is scored, both sides weighed, for the sweeps that fit the base model.
    pub(crate) fn scored(&self) -> ScoredRecord<'a> {
        let (substeps, grid) = (self.input.substeps(), self.input.grid_nm());
        let unscored = self.scoring.unscored();
        let measured = &self.measured[unscored..];
        let torque = &grid[(unscored * substeps).min(grid.len())..];
        let scored = self.residual_count();
        let order = measured.len() - scored;
        let (filter, torque_nm, measured) = match self.scoring.whitening() {
            Some(whitening) => {
                let mut white_torque = vec![0.0; torque.len().saturating_sub(order * substeps)];
                let mut white = vec![0.0; scored];
                whitening.apply_to_grid(torque, substeps, &mut white_torque);
                whitening.apply(measured, &mut white);
                (whitening.weights(), white_torque.into(), white.into())
            }
            None => (vec![1.0], torque.into(), measured.into()),
        };
        ScoredRecord {
            rig: *self.model.rig(),
            input: self.input,
            filter,
            first: unscored + order,
            torque_nm,
            measured,
        }
    }

    /// Every sample as it was measured, the acceleration beside the torque (zero where it was not measured).
    pub(crate) fn beside(&self, acceleration: Option<&'a [f64]>) -> ScoredRecord<'a> {
        ScoredRecord {
            rig: *self.model.rig(),
            input: self.input,
            filter: vec![1.0],
            first: 0,
            torque_nm: self.input.grid_nm().into(),
            measured: match acceleration {
                Some(measured) => measured.into(),
                None => vec![0.0; self.samples()].into(),
            },
        }
    }

    /// All parameters of the model at these free values.
    pub(crate) fn all_values(&mut self, free_values: &[f64]) -> &[f64] {
        for (&index, &value) in self.free.iter().zip(free_values) {
            self.values[index] = value;
        }
        &self.values
    }

    /// Indices of the free parameters in the model.
    pub(crate) fn free(&self) -> &[usize] {
        &self.free
    }

    /// What counts of a `signal` of every sample, see [`Scoring::weigh`].
    pub fn weigh(&self, signal: &[f64], scored: &mut [f64]) {
        self.scoring.weigh(signal, scored);
    }
}

impl<'a> TighteningResidual<'a> {
    /// The simulation with these free values, which whoever makes it may make beside others.
    pub(crate) fn request(
        &mut self,
        free_values: &[f64],
        with_slopes: bool,
    ) -> SimulationRequest<'a> {
        let samples = self.samples();
        let mut room = std::mem::take(&mut self.prefetched);
        room.output.resize(samples, 0.0);
        room.sensitivity.resize(samples * self.free.len(), 0.0);
        SimulationRequest {
            model: self.model,
            input: self.input,
            quantity: self.quantity,
            values: self.all_values(free_values).to_vec(),
            free: match with_slopes {
                true => self.free.clone(),
                false => Vec::new(),
            },
            output: room.output,
            sensitivity: room.sensitivity,
            is_done: false,
        }
    }

    /// Keeps a simulation that was [requested](Self::request): if the residual is asked for there next, it is at hand.
    pub(crate) fn prefetch(&mut self, simulated: SimulationRequest<'a>) {
        self.prefetched = Foreseen {
            values: simulated.values,
            with_slopes: !simulated.free.is_empty(),
            output: simulated.output,
            sensitivity: simulated.sensitivity,
        };
    }
}

impl TighteningResidual<'_> {
    fn weigh_and_average(&self, signal: &[f64], scored: &mut [f64]) {
        self.weigh(signal, scored);
        if self.half_width > 0 {
            smooth(scored, self.half_width);
        }
    }

    /// The fixed parameters that are not known exactly: index in the model and standard error.
    pub(crate) fn uncertain(&self) -> Vec<(usize, f64)> {
        let parameters = self.model.parameters().iter().enumerate();
        parameters
            .filter(|(_, parameter)| parameter.fixed)
            .filter_map(|(index, parameter)| Some((index, parameter.standard_error?)))
            .collect()
    }

    /// ∂r/∂p of any parameter of the model at the values last evaluated, weighted as the residual.
    pub(crate) fn column_of(&self, parameter: usize) -> Vec<f64> {
        let samples = self.samples();
        let (mut output, mut column) = (vec![0.0; samples], vec![0.0; samples]);
        self.model
            .sensitivities(
                &self.values,
                &[parameter],
                self.input,
                self.quantity,
                &mut output,
                &mut column,
            )
            .expect(CHECKED);
        for value in &mut column {
            *value = -*value;
        }
        let mut weighted = vec![0.0; self.residual_count()];
        self.weigh(&column, &mut weighted);
        weighted
    }

    /// Measured − simulated of every sample and, where asked, its Jacobian (column-major, samples × free).
    fn subtract(&self, residual: &mut [f64], jacobian: Option<&mut [f64]>) {
        let prefetched = &self.prefetched;
        let is_foreseen =
            prefetched.values == self.values && prefetched.with_slopes == jacobian.is_some();
        if is_foreseen {
            residual.copy_from_slice(&prefetched.output);
        }
        match jacobian {
            Some(jacobian) if is_foreseen => {
                for (slope, simulated) in jacobian.iter_mut().zip(&prefetched.sensitivity) {
                    *slope = -simulated;
                }
            }
            None if is_foreseen => {}
            Some(jacobian) => {
                self.model
                    .sensitivities(
                        &self.values,
                        &self.free,
                        self.input,
                        self.quantity,
                        residual,
                        jacobian,
                    )
                    .expect(CHECKED);
                for value in jacobian {
                    *value = -*value;
                }
            }
            None => self
                .model
                .output(&self.values, self.input, self.quantity, residual)
                .expect(CHECKED),
        }
        for (simulated, measured) in residual.iter_mut().zip(self.measured) {
            *simulated = measured - *simulated;
        }
    }
}

impl Residual for TighteningResidual<'_> {
    fn residual_count(&self) -> usize {
        self.scoring.count()
    }

    fn parameter_count(&self) -> usize {
        self.free.len()
    }

    fn evaluate(
        &mut self,
        parameters: &[f64],
        residual: &mut [f64],
        jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        self.all_values(parameters);
        if self.scoring.is_plain() && self.half_width == 0 {
            // Every sample counts, and counts the same: straight into the solver's buffers.
            self.subtract(residual, jacobian);
            return Ok(());
        }
        let (mut every, mut sensitivity) = (
            std::mem::take(&mut self.output),
            std::mem::take(&mut self.sensitivity),
        );
        let wanted = jacobian.is_some();
        every.resize(self.samples(), 0.0);
        sensitivity.resize(self.samples() * self.free.len(), 0.0);
        self.subtract(&mut every, wanted.then_some(&mut sensitivity[..]));
        self.weigh_and_average(&every, residual);
        if let Some(jacobian) = jacobian {
            let (samples, scored) = (self.measured.len(), residual.len());
            for (column, weighted) in sensitivity
                .chunks_exact(samples)
                .zip(jacobian.chunks_exact_mut(scored))
            {
                self.weigh_and_average(column, weighted);
            }
        }
        self.output = every;
        self.sensitivity = sensitivity;
        Ok(())
    }
}
