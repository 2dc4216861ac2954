//! A conic program's solution, nearly: Clarabel's interior-point method on the inequalities that matter.

use crate::conic::inequalities::Inequality;
use crate::conic::program::{Active, Candidate, ConicProgram};
use crate::matrix::norm;
use crate::solver::fit::Work;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
};

impl ConicProgram {
    /// Clarabel on the inequalities that matter: those the free step violates, then any its solution violates.
    pub fn interior_point(
        &self,
        free: &[f64],
        expected: &[usize],
        work: &mut Work,
    ) -> Option<Candidate> {
        let mut scratch = vec![0.0; free.len()];
        let outside =
            |inequality: &Option<Inequality>, z: &[f64], allowed: f64, scratch: &mut [f64]| {
                inequality
                    .as_ref()
                    .is_some_and(|inequality| inequality.distance(z, scratch) > allowed)
            };
        let mut chosen: Vec<usize> = (0..self.inequalities.len())
            .filter(|index| {
                expected.contains(index)
                    || outside(&self.inequalities[*index], free, 0.0, &mut scratch)
            })
            .collect();
        loop {
            let candidate = self.clarabel(&chosen, work)?;
            let allowed = 1e-7 * (1.0 + norm(&candidate.z));
            let before = chosen.len();
            for (index, inequality) in self.inequalities.iter().enumerate() {
                if !chosen.contains(&index)
                    && outside(inequality, &candidate.z, allowed, &mut scratch)
                {
                    chosen.push(index);
                }
            }
            if chosen.len() == before {
                return Some(candidate);
            }
        }
    }

    /// One conic program over the chosen inequalities, with the inequalities that press harder than they are away as active set.
    fn clarabel(&self, chosen: &[usize], work: &mut Work) -> Option<Candidate> {
        let n = self.gradient.len();
        let (rows, limits, cones) = self.standard_form(chosen);
        let hessian = upper_triangle(&self.hessian, n);
        let matrix = columns(&rows, n);
        for settings in [fast_settings(), careful_settings()] {
            work.conic_solves += 1;
            let program =
                DefaultSolver::new(&hessian, &self.gradient, &matrix, &limits, &cones, settings);
            let Ok(mut solver) = program else { continue };
            solver.solve();
            let solution = &solver.solution;
            let usable = match solution.status {
                SolverStatus::Solved => true,
                SolverStatus::AlmostSolved => solution.x.iter().all(|x| x.is_finite()),
                _ => false,
            };
            if usable {
                return Some(self.with_active_set(chosen, solution.x.clone(), &solution.z));
            }
            tracing::debug!(status = ?solution.status, "conic program repeated with careful settings");
        }
        None
    }

    fn with_active_set(&self, chosen: &[usize], z: Vec<f64>, duals: &[f64]) -> Candidate {
        let mut scratch = vec![0.0; z.len()];
        let mut active = Vec::new();
        let mut row = 0;
        for &index in chosen {
            let Some(inequality) = &self.inequalities[index] else {
                continue;
            };
            // The first dual of a second-order cone is the multiplier of ‖x‖ − t ≤ 0.
            let multiplier = duals[row];
            row += inequality.row_count();
            let away = -inequality.distance(&z, &mut scratch);
            if multiplier * norm(&scratch) > away {
                active.push(Active {
                    inequality: index,
                    multiplier,
                });
            }
        }
        Candidate { z, active }
    }

    /// b − A z in the cones: rows of A, b, and the cones in the order of `chosen`.
    fn standard_form(
        &self,
        chosen: &[usize],
    ) -> (Vec<Vec<f64>>, Vec<f64>, Vec<SupportedConeT<f64>>) {
        let (mut rows, mut limits, mut cones) = (Vec::new(), Vec::new(), Vec::new());
        for inequality in chosen
            .iter()
            .filter_map(|&index| self.inequalities[index].as_ref())
        {
            match inequality {
                Inequality::Plane { normal, limit } => {
                    rows.push(normal.clone());
                    limits.push(*limit);
                    cones.push(SupportedConeT::NonnegativeConeT(1));
                }
                Inequality::Cone(cone) => {
                    for (constant, slope) in cone.constants.iter().zip(&cone.slopes) {
                        rows.push(slope.iter().map(|value| -value).collect());
                        limits.push(*constant);
                    }
                    cones.push(SupportedConeT::SecondOrderConeT(3));
                }
            }
        }
        (rows, limits, cones)
    }
}

impl Inequality {
    fn row_count(&self) -> usize {
        match self {
            Inequality::Plane { .. } => 1,
            Inequality::Cone(_) => 3,
        }
    }
}

/// Relative accuracy 1e-10: tighter settings end in `AlmostSolved`; the polish does the rest.
fn careful_settings() -> DefaultSettings<f64> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .presolve_enable(false)
        .tol_gap_abs(1e-10)
        .tol_gap_rel(1e-10)
        .tol_feas(1e-10)
        .build()
        .expect("these settings are valid")
}

/// The same without equilibration and refinement, which a balanced program of this size does not need.
fn fast_settings() -> DefaultSettings<f64> {
    let mut settings = careful_settings();
    settings.equilibrate_enable = false;
    settings.iterative_refinement_enable = false;
    settings
}

fn upper_triangle(matrix: &[f64], n: usize) -> CscMatrix<f64> {
    let starts = (0..=n).map(|column| column * (column + 1) / 2).collect();
    let rows = (0..n).flat_map(|column| 0..=column).collect();
    let values = (0..n)
        .flat_map(|column| matrix[column * n..=column * n + column].iter().copied())
        .collect();
    CscMatrix::new(n, n, starts, rows, values)
}

fn columns(rows: &[Vec<f64>], n: usize) -> CscMatrix<f64> {
    let m = rows.len();
    let values = (0..n).flat_map(|column| rows.iter().map(move |row| row[column]));
    CscMatrix::new(
        m,
        n,
        (0..=n).map(|column| column * m).collect(),
        (0..n).flat_map(|_| 0..m).collect(),
        values.collect(),
    )
}
