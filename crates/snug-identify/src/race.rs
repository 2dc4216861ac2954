//! Fits of one tightening from several starts that race.
//!
//! Most starts lead to the same few valleys, and one that is behind after some steps mostly crawls along a valley whose
//! bottom another has found already: it need not be followed to the end.

use crate::fit::Work;
use crate::residual::further_along;
use crate::search::{Ask, Search};
use crate::solver::answer;
use crate::{
    Constraints, DenseResidual, Fit, IdentifyError, Residual, Settings, TighteningResidual,
};
use snug_model::{Run, simulate_side_by_side};

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
pub(crate) fn race(
    residual: &TighteningResidual<'_>,
    starts: &[Vec<f64>],
    constraints: &Constraints,
    settings: &Settings,
    rules: Rules,
) -> Result<(Vec<Fit>, Work), IdentifyError> {
    let (n, m) = (residual.parameter_count(), residual.residual_count());
    let entrant = |start: &Vec<f64>| {
        Ok(Entrant {
            search: Search::new(n, start, constraints, settings)?.of_measurement(),
            problem: DenseResidual::new(residual.clone()),
        })
    };
    let mut entrants: Vec<Entrant<'_, '_>> =
        starts.iter().map(entrant).collect::<Result<_, _>>()?;
    run_abreast(&mut entrants, rules);
    entrants.sort_by(|one, other| one.rank().total_cmp(&other.rank()));
    let (mut ends, mut work): (Vec<Fit>, Work) = Default::default();
    for mut entrant in entrants {
        let is_behind = |end: &Fit| entrant.search.cost() > rules.worth * end.cost;
        if !entrant.search.has_ended() && ends.iter().any(is_behind) {
            work.add(entrant.search.work());
            continue;
        }
        while !answer(&mut entrant.search, &mut entrant.problem) {}
        let end = entrant.search.finish(m);
        work.add(&end.work);
        ends.push(end);
    }
    ends.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    Ok((ends, work))
}

/// One search and the problem that answers it.
struct Entrant<'s, 'a> {
    search: Search<'s>,
    problem: DenseResidual<TighteningResidual<'a>>,
}

/// Simulations from which side by side they take less time than one after the other.
const FEWEST: usize = 3;
/// Multiple of what its derivatives promise that a search may hope for: down the side of a narrow valley, as contacts make,
/// the cost falls up to three times faster than they say.
const HOPE: f64 = 4.0;

/// Lets all make the heat's steps, in turns: what they ask next is simulated side by side. Those who cannot hope to come as
/// low as is worth it beside the lowest end so far wait, and are left behind.
fn run_abreast(entrants: &mut [Entrant<'_, '_>], rules: Rules) {
    loop {
        let ended = entrants.iter().filter(|entrant| entrant.search.has_ended());
        let lowest = (ended.map(|entrant| entrant.search.cost())).fold(f64::INFINITY, f64::min);
        let is_running = |entrant: &&mut Entrant<'_, '_>| {
            let search = &entrant.search;
            let hoped_for = search.cost() - HOPE * search.promise();
            let may_run = search.steps() <= rules.heat && hoped_for <= rules.worth * lowest;
            may_run && !search.has_ended()
        };
        let mut running: Vec<_> = entrants.iter_mut().filter(is_running).collect();
        if running.is_empty() {
            return;
        }
        for with_slopes in [true, false] {
            let asked: Vec<_> = (running.iter_mut())
                .filter_map(|entrant| Some((entrant.asked(with_slopes)?, &mut entrant.problem)))
                .collect();
            if asked.len() >= FEWEST {
                foresee(asked, with_slopes);
            }
        }
        for entrant in running {
            answer(&mut entrant.search, &mut entrant.problem);
        }
    }
}

/// Simulates, side by side, what problems will be asked for next.
fn foresee(asked: Vec<(Vec<f64>, &mut DenseResidual<TighteningResidual<'_>>)>, with_slopes: bool) {
    let mut free = Vec::new();
    let mut runs: Vec<Run<'_>> = Vec::new();
    for (values, problem) in asked {
        let residual = problem.residual_function_mut();
        if with_slopes {
            free = residual.free().to_vec();
        }
        runs.push(residual.foresee(&values, with_slopes));
    }
    simulate_side_by_side(&mut runs, &free);
}

impl Entrant<'_, '_> {
    /// The values whose residual, with its slopes or without, the search asks for next.
    fn asked(&mut self, with_slopes: bool) -> Option<Vec<f64>> {
        match self.search.ask() {
            Ask::Linearization { at, .. } if with_slopes => Some(at.to_vec()),
            Ask::Cost { at } if !with_slopes => Some(at.to_vec()),
            Ask::Bending { at, along, .. } if !with_slopes => Some(further_along(at, along)),
            _ => None,
        }
    }

    /// Who has ended goes first, so that the others know whom they have to beat.
    fn rank(&self) -> f64 {
        match self.search.has_ended() {
            true => f64::NEG_INFINITY,
            false => self.search.cost(),
        }
    }
}
