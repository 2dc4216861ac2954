//! What is kept for validation: how well the parameters of the others predict it.

use crate::study::Study;
use snug_campaign::{
    Estimate, FitStatus, Prediction, Quantity, RestartedPrediction, Tightening, Traces, Validation,
};
use snug_identify::{Simulation, agreement};
use snug_model::{Input, Model, Scale};
use snug_preprocess::cumulative_trapezoid;
use std::f64::consts::TAU;

/// The mean of every parameter over converged fits, carried by the first of them; `None` where there is none.
pub(crate) fn mean_estimate<'a>(all: impl Iterator<Item = &'a Estimate>) -> Option<Estimate> {
    let is_end = |estimate: &&Estimate| {
        matches!(
            estimate.status,
            FitStatus::Converged | FitStatus::ConvergedAtConstraint
        )
    };
    let converged: Vec<&Estimate> = all.filter(is_end).collect();
    let mut mean = (*converged.first()?).clone();
    for (index, parameter) in mean.parameters.iter_mut().enumerate() {
        let sum: f64 = converged.iter().map(|e| e.parameters[index].value).sum();
        parameter.value = sum / converged.len() as f64;
    }
    Some(mean)
}

/// How well `values` predict the fitted output of a tightening: freely, as `free` simulated it under `input`, and restarted.
pub(crate) fn predicted(
    study: &Study,
    model: &Model,
    input: &Input,
    tightening: &Tightening,
    values: &[f64],
    free: &Traces,
) -> Validation {
    let quantity = study.identify.fitted_output;
    let against = |simulated: &[f64]| {
        let measured = tightening.motion.get(quantity)?;
        let unscored = study.validation.unscored_samples;
        let (y, s) = (measured.get(unscored..)?, simulated.get(unscored..)?);
        Some(Prediction {
            fit_percent: agreement::fit_percent(y, s),
            rms: (!y.is_empty()).then(|| agreement::rms_residual(y, s)),
        })
    };
    let restarted = || {
        let every_s = restarted_every_s(study, tightening)?;
        let input = Simulation::Restarted { every_s }.of(input.clone(), tightening);
        let mut output = vec![0.0; tightening.torque_nm.len()];
        model.output(values, &input, quantity, &mut output).ok()?;
        Some(RestartedPrediction {
            every_s,
            prediction: against(&output)?,
        })
    };
    Validation {
        free_run: (free.simulated.get(quantity).and_then(against)).unwrap_or_default(),
        restarted: restarted(),
    }
}

/// Restarts per period of the motion: short enough that small errors stay small, long enough that forces show.
const STRETCHES_PER_PERIOD: f64 = 8.0;
/// Fewest samples between restarts: fewer say nothing of a motion.
const FEWEST_SAMPLES: f64 = 8.0;
/// Fewest restarts per period where that many samples ask for longer ways between them; rigs faster than that are sampled for a free
/// run. Chosen.
const FEWEST_PER_PERIOD: f64 = 4.0;

/// From one restart to the next \[s\]: as the study restarts the model, or as it would; `None` where it could not.
fn restarted_every_s(study: &Study, tightening: &Tightening) -> Option<f64> {
    let motion = &tightening.motion;
    if study.identify.fitted_output == Quantity::Acceleration
        || motion.displacement_rad.is_none()
        || is_of_an_accelerometer(tightening)
    {
        return None;
    }
    match (study.identify.simulation, study.model.scale) {
        (Simulation::Restarted { every_s }, _) => Some(every_s),
        (_, Scale::Rig { time_s, .. }) => every_s_of(TAU * time_s, tightening),
        _ => None,
    }
}

/// Whether the displacement was integrated from an acceleration: it drifts, and is no motion that a model could be restarted from. One that a
/// sensor of its own measured beside an accelerometer is.
pub(crate) fn is_of_an_accelerometer(tightening: &Tightening) -> bool {
    let motion = &tightening.motion;
    let is_integral = |of: &Option<Vec<f64>>, that: &Option<Vec<f64>>| {
        let integral = |samples| cumulative_trapezoid(samples, tightening.time_base.interval_s);
        (of.as_deref().zip(that.as_deref())).is_some_and(|(of, that)| integral(of) == that)
    };
    is_integral(&motion.acceleration_rad_per_s2, &motion.velocity_rad_per_s)
        && is_integral(&motion.velocity_rad_per_s, &motion.displacement_rad)
}

/// From one restart to the next where the motion has this period \[s\]; `None` where that is too fast for its sampling. Whole
/// samples, so that it does not depend on the unit of time.
pub(crate) fn every_s_of(period_s: f64, tightening: &Tightening) -> Option<f64> {
    let interval_s = tightening.time_base.interval_s;
    let period = period_s / interval_s;
    let samples = (period / STRETCHES_PER_PERIOD).max(FEWEST_SAMPLES);
    let every_s = samples.round() * interval_s;
    // As people write it, who do not mean the last bits of a product.
    let every_s = format!("{every_s:.12e}").parse().unwrap_or(every_s);
    (samples <= period / FEWEST_PER_PERIOD).then_some(every_s)
}
