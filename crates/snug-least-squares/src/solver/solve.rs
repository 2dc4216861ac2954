//! One fit, its problem evaluated where the algorithm asks.

use crate::conic::constraints::Constraints;
use crate::error::SolveError;
use crate::problem::least_squares::LeastSquares;
use crate::solver::fit::Fit;
use crate::solver::levenberg_marquardt::{LevenbergMarquardt, Query};
use crate::solver::settings::Settings;

/// Minimises ½‖r(p)‖² over a convex set by damped Gauss–Newton steps (Levenberg–Marquardt) from one start.
///
/// A step that leaves the set is replaced by the exact minimiser of the same damped model over the set, a conic program;
/// a start outside is projected onto it. Every iterate lies in the set. The same input gives the same bits.
///
/// # Errors
/// [`SolveError`] for wrong dimensions, an empty set or impossible settings. What happens during the fit is told by
/// [`Fit::status`].
pub fn solve(
    problem: &mut dyn LeastSquares,
    start: &[f64],
    constraints: &Constraints,
    settings: &Settings,
) -> Result<Fit, SolveError> {
    let mut search =
        LevenbergMarquardt::new(problem.parameter_count(), start, constraints, settings)?;
    while !answer(&mut search, problem) {}
    Ok(search.finish(problem.residual_count()))
}

/// Answers what a search asks next; returns whether it has ended.
pub fn answer(search: &mut LevenbergMarquardt<'_>, problem: &mut dyn LeastSquares) -> bool {
    match search.query() {
        Query::Linearization { at, into } => {
            let outcome = problem.linearize(at, into);
            search.linearized(outcome);
        }
        Query::Cost { at } => {
            let outcome = problem.cost(at);
            search.costed(outcome);
        }
        Query::SecondDerivative { at, along, into } => {
            let outcome = problem.second_derivative(at, along, into);
            search.second_derivative_known(outcome);
        }
        Query::Nothing => return true,
    }
    false
}
