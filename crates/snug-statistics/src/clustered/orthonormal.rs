//! An orthonormal basis of a design's columns, so that what they share counts once.

use super::Design;
use crate::{Result, StatisticsError};

/// A column counts as dependent when this little of its length is left after projection.
const DEPENDENT: f64 = 1e-10;
/// Share of the response's sum of squares up to which what a design leaves of it is rounding \[–\]. Chosen.
const ROUNDING: f64 = 1e-24;

/// Orthonormal basis of a design's columns: `X = Q R`, and the response in it.
///
/// Everything downstream works with Q, whose cross products are as well conditioned as can be,
/// and translates contrasts by `l'β = (R⁻ᵀ l)'γ`.
pub(super) struct Orthonormal {
    /// Columns of Q.
    pub q: Vec<Vec<f64>>,
    /// Columns of the upper triangular R.
    r: Vec<Vec<f64>>,
    /// `Q'y`.
    pub coordinates: Vec<f64>,
    /// `y − Q Q'y`.
    pub residual: Vec<f64>,
}

impl Orthonormal {
    /// Gram–Schmidt, twice per column, which is enough (Giraud, Langou and Rozložník 2005).
    ///
    /// # Errors
    /// [`StatisticsError::RankDeficient`] naming the first dependent column.
    pub fn of(design: &Design, response: &[f64]) -> Result<Self> {
        let mut q: Vec<Vec<f64>> = Vec::new();
        let mut r = Vec::new();
        for (column, name) in design.columns().iter().zip(design.names()) {
            let mut rest = column.clone();
            let mut entries = project_out(&q, &mut rest);
            let length = norm(&rest);
            if length <= DEPENDENT * norm(column) {
                return Err(StatisticsError::RankDeficient {
                    column: name.clone(),
                });
            }
            rest.iter_mut().for_each(|value| *value /= length);
            entries.push(length);
            q.push(rest);
            r.push(entries);
        }
        let mut residual = response.to_vec();
        let coordinates = project_out(&q, &mut residual);
        Ok(Self {
            q,
            r,
            coordinates,
            residual,
        })
    }

    /// `R⁻ᵀ l` by forward substitution.
    pub fn contrast(&self, weights: &[f64]) -> Vec<f64> {
        let mut solved: Vec<f64> = Vec::with_capacity(self.r.len());
        for (column, weight) in self.r.iter().zip(weights) {
            let known: f64 = column
                .iter()
                .zip(&solved)
                .map(|(entry, value)| entry * value)
                .sum();
            solved.push((weight - known) / column[solved.len()]);
        }
        solved
    }

    /// Whether the design explains the response up to rounding.
    pub fn leaves_nothing(&self) -> bool {
        let left = dot(&self.residual, &self.residual);
        left <= ROUNDING * (left + dot(&self.coordinates, &self.coordinates))
    }

    /// `ln |R|`.
    pub fn ln_determinant(&self) -> f64 {
        self.r
            .iter()
            .filter_map(|column| column.last())
            .map(|entry| entry.ln())
            .sum()
    }
}

/// Removes the basis from a vector and returns what was removed.
fn project_out(basis: &[Vec<f64>], vector: &mut [f64]) -> Vec<f64> {
    let mut removed = vec![0.0; basis.len()];
    for _ in 0..2 {
        for (axis, removed) in basis.iter().zip(&mut removed) {
            let part = dot(axis, vector);
            vector
                .iter_mut()
                .zip(axis)
                .for_each(|(value, axis)| *value -= part * axis);
            *removed += part;
        }
    }
    removed
}

/// Inner product.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(vector: &[f64]) -> f64 {
    dot(vector, vector).sqrt()
}
