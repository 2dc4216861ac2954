//! In how many steps from sample to sample a model must be simulated, for what it adds to be resolved.

use crate::data::cases::Cases;
use crate::pooled::equation::values;
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
pub(crate) fn shorter_steps(cases: Cases<'_>, fitted: &Fitted) -> Option<usize> {
    let samples: usize = cases.iter().map(|case| case.measured().len()).sum();
    let members = fitted.spread(FEW);
    let begun = cases.first()?.input.substeps();
    let may_be = |steps: usize| steps <= MOST_PER_SAMPLE && steps * samples <= MOST_STEPS;
    let whole: f64 = (members.iter())
        .flat_map(|&member| cases[member].measured())
        .map(|y| y * y)
        .sum();
    let values = values(cases, fitted)?;
    let left_in = |steps: usize| -> Option<f64> {
        let of_members = members.iter().map(|&member| {
            let (case, values) = (&cases[member], &values[member]);
            squares_left(case, fitted, values, steps)
        });
        let squares: f64 = of_members.sum::<Option<f64>>()?;
        squares.is_finite().then_some(squares)
    };
    let mut steps = begun;
    let mut left = left_in(steps)?;
    while may_be(2 * steps) {
        let finer = left_in(2 * steps)?;
        let is_alike = (1.0 / ALIKE..=ALIKE).contains(&(left / finer));
        if is_alike || (left - finer).abs() < HARDLY_ANY * whole {
            break;
        }
        (steps, left) = (2 * steps, finer);
    }
    (steps > begun).then_some(steps)
}

/// What `fitted` leaves of a case with these `values`, simulated in so many steps; `None` where the input has a grid of its own, or it cannot be
/// simulated.
fn squares_left(case: &FitTask<'_>, fitted: &Fitted, values: &[f64], steps: usize) -> Option<f64> {
    if case.input.is_band_limited() {
        return None;
    }
    let input = case.input.clone().into_owned().in_steps(steps);
    let in_steps = FitTask {
        input: Cow::Owned(input),
        ..case.lent()
    };
    let model = case.model_with(&fitted.effects).ok()?;
    in_steps.squares_left(&model, values).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, exact};
    use snug_model::Effect::{self, BoucWen, CubicStiffness};

    fn of(effect: Effect, sizes: &[f64]) -> Option<usize> {
        let cases: Vec<FitTask> = (0..4)
            .map(|number| exact(number, &[effect], sizes))
            .collect();
        let tally = Tally::default();
        let cases = Cases::new(&cases, &tally);
        let fitted = fit_effects(cases, &[effect], None, WHOLE);
        shorter_steps(cases, &fitted.expect("it can be fitted"))
    }

    #[test]
    fn what_one_step_resolves_asks_for_no_more() {
        assert_eq!(of(BoucWen, &[2e3, 5e-3]), None);
        assert_eq!(of(CubicStiffness, &[2e6]), None);
    }
}
