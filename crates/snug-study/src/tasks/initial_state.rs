//! Whether a machine's recordings begin in motion: then how each begins is no effect to be looked for, but part of how it is simulated,
//! as mass, damping and stiffness are.

use crate::study::Study;
use crate::tasks::cases::with_settled;
use snug_campaign::Quantity;
use snug_identify::{FitTask, SpectralStart};
use snug_model::{Effect, ParameterSettings};
use std::f64::consts::TAU;

/// The effect that says how a recording begins, and its angle.
const BEGINS: Effect = Effect::InitialMotion;
const ANGLE: &str = "theta0_rad";
/// Speed at the first sample, over its root mean square in the recording, from which it begins in motion \[–\]. Chosen.
const IN_MOTION: f64 = 0.1;
/// The same over the standard deviation of what no three neighbouring samples agree on: five hardly ever come by chance.
const BEYOND_NOISE: f64 = 5.0;

/// Lets every recording begin as it moves then, where the speed is measured and one of them is in motion; whether it does.
///
/// Where a spring is so soft that no recording sees the mass swing on it once, a constant force of it at the angle of the start is no
/// spring: that angle is held at 0 then.
pub(super) fn settle(
    study: &mut Study,
    cases: &[FitTask<'_>],
    start: Option<&SpectralStart>,
) -> bool {
    let is_told = |name: &String| name == BEGINS.name();
    if study.model.effects.iter().any(is_told) || !cases.iter().any(begins_moving) {
        return false;
    }
    let before = study.clone();
    study.model.effects.insert(0, BEGINS.name().to_owned());
    if !start.is_some_and(|start| swings(start, cases)) {
        let held = ParameterSettings {
            value: Some(0.0),
            fixed: true,
            ..ParameterSettings::default()
        };
        let parameters = &mut study.model.parameters;
        parameters.entry(ANGLE.to_owned()).or_insert(held);
    }
    let is_possible = can_be_simulated(study, cases);
    if !is_possible {
        *study = before;
    }
    is_possible
}

/// Takes back what was settled: a simulation that takes up the measured motion begins with it.
pub(super) fn take_back(study: &mut Study, before: &Study) {
    study.model.effects.clone_from(&before.model.effects);
    if !before.model.parameters.contains_key(ANGLE) {
        study.model.parameters.remove(ANGLE);
    }
}

/// Whether the speed at the first sample is no noise, and no little of what it is elsewhere.
fn begins_moving(case: &FitTask<'_>) -> bool {
    let speeds = case.measured();
    let Some(first) = speeds
        .first()
        .filter(|_| case.quantity() == Quantity::Velocity)
    else {
        return false;
    };
    let rms = |squares: f64, count: usize| (squares / count.max(1) as f64).sqrt();
    let usual = rms(speeds.iter().map(|speed| speed * speed).sum(), speeds.len());
    let bends = speeds.windows(3).map(|at| at[0] - 2.0 * at[1] + at[2]);
    // Of white noise that has the sixfold variance.
    let noise = rms(bends.map(|bend| bend * bend / 6.0).sum(), speeds.len());
    first.abs() > (IN_MOTION * usual).max(BEYOND_NOISE * noise)
}

/// Whether the mass swings on the spring within the longest of the recordings.
fn swings(start: &SpectralStart, cases: &[FitTask<'_>]) -> bool {
    let [mass, _, stiffness] = start.values;
    let longest_s = cases
        .iter()
        .map(|case| case.measured().len() as f64 * case.tightening.time_base.interval_s)
        .fold(0.0, f64::max);
    TAU * (mass / stiffness).sqrt() < longest_s
}

/// Whether step by step, as no model without effects has to be, the model can be simulated from where it begins.
fn can_be_simulated(study: &Study, cases: &[FitTask<'_>]) -> bool {
    let can_be = |case: &FitTask<'_>| {
        let values: Vec<f64> = case.model.parameters().iter().map(|p| p.value).collect();
        case.squares_left(&case.model, &values)
            .is_ok_and(f64::is_finite)
    };
    with_settled(study, cases.iter().map(FitTask::lent).collect())
        .is_ok_and(|cases| cases.iter().all(can_be))
}
