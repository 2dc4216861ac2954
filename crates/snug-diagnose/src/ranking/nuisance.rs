//! What a tightening's own parameters can imitate of an effect, taken out before the effect is scored.

use crate::ranking::thresholds::ROUNDING;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::close;

    /// Two columns of three samples in the plane of the first two; a signal keeps what stands on it.
    #[test]
    fn what_own_parameters_can_imitate_is_taken_out() {
        let nuisance = Nuisance::new(&[1.0, 0.0, 0.0, 1.0, 1.0, 0.0], 3, 2);
        let mut signal = [5.0, -7.0, 2.0];
        nuisance.project(&mut signal);
        assert_eq!(signal, [0.0, 0.0, 2.0]);
    }

    #[test]
    fn only_the_first_columns_are_the_tightening_s_own() {
        let nuisance = Nuisance::new(&[1.0, 0.0, 0.0, 1.0, 1.0, 0.0], 3, 1);
        let mut signal = [5.0, -7.0, 2.0];
        nuisance.project(&mut signal);
        assert_eq!(signal, [0.0, -7.0, 2.0]);
    }

    /// A parameter that does nothing, and one that does what another does, take nothing more out.
    #[test]
    fn a_column_that_says_nothing_new_takes_nothing_more_out() {
        let once = Nuisance::new(&[3.0, 4.0, 0.0], 3, 1);
        let again = Nuisance::new(&[3.0, 4.0, 0.0, 0.0, 0.0, 0.0, -6.0, -8.0, 0.0], 3, 3);
        assert_eq!(again.basis.len(), 1);
        let (mut one, mut other) = ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]);
        once.project(&mut one);
        again.project(&mut other);
        assert_eq!(one, other);
    }

    /// Columns that are alike to one part in 10⁷, as stiffness and damping may be, and of any size.
    #[test]
    fn nearly_equal_columns_are_still_told_apart() {
        let jacobian = [1e6, 1e6, 1e6, 1e6, 1e6, 1e6 + 0.1];
        let nuisance = Nuisance::new(&jacobian, 3, 2);
        assert_eq!(nuisance.basis.len(), 2);
        for column in jacobian.chunks_exact(3) {
            let mut rest = column.to_vec();
            nuisance.project(&mut rest);
            assert!(dot(&rest, &rest).sqrt() < 1e-8 * 1e6, "{rest:?}");
        }
    }

    /// (3, 0, 4), (0, 5, 0) and their sum: lengths 25, 25 and 50, products 0, 25 and 25.
    #[test]
    fn coordinates_have_the_products_of_the_signals() {
        let signals = [
            vec![3.0, 0.0, 4.0],
            vec![0.0, 5.0, 0.0],
            vec![3.0, 5.0, 4.0],
        ];
        let found = coordinates(&signals);
        let product = |i: usize, j: usize| dot(&found[i][..=i.min(j)], &found[j][..=i.min(j)]);
        for (i, j, expected) in [
            (0, 0, 25.0),
            (1, 1, 25.0),
            (2, 2, 50.0),
            (2, 0, 25.0),
            (2, 1, 25.0),
        ] {
            close(product(i, j), expected, 1e-12);
        }
        assert_eq!(product(1, 0), 0.0);
    }
}
