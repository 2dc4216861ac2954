//! A regression y = f(x; b) as a residual with exact sensitivities.

use super::dual::{Dual, MOST_PARAMETERS};
use super::models::Model;
use snug_least_squares::{EvaluationError, Residual};

#[derive(Clone)]
pub struct Regression {
    pub model: Model,
    pub parameter_count: usize,
    /// (x, y) per observation.
    pub observations: Vec<(Vec<f64>, f64)>,
}

impl Residual for Regression {
    fn residual_count(&self) -> usize {
        self.observations.len()
    }

    fn parameter_count(&self) -> usize {
        self.parameter_count
    }

    fn evaluate(
        &mut self,
        parameters: &[f64],
        residual: &mut [f64],
        mut jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        assert!(parameters.len() <= MOST_PARAMETERS);
        let variables: Vec<Dual> = (parameters.iter().enumerate())
            .map(|(index, &value)| Dual::variable(value, index))
            .collect();
        for (row, (x, y)) in self.observations.iter().enumerate() {
            let simulated = (self.model)(&variables, x);
            residual[row] = y - simulated.value;
            if let Some(jacobian) = &mut jacobian {
                for column in 0..parameters.len() {
                    jacobian[column * self.observations.len() + row] = -simulated.slopes[column];
                }
            }
        }
        Ok(())
    }
}
