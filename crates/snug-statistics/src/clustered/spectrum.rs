//! Eigenvalues of a small symmetric matrix.

use faer::{Mat, Side};

/// Eigenvalues and eigenvectors of a small symmetric matrix.
pub(super) struct Spectrum {
    /// Eigenvalues in ascending order.
    pub values: Vec<f64>,
    /// Eigenvectors in the columns.
    pub vectors: Mat<f64>,
}

impl Spectrum {
    pub fn of(matrix: &Mat<f64>) -> Self {
        let eigen = matrix
            .self_adjoint_eigen(Side::Lower)
            .expect("the symmetric eigenproblem of finite entries converges");
        let values = eigen.S().column_vector().iter().copied().collect();
        Self {
            values,
            vectors: eigen.U().to_owned(),
        }
    }

    /// `U f(S) U'`.
    pub fn map(&self, function: impl Fn(f64) -> f64) -> Mat<f64> {
        let scaled = Mat::from_fn(self.values.len(), self.values.len(), |row, column| {
            self.vectors[(row, column)] * function(self.values[column])
        });
        scaled * self.vectors.transpose()
    }
}

/// Adds `weight · vector vector'` to a matrix.
pub(super) fn add_outer(matrix: &mut Mat<f64>, weight: f64, vector: &[f64]) {
    for (column, right) in vector.iter().enumerate() {
        for (row, left) in vector.iter().enumerate() {
            matrix[(row, column)] += weight * left * right;
        }
    }
}
