//! In how many steps from sample to sample a model must be simulated, for what it adds to be resolved.

use crate::data::cases::Cases;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use crate::pooled::steps::MOST_STEPS;
use crate::ranking::thresholds::FEW;
use snug_identify::FitTask;
use std::borrow::Cow;

/// Mean square of what half the step changes of the output, over that of the motion and of the noise that are left, up to which the step is short
/// enough \[–\]. Compared are the simulations and not their errors: a fit in too long a step bends until half a step leaves as much, in
/// another place. Of the motion, chosen: where half the step changed 0.03 to 0.09 of it, fits had bent to a third and to three times the sizes.
/// Of the noise, chosen: where it reaches that and changes less, no shorter step finds more.
const SHORT_ENOUGH: [f64; 2] = [0.02, 0.1];
/// Share of the squared output below which a difference is none, however little is left \[–\]. Chosen: a ten-thousandth of the output. With a
/// thousandth, a slide that meets a stop and is measured to a thousandth was left 1.3 times the noise, and with shorter steps the noise.
const HARDLY_ANY: f64 = 1e-8;
/// Steps from sample to sample at most \[–\]. Chosen: beyond, it is a rig for which the recordings are sampled too slowly.
const MOST_PER_SAMPLE: usize = 16;

/// The steps where those that `cases` are simulated in are too long for `fitted`; `None` where they do.
pub(crate) fn shorter_steps(cases: Cases<'_>, fitted: &Fitted) -> Option<usize> {
    let samples: usize = cases.iter().map(|case| case.measured().len()).sum();
    let members = fitted.spread(FEW);
    let may_be = |steps: usize| steps <= MOST_PER_SAMPLE && steps * samples <= MOST_STEPS;
    let values = values(cases, fitted)?;
    let simulated_in = |steps: usize| -> Option<Vec<f64>> {
        let of_members = members.iter().map(|&member| {
            let (case, values) = (&cases[member], &values[member]);
            simulated(case, fitted, values, steps)
        });
        Some(of_members.collect::<Option<Vec<_>>>()?.concat())
    };
    let measured: Vec<f64> = (members.iter())
        .flat_map(|&member| &cases[member].measured()[cases[member].unscored()..])
        .copied()
        .collect();
    let begun = cases.first()?.input.substeps();
    let (mut steps, mut output) = (begun, simulated_in(begun)?);
    let most = short_enough(&measured, &output);
    let whole: f64 = measured.iter().map(|y| y * y).sum();
    while may_be(2 * steps) {
        let finer = simulated_in(2 * steps)?;
        let changed = squares_between(&finer, &output);
        if changed <= most || changed < HARDLY_ANY * whole {
            break;
        }
        (steps, output) = (2 * steps, finer);
    }
    (steps > begun).then_some(steps)
}

/// A case simulated in so many steps from sample to sample.
pub(crate) fn in_steps<'a>(case: &'a FitTask<'_>, steps: usize) -> FitTask<'a> {
    FitTask {
        input: Cow::Owned(case.input.clone().into_owned().in_steps(steps)),
        ..case.lent()
    }
}

/// The scored output of a case with these `values`, simulated in so many steps; `None` where the input has a grid of its own, or it cannot be
/// simulated.
fn simulated(
    case: &FitTask<'_>,
    fitted: &Fitted,
    values: &[f64],
    steps: usize,
) -> Option<Vec<f64>> {
    if case.input.is_band_limited() {
        return None;
    }
    let in_steps = in_steps(case, steps);
    let model = case.model_with(&fitted.effects).ok()?;
    let mut output = in_steps.simulated(&model, values).ok()?;
    output.drain(..case.unscored());
    output.iter().all(|y| y.is_finite()).then_some(output)
}

/// How much half a step may change \[the output's unit squared\]. What neighbours of what is left do not share is noise: of white noise half the
/// squared differences between them are its power.
fn short_enough(measured: &[f64], simulated: &[f64]) -> f64 {
    let left: Vec<f64> = (measured.iter().zip(simulated))
        .map(|(y, s)| y - s)
        .collect();
    let whole: f64 = left.iter().map(|e| e * e).sum();
    let apart: f64 = (left.windows(2))
        .map(|both| (both[1] - both[0]).powi(2))
        .sum();
    let noise = whole.min(0.5 * apart);
    let [of_motion, of_noise] = SHORT_ENOUGH;
    of_motion * (whole - noise) + of_noise * noise
}

fn squares_between(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, on_machine};
    use snug_campaign::Quantity;
    use snug_identify::FitTask;
    use snug_model::Effect::{self, BoucWen, CubicStiffness};
    use snug_model::{Model, Scale};

    const SCALE: Scale = Scale::Rig {
        torque_nm: 600.0,
        angle_rad: 0.1,
        time_s: 0.05,
    };

    /// A slide of 10 kg on a spring that three sines move up to 2 m/s, made in 16 steps from sample to sample, 5 ms.
    fn slide(effect: Effect, sizes: &[f64]) -> FitTask<'static> {
        let force = |k: u32| -> f64 {
            let t = 5e-3 * f64::from(k);
            400.0 * (18.0 * t).sin() + 300.0 * (31.0 * t).sin() + 200.0 * (7.0 * t).sin()
        };
        let torque_nm: Vec<f64> = (0..800).map(force).collect();
        let nothing = vec![0.0; torque_nm.len()];
        let mut task = on_machine(SCALE, 5e-3, torque_nm, Quantity::Displacement, nothing);
        let truth = Model::scaled(*task.model.rig(), &[effect], SCALE).expect("the rig is one");
        let input = task.input.clone().into_owned().in_steps(16);
        let values = [&[10.0, 150.0, 4000.0], sizes].concat();
        let motion = truth.simulate(&values, &input).expect("as many values");
        task.tightening.to_mut().motion.displacement_rad = motion.displacement_rad;
        task
    }

    fn of(effect: Effect, sizes: &[f64]) -> Option<usize> {
        let cases = [slide(effect, sizes)];
        let tally = Tally::default();
        let cases = Cases::new(&cases, &tally);
        let fitted = fit_effects(cases, &[effect], None, WHOLE);
        shorter_steps(cases, &fitted.expect("it can be fitted"))
    }

    #[test]
    fn what_one_step_resolves_asks_for_no_more() {
        assert_eq!(of(BoucWen, &[2e3, 5e-2]), None);
        assert_eq!(of(CubicStiffness, &[2e6]), None);
    }

    /// It moves ten of them from sample to sample; its fit in one step has bent to 3.5 of them.
    #[test]
    fn a_loop_that_turns_within_a_sample_asks_for_shorter_steps() {
        assert_eq!(of(BoucWen, &[2e5, 1e-3]), Some(2));
    }
}
