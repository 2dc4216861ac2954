//! Fits of one tightening from several starts, of which those without a prospect are stopped early.
//!
//! Most starts lead to the same few minima, and one that is behind after some steps mostly crawls along a valley whose
//! bottom another has found already: it need not be followed to the end.

use crate::batch::{BatchSimulator, SimulationRequest};
use crate::multistart::thresholds::{
    ALIKE, COST_RATIO_LIMIT, OVERACHIEVEMENT, RESOLUTION, WARM_UP_STEPS, WARM_UP_STEPS_LED,
};
use crate::residual::tightening::TighteningResidual;
use snug_least_squares::{
    Constraints, DenseResidual, Fit, LevenbergMarquardt, Query, Residual, Settings, SolveError,
    Work, answer, further_along,
};

/// How long every start is followed, and which are stopped then.
#[derive(Clone, Copy)]
pub(crate) struct EarlyStopping {
    /// Steps that every start makes, unless it has no prospect before.
    pub warm_up_steps: usize,
    /// How far above the lowest end a search may lie to be followed further: a multiple of that end's cost.
    pub cost_ratio_limit: f64,
}

/// Of starts along the measured motion.
pub(crate) const STOP_LED: EarlyStopping = EarlyStopping {
    warm_up_steps: WARM_UP_STEPS_LED,
    cost_ratio_limit: COST_RATIO_LIMIT,
};
/// Of starts on the decimated record or with the smoothed residual: the same minimum may be lower by as much with every sample
/// and without smoothing.
pub(crate) const STOP_SMOOTHED: EarlyStopping = EarlyStopping {
    warm_up_steps: WARM_UP_STEPS,
    ..STOP_LED
};
/// Of starts with every sample.
pub(crate) const STOP_FREE: EarlyStopping = EarlyStopping {
    cost_ratio_limit: 1.0,
    ..STOP_SMOOTHED
};

/// Every start makes the steps of the warm-up, as long as it has a prospect; then the lowest goes on to its end, and of the
/// others those that are not stopped by then. The ends that were reached, lowest first, and the work of all starts together.
///
/// # Errors
/// As [`crate::solve`].
pub(crate) async fn fit_starts<'a>(
    residual: &TighteningResidual<'a>,
    starts: &[Vec<f64>],
    constraints: &Constraints,
    settings: &Settings,
    rules: EarlyStopping,
    simulator: &BatchSimulator<'a>,
) -> Result<(Vec<Fit>, Work), SolveError> {
    let (n, m) = (residual.parameter_count(), residual.residual_count());
    // Over a contact's edges a second derivative says nothing of what comes next.
    let is_bent = !residual.has_unilateral_contact();
    let start_fit = |start: &Vec<f64>| {
        let search = LevenbergMarquardt::new(n, start, constraints, settings)?.to_chance();
        Ok(StartFit {
            search: if is_bent {
                search
            } else {
                search.without_acceleration()
            },
            problem: DenseResidual::new(residual.clone()),
        })
    };
    let mut start_fits: Vec<StartFit<'_, 'a>> =
        starts.iter().map(start_fit).collect::<Result<_, _>>()?;
    warm_up(&mut start_fits, rules, simulator).await;
    start_fits.sort_by(|one, other| one.rank().total_cmp(&other.rank()));
    for index in 0..start_fits.len() {
        let (before, rest) = start_fits.split_at_mut(index);
        let known = || {
            before
                .iter()
                .filter(|start_fit| start_fit.search.has_ended())
        };
        let is_behind = |search: &LevenbergMarquardt<'_>| {
            known().any(|end| search.cost() > rules.cost_ratio_limit * end.search.cost())
        };
        let start_fit = &mut rest[0];
        if !start_fit.search.has_ended() && is_behind(&start_fit.search) {
            continue;
        }
        while !start_fit.search.has_ended() && !known().any(|end| end.predicts_cost_of(start_fit)) {
            take_turn(&mut [&mut *start_fit], simulator).await;
        }
    }
    let (mut ends, mut work): (Vec<Fit>, Work) = Default::default();
    for StartFit { search, .. } in start_fits {
        work.add(search.work());
        if search.has_ended() {
            ends.push(search.finish(m));
        }
    }
    ends.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    Ok((ends, work))
}

/// One search and the problem that answers it.
struct StartFit<'s, 'a> {
    search: LevenbergMarquardt<'s>,
    problem: DenseResidual<TighteningResidual<'a>>,
}

/// Lets all make the steps of the warm-up, in turns. Those that cannot come as low as the limit beside the lowest end so far
/// wait, and are stopped.
async fn warm_up<'a>(
    start_fits: &mut [StartFit<'_, 'a>],
    rules: EarlyStopping,
    simulator: &BatchSimulator<'a>,
) {
    loop {
        let (ended, others): (Vec<_>, Vec<_>) =
            (start_fits.iter_mut()).partition(|start_fit| start_fit.search.has_ended());
        let lowest = (ended.iter().map(|end| end.search.cost())).fold(f64::INFINITY, f64::min);
        let is_running = |start_fit: &&mut StartFit<'_, 'a>| {
            let search = &start_fit.search;
            let hoped_for = search.cost() - OVERACHIEVEMENT * search.predicted_decrease();
            let may_run = search.work().iterations <= rules.warm_up_steps
                && hoped_for <= rules.cost_ratio_limit * lowest;
            may_run && !ended.iter().any(|end| end.predicts_cost_of(start_fit))
        };
        let mut running: Vec<_> = others.into_iter().filter(is_running).collect();
        if running.is_empty() {
            return;
        }
        take_turn(&mut running, simulator).await;
    }
}

/// Each gets the answer to what it asks, and goes on to the next question; none may have ended.
async fn take_turn<'a>(running: &mut [&mut StartFit<'_, 'a>], simulator: &BatchSimulator<'a>) {
    let requests = running
        .iter_mut()
        .filter_map(|start_fit| start_fit.request());
    let simulated = simulator.simulate(requests.collect()).await;
    for (start_fit, simulated) in running.iter_mut().zip(simulated) {
        start_fit
            .problem
            .residual_function_mut()
            .prefetch(simulated);
        answer(&mut start_fit.search, &mut start_fit.problem);
    }
}

impl<'a> StartFit<'_, 'a> {
    /// The simulation that answers what the search asks for next.
    fn request(&mut self) -> Option<SimulationRequest<'a>> {
        let (values, with_slopes) = match self.search.query() {
            Query::Linearization { at, .. } => (at.to_vec(), true),
            Query::Cost { at } => (at.to_vec(), false),
            Query::SecondDerivative { at, along, .. } => (further_along(at, along), false),
            Query::Nothing => return None,
        };
        let residual = self.problem.residual_function_mut();
        Some(residual.request(&values, with_slopes))
    }

    /// Whether `other` has come to where this one's end, by its derivatives, foretells its cost: what it would find is known.
    fn predicts_cost_of(&self, other: &Self) -> bool {
        let (here, there) = (self.search.cost(), other.search.cost());
        let predicted = self.search.predicted_cost(other.search.values());
        (there - predicted).abs() <= ALIKE * (predicted - here) + RESOLUTION * here
    }

    /// Who has ended goes first, so that the others know whom they have to beat.
    fn rank(&self) -> f64 {
        match self.search.has_ended() {
            true => f64::NEG_INFINITY,
            false => self.search.cost(),
        }
    }
}
