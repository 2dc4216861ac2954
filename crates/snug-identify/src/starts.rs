use crate::fit::{Fit, Status, Work};
use crate::{Constraints, IdentifyError, LeastSquares, Settings, solve};

/// Fits from every start and keeps the best: the lowest cost among those that ended at an optimum, else among all.
///
/// The first of equals wins, so the order of the starts is the order of preference. The result's
/// [`Work`](crate::Work) is that of all starts together.
///
/// # Errors
/// As [`solve`], and [`IdentifyError::NoStart`] without a start.
pub fn solve_from_starts<S: AsRef<[f64]>>(
    problem: &mut dyn LeastSquares,
    starts: &[S],
    constraints: &Constraints,
    settings: &Settings,
) -> Result<Fit, IdentifyError> {
    let mut best: Option<Fit> = None;
    let mut work = Work::default();
    for start in starts {
        let fit = solve(problem, start.as_ref(), constraints, settings)?;
        work.add(&fit.work);
        best = match best {
            Some(found) if !is_better(&fit, &found) => Some(found),
            _ => Some(fit),
        };
    }
    let mut best = best.ok_or(IdentifyError::NoStart)?;
    best.work = work;
    Ok(best)
}

/// Whether `fit` is more useful than `other`; costs that agree to 1e-9 count as equal.
fn is_better(fit: &Fit, other: &Fit) -> bool {
    let class = |fit: &Fit| match fit.status {
        Status::Converged | Status::ConvergedAtConstraint => 0,
        Status::IterationLimit | Status::Stalled => 1,
        Status::NotIdentifiable => 2,
        Status::Failed => 3,
    };
    match class(fit).cmp(&class(other)) {
        std::cmp::Ordering::Equal => fit.cost < other.cost * (1.0 - 1e-9),
        order => order.is_lt(),
    }
}
