//! What a tightening's own parameters can imitate of an effect, taken out before the effect is scored.

use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};

/// Coordinates of each signal in an orthonormal basis of all of them: their inner products are all that it takes.
pub(crate) fn coordinates(signals: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut products = SymmetricMatrix::zero(signals.len());
    for (i, one) in signals.iter().enumerate() {
        for (j, other) in signals[..=i].iter().enumerate() {
            let product = dot(one, other);
            products.set(i, j, product);
            products.set(j, i, product);
        }
    }
    products.root()
}

/// Squared share of a signal below which what is new in it is rounding.
const ROUNDING: f64 = 1e-20;

/// Orthonormal basis of what the own parameters can imitate.
pub(crate) struct Nuisance {
    basis: Vec<Vec<f64>>,
}

impl Nuisance {
    /// Gram–Schmidt, twice, of the first `columns` columns.
    pub fn new(jacobian: &[f64], count: usize, columns: usize) -> Self {
        let mut nuisance = Self { basis: Vec::new() };
        for column in jacobian.chunks_exact(count.max(1)).take(columns) {
            nuisance.extend(column);
        }
        nuisance
    }

    /// Adds what is new in a signal.
    fn extend(&mut self, signal: &[f64]) {
        let mut rest = signal.to_vec();
        let before = dot(&rest, &rest);
        self.project(&mut rest);
        self.project(&mut rest);
        let length = dot(&rest, &rest);
        if length > ROUNDING * before && length > 0.0 && length.is_finite() {
            let scale = 1.0 / length.sqrt();
            rest.iter_mut().for_each(|value| *value *= scale);
            self.basis.push(rest);
        }
    }

    /// Takes out of a signal what the basis can imitate.
    pub fn project(&self, signal: &mut [f64]) {
        for direction in &self.basis {
            let along = dot(direction, signal);
            for (value, d) in signal.iter_mut().zip(direction) {
                *value -= along * d;
            }
        }
    }
}
