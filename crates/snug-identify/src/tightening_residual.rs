use crate::{EvaluationError, IdentifyError, Residual, Whitening};
use snug_campaign::Quantity;
use snug_model::{Input, Model};

/// Measured minus simulated output of one tightening over the model's free parameters, whitened where the noise is known.
pub struct TighteningResidual<'a> {
    model: &'a Model,
    input: &'a Input,
    measured: &'a [f64],
    quantity: Quantity,
    whitening: Option<&'a Whitening>,
    unscored: usize,
    free: Vec<usize>,
    values: Vec<f64>,
    output: Vec<f64>,
    sensitivity: Vec<f64>,
}

impl<'a> TighteningResidual<'a> {
    /// `unscored` samples at the start count for nothing (an unknown initial state dies away in them).
    pub fn new(
        model: &'a Model,
        input: &'a Input,
        measured: &'a [f64],
        quantity: Quantity,
        whitening: Option<&'a Whitening>,
        unscored: usize,
    ) -> Self {
        let free = model.free();
        let samples = measured.len();
        Self {
            model,
            input,
            measured,
            quantity,
            whitening,
            unscored: unscored.min(samples),
            values: model.parameters().iter().map(|p| p.value).collect(),
            output: vec![0.0; samples],
            sensitivity: vec![0.0; samples * free.len()],
            free,
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
        for (&index, &value) in self.free.iter().zip(free_values) {
            self.values[index] = value;
        }
        let mut output = vec![0.0; self.samples()];
        self.model
            .output(&self.values, self.input, quantity, &mut output);
        output
    }

    /// Whether the residual is whitened with a known noise.
    pub fn is_whitened(&self) -> bool {
        self.whitening.is_some()
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

    /// Whitens (or copies) the scored part of `signal` into `scored`.
    pub fn weigh(&self, signal: &[f64], scored: &mut [f64]) {
        let signal = &signal[self.unscored..];
        match self.whitening {
            Some(whitening) => whitening.apply(signal, scored),
            None => scored.copy_from_slice(signal),
        }
    }
}

impl TighteningResidual<'_> {
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
        self.model.sensitivities(
            &self.values,
            &[parameter],
            self.input,
            self.quantity,
            &mut output,
            &mut column,
        );
        for value in &mut column {
            *value = -*value;
        }
        let mut weighted = vec![0.0; self.residual_count()];
        self.weigh(&column, &mut weighted);
        weighted
    }

    /// Measured − simulated of every sample and, where asked, its Jacobian (column-major, samples × free).
    fn subtract(&self, residual: &mut [f64], jacobian: Option<&mut [f64]>) {
        match jacobian {
            Some(jacobian) => {
                self.model.sensitivities(
                    &self.values,
                    &self.free,
                    self.input,
                    self.quantity,
                    residual,
                    jacobian,
                );
                for value in jacobian {
                    *value = -*value;
                }
            }
            None => self
                .model
                .output(&self.values, self.input, self.quantity, residual),
        }
        for (simulated, measured) in residual.iter_mut().zip(self.measured) {
            *simulated = measured - *simulated;
        }
    }
}

impl Residual for TighteningResidual<'_> {
    fn residual_count(&self) -> usize {
        let lost = self.whitening.map_or(0, Whitening::order);
        (self.measured.len() - self.unscored).saturating_sub(lost)
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
        for (&index, &value) in self.free.iter().zip(parameters) {
            self.values[index] = value;
        }
        if self.whitening.is_none() && self.unscored == 0 {
            // Every sample counts, and counts the same: straight into the solver's buffers.
            self.subtract(residual, jacobian);
            return Ok(());
        }
        let (mut every, mut sensitivity) = (
            std::mem::take(&mut self.output),
            std::mem::take(&mut self.sensitivity),
        );
        let wanted = jacobian.is_some();
        self.subtract(&mut every, wanted.then_some(&mut sensitivity[..]));
        self.weigh(&every, residual);
        if let Some(jacobian) = jacobian {
            let (samples, scored) = (self.measured.len(), residual.len());
            for (column, weighted) in sensitivity
                .chunks_exact(samples)
                .zip(jacobian.chunks_exact_mut(scored))
            {
                self.weigh(column, weighted);
            }
        }
        self.output = every;
        self.sensitivity = sensitivity;
        Ok(())
    }
}
