//! The conic program of a step that meets the constraints, and points of it.

use crate::conic::inequalities::Inequality;
use crate::matrix::add_scaled;

/// Minimise ½ zᵀ P z + qᵀ z over the inequalities; the parameters are p + unit ∘ z.
pub struct ConicProgram {
    /// n × n, column-major, both triangles.
    pub hessian: Vec<f64>,
    pub gradient: Vec<f64>,
    /// One entry per inequality of the constraints; `None` where a bound is infinite.
    pub inequalities: Vec<Option<Inequality>>,
}

impl ConicProgram {
    /// An inequality that a point can lie on.
    pub fn inequality(&self, index: usize) -> &Inequality {
        self.inequalities[index]
            .as_ref()
            .expect("only finite inequalities become active")
    }

    /// P z + q.
    pub fn slope(&self, z: &[f64]) -> Vec<f64> {
        let mut slope = self.gradient.clone();
        for (column, &value) in self.hessian.chunks_exact(z.len()).zip(z) {
            add_scaled(&mut slope, value, column);
        }
        slope
    }
}

/// An inequality that holds with equality, and how hard it presses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Active {
    pub inequality: usize,
    /// Lagrange multiplier of g ≤ 0.
    pub multiplier: f64,
}

/// A point of the program with its active inequalities.
#[derive(Debug, Clone)]
pub struct Candidate {
    pub z: Vec<f64>,
    pub active: Vec<Active>,
}
