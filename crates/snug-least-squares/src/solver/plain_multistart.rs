//! Plain multistart: every start is followed to its end, one after the other, and the best end counts.
//!
//! Who follows many starts side by side and stops those without a prospect runs each as a
//! [`LevenbergMarquardt`](crate::LevenbergMarquardt) and lets [`best`] say which end counts.

use crate::conic::constraints::Constraints;
use crate::error::SolveError;
use crate::problem::least_squares::LeastSquares;
use crate::solver::fit::{Fit, Status, Work};
use crate::solver::settings::Settings;
use crate::solver::solve::solve;
use crate::solver::thresholds::CLEARLY_LOWER;
use std::cmp::Ordering;

/// Fits from every start and keeps the best: the lowest cost among those that ended at an optimum, unless one that did not
/// lies lower by more than a hundredth.
///
/// The first of equals wins, so the order of the starts is the order of preference. The result's
/// [`Work`](crate::Work) is that of all starts together.
///
/// # Errors
/// As [`solve`], and [`SolveError::NoStart`] without a start.
pub fn solve_from_starts<S: AsRef<[f64]>>(
    problem: &mut dyn LeastSquares,
    starts: &[S],
    constraints: &Constraints,
    settings: &Settings,
) -> Result<Fit, SolveError> {
    let mut ends = Vec::new();
    let mut work = Work::default();
    for start in starts {
        let fit = solve(problem, start.as_ref(), constraints, settings)?;
        work.add(&fit.work);
        ends.push(fit);
    }
    best(ends, work)
}

/// The best of `ends`, with the `work` of all.
pub fn best(ends: Vec<Fit>, work: Work) -> Result<Fit, SolveError> {
    let better = |found: Fit, fit: Fit| match is_better(&fit, &found) {
        true => fit,
        false => found,
    };
    let best = ends.into_iter().reduce(better);
    best.map(|fit| Fit { work, ..fit })
        .ok_or(SolveError::NoStart)
}

/// Whether `fit` is more useful than `other`; costs that agree to 1e-9 count as equal.
fn is_better(fit: &Fit, other: &Fit) -> bool {
    let class = |fit: &Fit| match fit.status {
        Status::Converged | Status::ConvergedAtConstraint => 0,
        Status::IterationLimit | Status::Stalled => 1,
        Status::NotIdentifiable => 2,
        Status::Failed => 3,
    };
    let lower_by = match class(fit).cmp(&class(other)) {
        Ordering::Equal => 1e-9,
        Ordering::Less => -CLEARLY_LOWER,
        Ordering::Greater => CLEARLY_LOWER,
    };
    match (fit.cost.is_finite(), other.cost.is_finite()) {
        (true, true) => fit.cost < other.cost * (1.0 - lower_by),
        (is_finite, _) => is_finite,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::difference_residual::DifferenceResidual;
    use crate::problem::residual::DenseResidual;

    /// ½ (p² + 1), ended as told.
    fn ended(cost: f64, status: Status) -> Fit {
        let residual = DifferenceResidual::new(2, &[1.0], |p, r| {
            (r[0], r[1]) = (p[0], 1.0);
            Ok(())
        });
        let mut problem = DenseResidual::new(residual);
        let fit = solve(
            &mut problem,
            &[1.0],
            &Constraints::new(1),
            &Settings::default(),
        );
        let fit = fit.expect("one free parameter");
        Fit {
            cost,
            status,
            ..fit
        }
    }

    #[test]
    fn an_optimum_is_preferred_to_what_is_hardly_lower_and_not_to_what_is_lower_by_far() {
        let optimum = || ended(1.0, Status::ConvergedAtConstraint);
        let chosen = |other: Fit| {
            let forward = best(vec![optimum(), other.clone()], Work::default());
            let backward = best(vec![other, optimum()], Work::default());
            assert_eq!(forward, backward);
            forward.expect("two ends").cost
        };
        assert_eq!(chosen(ended(0.995, Status::Stalled)), 1.0);
        assert_eq!(chosen(ended(0.05, Status::Stalled)), 0.05);
        assert_eq!(chosen(ended(0.05, Status::IterationLimit)), 0.05);
        assert_eq!(chosen(ended(f64::NAN, Status::Failed)), 1.0);
        assert_eq!(chosen(ended(0.9999, Status::Converged)), 0.9999);
    }
}
