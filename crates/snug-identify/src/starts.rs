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
pub(crate) fn best(ends: Vec<Fit>, work: Work) -> Result<Fit, IdentifyError> {
    let better = |found: Fit, fit: Fit| match is_better(&fit, &found) {
        true => fit,
        false => found,
    };
    let best = ends.into_iter().reduce(better);
    best.map(|fit| Fit { work, ..fit })
        .ok_or(IdentifyError::NoStart)
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
