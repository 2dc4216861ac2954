//! Newton's method on the optimality conditions of a conic program with a given active set.

use crate::conic::program::{Candidate, ConicProgram};
use crate::conic::thresholds::{NEWTON_LIMIT, TOLERANCE};
use crate::matrix::{add_scaled, dot, norm};
use faer::Mat;
use faer::linalg::solvers::Solve;

/// What is wrong with a candidate as a solution.
pub enum Defect {
    /// Nothing: it satisfies the optimality conditions, so it is the solution.
    None,
    /// This entry of the active list pulls instead of pressing.
    Pulling(usize),
    /// This inequality is violated.
    Violated(usize),
}

impl ConicProgram {
    /// Solves ∇f + Σ μ ∇g = 0, g = 0 from `candidate`; returns the Newton steps taken, or `None` when they do not
    /// converge (dependent inequalities, a cone's tip).
    pub fn polish(&self, candidate: &mut Candidate) -> Option<usize> {
        for entry in &mut candidate.active {
            entry.multiplier /= self
                .inequality(entry.inequality)
                .multiplier_ratio(&candidate.z);
        }
        let steps = self.newton(candidate);
        for entry in &mut candidate.active {
            entry.multiplier *= self
                .inequality(entry.inequality)
                .multiplier_ratio(&candidate.z);
        }
        steps
    }

    fn newton(&self, candidate: &mut Candidate) -> Option<usize> {
        for step in 1..=NEWTON_LIMIT {
            let change = self.newton_step(candidate)?;
            let size = 1.0 + norm(&candidate.z);
            if !change.is_finite() || size > 1e12 {
                return None;
            }
            // Convergence is quadratic: after a step this small, one more leaves nothing but rounding.
            if change <= 1e-7 * size {
                let last = self.newton_step(candidate)?;
                return (last <= 1e-7 * size).then_some(step + 1);
            }
        }
        None
    }

    /// One Newton step; returns ‖dz‖.
    fn newton_step(&self, candidate: &mut Candidate) -> Option<f64> {
        let (n, k) = (self.gradient.len(), candidate.active.len());
        let mut curvature = self.hessian.clone();
        let mut stationarity = self.slope(&candidate.z);
        let mut normals = vec![0.0; n * k];
        let mut values = vec![0.0; k];
        let rows = normals.chunks_exact_mut(n).zip(&mut values);
        for (entry, (normal, value)) in candidate.active.iter().zip(rows) {
            let inequality = self.inequality(entry.inequality);
            *value = inequality.equation(&candidate.z, normal);
            inequality.add_curvature(entry.multiplier, &mut curvature);
            add_scaled(&mut stationarity, entry.multiplier, normal);
        }
        // Unit normals keep the system balanced; the multipliers are scaled back below.
        let lengths: Vec<f64> = normals.chunks_exact(n).map(norm).collect();
        if lengths.contains(&0.0) {
            return None;
        }
        let unit =
            |inequality: usize, index: usize| normals[inequality * n + index] / lengths[inequality];
        let matrix = Mat::from_fn(n + k, n + k, |row, column| match (row < n, column < n) {
            (true, true) => curvature[column * n + row],
            (true, false) => unit(column - n, row),
            (false, true) => unit(row - n, column),
            (false, false) => 0.0,
        });
        let mut right = Mat::from_fn(n + k, 1, |row, _| match row < n {
            true => -stationarity[row],
            false => -values[row - n] / lengths[row - n],
        });
        matrix.partial_piv_lu().solve_in_place(right.as_mut());
        let mut square = 0.0;
        for row in 0..n {
            candidate.z[row] += right[(row, 0)];
            square += right[(row, 0)].powi(2);
        }
        for (index, entry) in candidate.active.iter_mut().enumerate() {
            entry.multiplier += right[(n + index, 0)] / lengths[index];
        }
        Some(square.sqrt())
    }

    /// Checks the optimality conditions of a polished candidate. The program is convex: what passes is its solution.
    pub fn defect(&self, candidate: &Candidate) -> Defect {
        let n = self.gradient.len();
        let mut normal = vec![0.0; n];
        let mut worst = (0.0, Defect::None);
        for (index, entry) in candidate.active.iter().enumerate() {
            self.inequality(entry.inequality)
                .gradient(&candidate.z, &mut normal);
            let pull = -entry.multiplier * norm(&normal);
            if pull > 1e-9_f64.max(worst.0) {
                worst = (pull, Defect::Pulling(index));
            }
        }
        if matches!(worst.1, Defect::Pulling(_)) {
            return worst.1;
        }
        let allowed = TOLERANCE * (1.0 + norm(&candidate.z));
        for (index, inequality) in self.inequalities.iter().enumerate() {
            let Some(inequality) = inequality else {
                continue;
            };
            let outside = inequality.distance(&candidate.z, &mut normal);
            if outside > allowed.max(worst.0) {
                worst = (outside, Defect::Violated(index));
            }
        }
        worst.1
    }

    /// Whether the stationarity condition holds at the candidate.
    pub fn is_stationary(&self, candidate: &Candidate) -> bool {
        let mut slope = self.slope(&candidate.z);
        let size = dot(&self.gradient, &self.gradient).sqrt() + norm(&slope);
        let mut normal = vec![0.0; slope.len()];
        for entry in &candidate.active {
            self.inequality(entry.inequality)
                .gradient(&candidate.z, &mut normal);
            add_scaled(&mut slope, entry.multiplier, &normal);
        }
        norm(&slope) <= 1e-9 * size
    }
}
