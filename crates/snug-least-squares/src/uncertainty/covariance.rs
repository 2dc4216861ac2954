//! Covariance of an estimate under what is known of the noise; its intervals.
//!
//! Its sandwich (JᵀJ)⁻¹ M (JᵀJ)⁻¹ takes M as it is given and corrects nothing for small samples: whoever knows the noise
//! makes M, and where it is made of the residuals of few clusters a correction (CR1, CR2) is up to them.

use crate::matrix::{add_scaled, dot};
use crate::solver::fit::Fit;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// What is known about the noise in the residual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ResidualNoise<'a> {
    /// Independent with variance 1, as after whitening with a measured noise: C = (JᵀJ)⁻¹.
    Unit,
    /// Independent with one unknown variance: C = s² (JᵀJ)⁻¹, s² = ‖r‖²/(m − n).
    Estimated,
    /// Anything, given M = Jᵀ cov(r) J (n × n, row-major): C = (JᵀJ)⁻¹ M (JᵀJ)⁻¹.
    Sandwich(&'a [f64]),
}

/// Covariance of an estimate to first order, on the tangent space of its active constraints.
#[derive(Debug, Clone, PartialEq)]
pub struct Covariance {
    /// n × n, row-major; zero along blocked directions, and only the determined part where the rank is deficient.
    pub matrix: Vec<f64>,
    /// Square root of the diagonal; `None` where a constraint blocks the parameter or the residual does not determine it.
    pub standard_errors: Vec<Option<f64>>,
    /// Degrees of freedom of Student's t for intervals; `None` means the normal distribution.
    pub degrees_of_freedom: Option<f64>,
}

impl Fit {
    /// Covariance of the estimate under the given noise.
    pub fn covariance(&self, noise: ResidualNoise<'_>) -> Covariance {
        let n = self.values.len();
        let bread = times_transposed(&self.covariance_root, n);
        let freedom = self.degrees_of_freedom() as f64;
        let (matrix, degrees_of_freedom) = match noise {
            ResidualNoise::Unit => (bread, None),
            ResidualNoise::Estimated => {
                let variance = self.sum_of_squares() / freedom;
                let scaled = bread.iter().map(|value| variance * value).collect();
                (scaled, Some(freedom))
            }
            ResidualNoise::Sandwich(meat) => (product(&product(&bread, meat, n), &bread, n), None),
        };
        let standard_errors = (self.determined.iter().enumerate())
            .map(|(index, determined)| {
                let variance = matrix[index * n + index];
                (*determined && variance.is_finite()).then(|| variance.max(0.0).sqrt())
            })
            .collect();
        Covariance {
            matrix,
            standard_errors,
            degrees_of_freedom,
        }
    }
}

impl Covariance {
    /// Adds σ² g gᵀ: an independent error of size σ that moves the estimate along g.
    pub fn widen(&mut self, along: &[f64], standard_error: f64) {
        let n = along.len();
        for (row, &here) in along.iter().enumerate() {
            let factor = standard_error * standard_error * here;
            add_scaled(&mut self.matrix[row * n..(row + 1) * n], factor, along);
        }
        for (index, error) in self.standard_errors.iter_mut().enumerate() {
            *error = error.map(|_| self.matrix[index * n + index].max(0.0).sqrt());
        }
    }

    /// Two-sided interval value ± quantile · standard error of one parameter; `confidence` in (0, 1).
    ///
    /// `None` where there is no standard error or no degree of freedom.
    pub fn interval(&self, index: usize, value: f64, confidence: f64) -> Option<(f64, f64)> {
        let half = self.standard_errors[index]? * self.quantile(confidence)?;
        Some((value - half, value + half))
    }

    /// The factor on a standard error that gives a two-sided interval of this confidence.
    pub fn quantile(&self, confidence: f64) -> Option<f64> {
        let probability = 0.5 + 0.5 * confidence;
        match self.degrees_of_freedom {
            None => Some(Normal::standard().inverse_cdf(probability)),
            Some(freedom) => {
                let student = StudentsT::new(0.0, 1.0, freedom).ok()?;
                Some(student.inverse_cdf(probability))
            }
        }
    }
}

/// S Sᵀ, row-major, for a column-major n × n S.
fn times_transposed(root: &[f64], n: usize) -> Vec<f64> {
    let mut product = vec![0.0; n * n];
    for column in root.chunks_exact(n.max(1)) {
        for (row, &value) in product.chunks_exact_mut(n.max(1)).zip(column) {
            add_scaled(row, value, column);
        }
    }
    product
}

/// A B for row-major n × n matrices, B symmetric.
fn product(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let rows = a.chunks_exact(n.max(1));
    rows.flat_map(|row| b.chunks_exact(n.max(1)).map(move |column| dot(row, column)))
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        let mut covariance = Covariance {
            matrix: vec![4.0],
            standard_errors: vec![Some(2.0)],
            degrees_of_freedom: None,
        };
        // SciPy 1.17: norm.ppf(0.975), t.ppf(0.975, 7), t.ppf(0.995, 2.5).
        assert!((covariance.quantile(0.95).unwrap() - 1.959963984540054).abs() < 1e-9);
        covariance.degrees_of_freedom = Some(7.0);
        assert!((covariance.quantile(0.95).unwrap() - 2.364624251592784).abs() < 1e-8);
        covariance.degrees_of_freedom = Some(2.5);
        assert!((covariance.quantile(0.99).unwrap() - 7.163728138948783).abs() < 1e-8);
        assert!(covariance.interval(0, 1.0, 0.95).is_some());
        covariance.degrees_of_freedom = Some(0.0);
        assert_eq!(covariance.interval(0, 1.0, 0.95), None);
    }
}
