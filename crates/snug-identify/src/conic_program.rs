//! The conic program of a step that meets the constraints, and points of it.

use crate::dense::add_scaled;
use crate::faces::Face;

/// Minimise ½ zᵀ P z + qᵀ z over the faces; the parameters are p + unit ∘ z.
pub(crate) struct ConicProgram {
    /// n × n, column-major, both triangles.
    pub hessian: Vec<f64>,
    pub gradient: Vec<f64>,
    /// One entry per face of the constraints; `None` where a bound is infinite.
    pub faces: Vec<Option<Face>>,
}

impl ConicProgram {
    /// A face that a point can lie on.
    pub fn face(&self, index: usize) -> &Face {
        self.faces[index]
            .as_ref()
            .expect("only finite faces become active")
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

/// A face that holds with equality, and how hard it presses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Active {
    pub face: usize,
    /// Lagrange multiplier of g ≤ 0.
    pub multiplier: f64,
}

/// A point of the program with its active faces.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub z: Vec<f64>,
    pub active: Vec<Active>,
}
