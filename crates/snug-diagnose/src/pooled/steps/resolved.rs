//! In how many steps from sample to sample a model must be simulated, for what it adds to be resolved.

use crate::pooled::fitted::Fitted;
use crate::pooled::steps::MOST_STEPS;
use crate::ranking::thresholds::FEW;
use snug_identify::FitTask;
use std::borrow::Cow;

/// Squared error in steps of one length, over that in steps half as long, up to which their length does not matter \[–\]. Chosen: of a spring
/// that lets go within a millimetre on a way of 26, its numbers given, one step leaves 22 times the noise, four leave it.
const ALIKE: f64 = 1.3;
/// Share of the squared output below which a difference is none, however little is left \[–\]. Chosen: a thousandth of the output.
const HARDLY_ANY: f64 = 1e-6;
/// Steps from sample to sample at most \[–\]. Chosen: beyond, it is a rig for which the recordings are sampled too slowly.
const MOST_PER_SAMPLE: usize = 8;

/// The steps where those that `cases` are simulated in are too long for `fitted`; `None` where they do.
pub(crate) fn shorter_steps(cases: &[FitTask<'_>], fitted: &Fitted) -> Option<usize> {
    let samples: usize = cases.iter().map(|case| case.measured().len()).sum();
    let members = fitted.spread(FEW);
    let begun = cases.first()?.input.substeps();
    let may_be = |steps: usize| steps <= MOST_PER_SAMPLE && steps * samples <= MOST_STEPS;
    let whole: f64 = (members.iter())
        .flat_map(|&member| cases[member].measured())
        .map(|y| y * y)
        .sum();
    let mut steps = begun;
    let mut left = squares_left(cases, fitted, &members, steps)?;
    while may_be(2 * steps) {
        let finer = squares_left(cases, fitted, &members, 2 * steps)?;
        let is_alike = (1.0 / ALIKE..=ALIKE).contains(&(left / finer));
        if is_alike || (left - finer).abs() < HARDLY_ANY * whole {
            break;
        }
        (steps, left) = (2 * steps, finer);
    }
    (steps > begun).then_some(steps)
}

/// What it leaves of these `members`, simulated in so many steps; `None` where an input has a grid of its own, or it cannot be simulated.
fn squares_left(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    members: &[usize],
    steps: usize,
) -> Option<f64> {
    let mut squares = 0.0;
    for &member in members {
        let case = &cases[member];
        if case.input.is_band_limited() {
            return None;
        }
        let model = case.model_with(&fitted.effects).ok()?;
        let named = fitted.all_named(member);
        let known = |name: &str| {
            named
                .iter()
                .find(|(known, _)| known == name)
                .map(|one| one.1)
        };
        let parameters = model.parameters().iter();
        let values: Vec<f64> = parameters
            .map(|one| known(&one.name).unwrap_or(one.value))
            .collect();
        let input = case.input.clone().into_owned().in_steps(steps);
        let finer = FitTask {
            input: Cow::Owned(input),
            ..case.lent()
        };
        squares += finer.squares_left(&model, &values).ok()?;
    }
    squares.is_finite().then_some(squares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, exact};
    use snug_model::Effect::{self, BoucWen, CubicStiffness};

    fn of(effect: Effect, sizes: &[f64]) -> Option<usize> {
        let cases: Vec<FitTask> = (0..4)
            .map(|number| exact(number, &[effect], sizes))
            .collect();
        let tally = Tally::default();
        let fitted = fit_effects(Cases::new(&cases, &tally), &[effect], None, WHOLE);
        shorter_steps(&cases, &fitted.expect("it can be fitted"))
    }

    #[test]
    fn what_one_step_resolves_asks_for_no_more() {
        assert_eq!(of(BoucWen, &[2e3, 5e-3]), None);
        assert_eq!(of(CubicStiffness, &[2e6]), None);
    }
}
