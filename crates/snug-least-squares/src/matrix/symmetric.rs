//! Small symmetric matrices.

use super::triangular::inner_product as dot;
use crate::matrix::thresholds::ROUNDING;

/// A small symmetric matrix, n × n.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricMatrix {
    size: usize,
    entries: Vec<f64>,
}

impl SymmetricMatrix {
    /// From n² entries, row after row.
    pub fn new(size: usize, entries: Vec<f64>) -> Self {
        debug_assert_eq!(entries.len(), size * size);
        Self { size, entries }
    }

    /// All entries zero.
    pub fn zero(size: usize) -> Self {
        Self::new(size, vec![0.0; size * size])
    }

    /// n.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Entry in row i and column j.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.size + j]
    }

    /// Sets the entry in row i and column j, and that alone.
    pub fn set(&mut self, i: usize, j: usize, value: f64) {
        self.entries[i * self.size + j] = value;
    }

    /// Adds a matrix of the same size.
    pub fn add(&mut self, other: &Self) {
        for (entry, more) in self.entries.iter_mut().zip(&other.entries) {
            *entry += more;
        }
    }

    /// Subtracts a matrix of the same size.
    pub fn subtract(&mut self, other: &Self) {
        for (entry, less) in self.entries.iter_mut().zip(&other.entries) {
            *entry -= less;
        }
    }

    /// Adds `other` to the block whose first row and column is `first`.
    pub fn add_at(&mut self, first: usize, other: &Self) {
        for i in 0..other.size {
            for j in 0..other.size {
                self.entries[(first + i) * self.size + first + j] += other.at(i, j);
            }
        }
    }

    /// xᵀ A x.
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        (0..self.size)
            .map(|i| x[i] * dot(&self.entries[i * self.size..][..self.size], x))
            .sum()
    }

    /// Solves A x = b by Cholesky after scaling the diagonal to 1; directions about which A knows nothing stay 0.
    pub fn solve_scaled(&self, b: &[f64]) -> Option<Vec<f64>> {
        let n = self.size;
        let unit = self.units();
        let lower = self.scaled_cholesky(&unit);
        let mut x: Vec<f64> = b.iter().zip(&unit).map(|(b, u)| b * u).collect();
        for i in 0..n {
            let known: f64 = (0..i).map(|k| lower[i * n + k] * x[k]).sum();
            x[i] = match lower[i * n + i] {
                0.0 => 0.0,
                pivot => (x[i] - known) / pivot,
            };
        }
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|k| lower[k * n + i] * x[k]).sum();
            x[i] = match lower[i * n + i] {
                0.0 => 0.0,
                pivot => (x[i] - known) / pivot,
            };
        }
        for (x, u) in x.iter_mut().zip(&unit) {
            *x *= u;
        }
        x.iter().all(|x| x.is_finite()).then_some(x)
    }

    /// 1/√diagonal, 0 where the diagonal is not positive.
    fn units(&self) -> Vec<f64> {
        let diagonal = (0..self.size).map(|i| self.at(i, i));
        diagonal
            .map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 })
            .collect()
    }

    /// Lower Cholesky factor of the matrix scaled to a diagonal of 1; directions that are rounding have zero pivots.
    fn scaled_cholesky(&self, unit: &[f64]) -> Vec<f64> {
        let n = self.size;
        let mut lower = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let known = dot(&lower[i * n..i * n + j], &lower[j * n..j * n + j]);
                let left = self.at(i, j) * unit[i] * unit[j] - known;
                lower[i * n + j] = if i == j {
                    if left > ROUNDING { left.sqrt() } else { 0.0 }
                } else if lower[j * n + j] > 0.0 {
                    left / lower[j * n + j]
                } else {
                    0.0
                };
            }
        }
        lower
    }

    /// Vectors, one for each row, whose inner products are A: the rows of its lower Cholesky factor.
    pub fn root(&self) -> Vec<Vec<f64>> {
        let n = self.size;
        let unit = self.units();
        let lower = self.scaled_cholesky(&unit);
        let length = |row: usize| {
            if unit[row] > 0.0 {
                1.0 / unit[row]
            } else {
                0.0
            }
        };
        (0..n)
            .map(|i| {
                let row = &lower[i * n..=i * n + i];
                row.iter().map(|entry| entry * length(i)).collect()
            })
            .collect()
    }

    /// The inverse, column by column.
    pub fn inverse(&self) -> Option<Self> {
        let mut inverse = Self::zero(self.size);
        for column in 0..self.size {
            let mut unit = vec![0.0; self.size];
            unit[column] = 1.0;
            for (row, value) in self.solve_scaled(&unit)?.into_iter().enumerate() {
                inverse.set(row, column, value);
            }
        }
        Some(inverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_leaves_unknown_directions_alone() {
        let known = SymmetricMatrix::new(2, vec![4.0, 1.0, 1.0, 3.0]);
        let x = known.solve_scaled(&[1.0, 2.0]).expect("finite");
        assert!((x[0] - 1.0 / 11.0).abs() < 1e-14 && (x[1] - 7.0 / 11.0).abs() < 1e-14);
        assert!((known.quadratic(&x) - (x[0] + 2.0 * x[1])).abs() < 1e-14);
        let half = SymmetricMatrix::new(2, vec![4.0, 0.0, 0.0, 0.0]);
        assert_eq!(half.solve_scaled(&[2.0, 5.0]), Some(vec![0.5, 0.0]));
        let inverse = known.inverse().expect("finite");
        assert!((inverse.at(0, 0) - 3.0 / 11.0).abs() < 1e-14);
    }

    /// Three vectors of which the third is the sum of the others, by their inner products alone.
    #[test]
    fn rows_of_the_root_have_the_inner_products_of_the_matrix() {
        let products = [9.0, 3.0, 12.0, 3.0, 5.0, 8.0, 12.0, 8.0, 20.0];
        let rows = SymmetricMatrix::new(3, products.to_vec()).root();
        for (i, one) in rows.iter().enumerate() {
            for (j, other) in rows.iter().enumerate() {
                let shared = i.min(j) + 1;
                let product = dot(&one[..shared], &other[..shared]);
                assert!((product - products[3 * i + j]).abs() < 1e-13, "{i} {j}");
            }
        }
        assert_eq!(rows[2][2], 0.0, "nothing is new in the sum");
    }
}
