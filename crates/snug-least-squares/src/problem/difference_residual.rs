//! A residual that is a function alone: its Jacobian by differences.

use crate::error::EvaluationError;
use crate::problem::residual::Residual;

/// A residual without known sensitivities: J by central differences, (r(p + h) − r(p − h)) / 2h with
/// h = ε^(1/3) max(|p|, size), accurate to about 1e-10 of each column.
///
/// Where one side lies outside the model's domain, the other side alone is used. A fit costs 2n more evaluations per
/// linearisation than with exact sensitivities.
#[derive(Debug, Clone)]
pub struct DifferenceResidual<F> {
    function: F,
    residual_count: usize,
    sizes: Vec<f64>,
    shifted: Vec<f64>,
    forward: Vec<f64>,
    backward: Vec<f64>,
}

impl<F> DifferenceResidual<F>
where
    F: FnMut(&[f64], &mut [f64]) -> Result<(), EvaluationError>,
{
    /// `function` writes r(p) into its second argument. `sizes` says for each parameter which change is the smallest
    /// that matters when its value is zero or nearly so, in the parameter's own unit.
    pub fn new(residual_count: usize, sizes: &[f64], function: F) -> Self {
        Self {
            function,
            residual_count,
            sizes: sizes.to_vec(),
            shifted: vec![0.0; sizes.len()],
            forward: vec![0.0; residual_count],
            backward: vec![0.0; residual_count],
        }
    }

    fn column(
        &mut self,
        parameters: &[f64],
        index: usize,
        residual: &[f64],
        column: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let value = parameters[index];
        let width = f64::EPSILON.cbrt() * value.abs().max(self.sizes[index]);
        let (above, below) = (value + width, value - width);
        self.shifted.copy_from_slice(parameters);
        self.shifted[index] = above;
        let is_above = (self.function)(&self.shifted, &mut self.forward);
        self.shifted[index] = below;
        let is_below = (self.function)(&self.shifted, &mut self.backward);
        let (high, low, span) = match (is_above, is_below) {
            (Ok(()), Ok(())) => (&self.forward[..], &self.backward[..], above - below),
            (Ok(()), Err(_)) => (&self.forward[..], residual, above - value),
            (Err(_), Ok(())) => (residual, &self.backward[..], value - below),
            (Err(error), Err(_)) => return Err(error),
        };
        for ((slope, high), low) in column.iter_mut().zip(high).zip(low) {
            *slope = (high - low) / span;
        }
        Ok(())
    }
}

impl<F> Residual for DifferenceResidual<F>
where
    F: FnMut(&[f64], &mut [f64]) -> Result<(), EvaluationError>,
{
    fn residual_count(&self) -> usize {
        self.residual_count
    }

    fn parameter_count(&self) -> usize {
        self.sizes.len()
    }

    fn evaluate(
        &mut self,
        parameters: &[f64],
        residual: &mut [f64],
        jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        (self.function)(parameters, residual)?;
        let Some(jacobian) = jacobian else {
            return Ok(());
        };
        for (index, column) in jacobian.chunks_exact_mut(residual.len().max(1)).enumerate() {
            self.column(parameters, index, residual, column)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn slopes_are_right_inside_the_domain_and_at_its_edge() {
        let root = |p: &[f64], r: &mut [f64]| {
            if p[0] < 1.0 {
                return Err(EvaluationError::OutsideDomain {
                    parameter: 0,
                    value: p[0],
                });
            }
            r[0] = p[0].ln() * p[1];
            Ok(())
        };
        let mut residual = DifferenceResidual::new(1, &[1.0, 1.0], root);
        let (mut r, mut j) = ([0.0], [0.0; 2]);
        residual
            .evaluate(&[2.0, 3.0], &mut r, Some(&mut j))
            .unwrap();
        assert!(
            (j[0] - 1.5).abs() < 1e-9 && (j[1] - 2.0_f64.ln()).abs() < 1e-10,
            "{j:?}"
        );
        residual
            .evaluate(&[1.0, 3.0], &mut r, Some(&mut j))
            .unwrap();
        assert!((j[0] - 3.0).abs() < 1e-4, "one-sided: {j:?}");
        assert!(residual.evaluate(&[0.5, 3.0], &mut r, None).is_err());
    }
}
