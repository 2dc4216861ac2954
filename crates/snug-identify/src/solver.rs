use crate::search::{Ask, Search};
use crate::{Constraints, Fit, IdentifyError, LeastSquares, Settings};

/// Minimises ½‖r(p)‖² over a convex set by damped Gauss–Newton steps (Levenberg–Marquardt) from one start.
///
/// A step that leaves the set is replaced by the exact minimiser of the same damped model over the set, a conic program;
/// a start outside is projected onto it. Every iterate lies in the set. The same input gives the same bits.
///
/// # Errors
/// [`IdentifyError`] for wrong dimensions, an empty set or impossible settings. What happens during the fit is told by
/// [`Fit::status`].
pub fn solve(
    problem: &mut dyn LeastSquares,
    start: &[f64],
    constraints: &Constraints,
    settings: &Settings,
) -> Result<Fit, IdentifyError> {
    let mut search = Search::new(problem.parameter_count(), start, constraints, settings)?;
    while !answer(&mut search, problem) {}
    Ok(search.finish(problem.residual_count()))
}

/// Answers what a search asks next; returns whether it has ended.
pub(crate) fn answer(search: &mut Search<'_>, problem: &mut dyn LeastSquares) -> bool {
    match search.ask() {
        Ask::Linearization { at, into } => {
            let outcome = problem.linearize(at, into);
            search.linearized(outcome);
        }
        Ask::Cost { at } => {
            let outcome = problem.cost(at);
            search.costed(outcome);
        }
        Ask::Bending { at, along, into } => {
            let outcome = problem.bending(at, along, into);
            search.bent(outcome);
        }
        Ask::Nothing => return true,
    }
    false
}
