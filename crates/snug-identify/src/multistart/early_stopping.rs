//! Fits of one tightening from several starts that race.
//!
//! Most starts lead to the same few valleys, and one that is behind after some steps mostly crawls along a valley whose
//! bottom another has found already: it need not be followed to the end.

use crate::batch::{Request, Simulator};
use crate::residual::tightening::TighteningResidual;
use snug_least_squares::{
    Constraints, DenseResidual, Fit, LevenbergMarquardt, Query, Residual, Settings, SolveError,
    Work, answer, further_along,
};

/// How long everyone runs, and who is left behind then.
#[derive(Clone, Copy)]
pub(crate) struct Rules {
    /// Steps that every start makes, unless it has no hope before.
    pub heat: usize,
    /// How far above the lowest end a search may lie to be followed further: a multiple of that end's cost.
    pub worth: f64,
}

/// Every start that has hope makes the heat's steps, then the lowest goes on to its end, and of the others those that are not
/// left behind by then. The ends that were reached, lowest first, and the work of all starts together.
///
/// # Errors
/// As [`crate::solve`].
pub(crate) async fn race<'a>(
    residual: &TighteningResidual<'a>,
    starts: &[Vec<f64>],
    constraints: &Constraints,
    settings: &Settings,
    rules: Rules,
    simulator: &Simulator<'a>,
) -> Result<(Vec<Fit>, Work), SolveError> {
    let (n, m) = (residual.parameter_count(), residual.residual_count());
    // Over a contact's edges a second derivative says nothing of what comes next.
    let is_bent = !residual.lets_go();
    let entrant = |start: &Vec<f64>| {
        let search = LevenbergMarquardt::new(n, start, constraints, settings)?.to_chance();
        Ok(Entrant {
            search: if is_bent {
                search
            } else {
                search.without_acceleration()
            },
            problem: DenseResidual::new(residual.clone()),
        })
    };
    let mut entrants: Vec<Entrant<'_, 'a>> =
        starts.iter().map(entrant).collect::<Result<_, _>>()?;
    run_heat(&mut entrants, rules, simulator).await;
    entrants.sort_by(|one, other| one.rank().total_cmp(&other.rank()));
    for index in 0..entrants.len() {
        let (before, rest) = entrants.split_at_mut(index);
        let known = || before.iter().filter(|entrant| entrant.search.has_ended());
        let is_behind = |search: &LevenbergMarquardt<'_>| {
            known().any(|end| search.cost() > rules.worth * end.search.cost())
        };
        let entrant = &mut rest[0];
        if !entrant.search.has_ended() && is_behind(&entrant.search) {
            continue;
        }
        while !entrant.search.has_ended() && !known().any(|end| end.foretells(entrant)) {
            take_turn(&mut [&mut *entrant], simulator).await;
        }
    }
    let (mut ends, mut work): (Vec<Fit>, Work) = Default::default();
    for Entrant { search, .. } in entrants {
        work.add(search.work());
        if search.has_ended() {
            ends.push(search.finish(m));
        }
    }
    ends.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    Ok((ends, work))
}

/// Share of the way up from an end by which a cost may differ from what the end foretells, ...
const ALIKE: f64 = 0.1;
/// ... and share of the cost itself that says nothing.
const RESOLUTION: f64 = 1e-6;

/// One search and the problem that answers it.
struct Entrant<'s, 'a> {
    search: LevenbergMarquardt<'s>,
    problem: DenseResidual<TighteningResidual<'a>>,
}

/// Multiple of what its derivatives promise that a search may hope for: down the side of a narrow valley, as contacts make,
/// the cost falls up to three times faster than they say.
const HOPE: f64 = 4.0;

/// Lets all make the heat's steps, in turns. Those who cannot hope to come as low as is worth it beside the lowest end so far
/// wait, and are left behind.
async fn run_heat<'a>(entrants: &mut [Entrant<'_, 'a>], rules: Rules, simulator: &Simulator<'a>) {
    loop {
        let (ended, others): (Vec<_>, Vec<_>) =
            (entrants.iter_mut()).partition(|entrant| entrant.search.has_ended());
        let lowest = (ended.iter().map(|end| end.search.cost())).fold(f64::INFINITY, f64::min);
        let is_running = |entrant: &&mut Entrant<'_, 'a>| {
            let search = &entrant.search;
            let hoped_for = search.cost() - HOPE * search.predicted_decrease();
            let may_run =
                search.work().iterations <= rules.heat && hoped_for <= rules.worth * lowest;
            may_run && !ended.iter().any(|end| end.foretells(entrant))
        };
        let mut running: Vec<_> = others.into_iter().filter(is_running).collect();
        if running.is_empty() {
            return;
        }
        take_turn(&mut running, simulator).await;
    }
}

/// Each gets the answer to what it asks, and goes on to the next question; none may have ended.
async fn take_turn<'a>(running: &mut [&mut Entrant<'_, 'a>], simulator: &Simulator<'a>) {
    let requests = running.iter_mut().filter_map(|entrant| entrant.request());
    let simulated = simulator.simulate(requests.collect()).await;
    for (entrant, simulated) in running.iter_mut().zip(simulated) {
        entrant.problem.residual_function_mut().foresee(simulated);
        answer(&mut entrant.search, &mut entrant.problem);
    }
}

impl<'a> Entrant<'_, 'a> {
    /// The simulation that answers what the search asks for next.
    fn request(&mut self) -> Option<Request<'a>> {
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
    fn foretells(&self, other: &Self) -> bool {
        let (here, there) = (self.search.cost(), other.search.cost());
        let foretold = self.search.predicted_cost(other.search.values());
        (there - foretold).abs() <= ALIKE * (foretold - here) + RESOLUTION * here
    }

    /// Who has ended goes first, so that the others know whom they have to beat.
    fn rank(&self) -> f64 {
        match self.search.has_ended() {
            true => f64::NEG_INFINITY,
            false => self.search.cost(),
        }
    }
}
