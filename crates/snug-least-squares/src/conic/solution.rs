//! A conic program's solution, exactly: an interior point made exact on its active set.

use crate::conic::active_set::Defect;
use crate::conic::inequalities::Inequality;
use crate::conic::program::{Active, Candidate, ConicProgram};
use crate::matrix::norm;
use crate::solver::fit::Work;

impl ConicProgram {
    /// The program's solution. `free` is the minimiser without constraints, `expected` the inequalities active last time.
    ///
    /// A point that satisfies the optimality conditions on the expected inequalities is the solution of a convex program, so
    /// Clarabel is asked only when it does not. `None` when no point better than z = 0 was found.
    pub fn solve(&self, free: &[f64], expected: &[usize], work: &mut Work) -> Option<Candidate> {
        if !expected.is_empty() {
            let start = self.at_rest(expected);
            if let Some(found) = self.exact(start, 0, work) {
                return Some(found);
            }
        }
        let interior = self.interior_point(free, expected, work)?;
        // A cone touched along an edge of bounds depends on them: without it the same point is found.
        let mut edges = interior.clone();
        (edges.active).retain(|entry| {
            matches!(
                self.inequalities[entry.inequality],
                Some(Inequality::Plane { .. })
            )
        });
        for start in [&interior, &edges] {
            if let Some(found) = self.exact(start.clone(), 2 * self.inequalities.len(), work) {
                return Some(found);
            }
        }
        tracing::debug!("conic step kept at interior-point accuracy");
        self.pulled_inside(interior)
    }

    fn at_rest(&self, inequalities: &[usize]) -> Candidate {
        Candidate {
            z: vec![0.0; self.gradient.len()],
            active: inequalities
                .iter()
                .map(|&inequality| Active {
                    inequality,
                    multiplier: 0.0,
                })
                .collect(),
        }
    }

    /// Polishes the candidate and mends its active set, at most `repairs` times.
    fn exact(&self, start: Candidate, repairs: usize, work: &mut Work) -> Option<Candidate> {
        let mut guess = start;
        for _ in 0..=repairs {
            let mut candidate = guess.clone();
            let Some(steps) = self.polish(&mut candidate) else {
                let implied = self.implied(&guess)?;
                guess.active.remove(implied);
                continue;
            };
            work.polish_steps += steps;
            match self.defect(&candidate) {
                Defect::None => return self.is_stationary(&candidate).then_some(candidate),
                Defect::Pulling(index) => {
                    guess.active.remove(index);
                }
                Defect::Violated(inequality)
                    if guess
                        .active
                        .iter()
                        .all(|entry| entry.inequality != inequality) =>
                {
                    let multiplier = 0.0;
                    guess.active.push(Active {
                        inequality,
                        multiplier,
                    });
                }
                Defect::Violated(_) => return None,
            }
        }
        None
    }

    /// Of dependent inequalities, the one to leave out: a cone, else the one that presses least.
    fn implied(&self, guess: &Candidate) -> Option<usize> {
        let is_cone = |entry: &Active| {
            matches!(
                self.inequalities[entry.inequality],
                Some(Inequality::Cone(_))
            )
        };
        guess.active.iter().position(is_cone).or_else(|| {
            let entries = guess.active.iter().enumerate();
            let weakest = entries.min_by(|a, b| a.1.multiplier.total_cmp(&b.1.multiplier));
            weakest.map(|(index, _)| index)
        })
    }

    /// The last point on the way from z = 0 to the candidate that no inequality forbids. An interior point misses by little,
    /// so the first cuts are small.
    fn pulled_inside(&self, candidate: Candidate) -> Option<Candidate> {
        let mut scratch = vec![0.0; candidate.z.len()];
        let cuts = (0..15).map(|cut| 1e-8 * 4.0_f64.powi(cut));
        for cut in cuts.chain([1.0]) {
            let z: Vec<f64> = candidate
                .z
                .iter()
                .map(|value| (1.0 - cut) * value)
                .collect();
            let allowed = 1e-12 * (1.0 + norm(&z));
            if (self.inequalities.iter().flatten())
                .all(|inequality| inequality.distance(&z, &mut scratch) <= allowed)
            {
                let active = candidate.active;
                return Some(Candidate { z, active });
            }
        }
        None
    }
}

#[cfg(test)]
mod tests;
