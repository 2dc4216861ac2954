//! One tightening, from prepared signals to everything that is reported about it.

use crate::error::StudyError;
use crate::evaluation::validation::predicted;
use crate::study::Study;
use snug_campaign::{
    Estimate, FitMeasures, FitStatus, Motion, Quantity, Recording, Rejection, Segment, Selection,
    Tightening, TighteningId, TighteningResult, Traces, target_torque_nm,
};
use snug_identify::{FitTask, IdentifyError, agreement, derived, identify_all};
use snug_model::{
    BASE_PARAMETERS, Effect, Input, Model, ModelError, Scale, euler_displacement,
    inverse_dynamics_force, spring_damper_force, thesis_damping_ratio,
};
use snug_preprocess::{Prepared, Preset, ThesisChecks};
use std::borrow::Cow;

/// A tightening's result with its signals.
pub struct Evaluated {
    pub result: TighteningResult,
    /// `None` when nothing was simulated because the identification failed.
    pub traces: Option<Traces>,
    pub onset: Option<usize>,
}

/// What is made of a simulated tightening.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    /// Every signal, and all that follows from them.
    Signals,
    /// What selection and a table of results take: no signal, and no measure that needs one of its own.
    Numbers,
}

/// Identifies tightenings side by side and simulates each with what was found.
pub fn fitted(
    study: &Study,
    prepared: &[&Prepared],
) -> Result<Vec<Result<Evaluated, IdentifyError>>, StudyError> {
    fitted_keeping(Kept::Signals, study, prepared)
}

/// The same, of which so much is kept.
pub fn fitted_keeping(
    kept: Kept,
    study: &Study,
    prepared: &[&Prepared],
) -> Result<Vec<Result<Evaluated, IdentifyError>>, StudyError> {
    let tasks = (prepared.iter())
        .map(|one| {
            Ok(FitTask {
                tightening: Cow::Borrowed(&one.tightening),
                input: Cow::Owned(input(study, one)),
                model: Cow::Owned(study.model_for(&one.tightening)?),
                settings: study.identify_settings(&one.tightening),
            })
        })
        .collect::<Result<Vec<FitTask<'_>>, StudyError>>()?;
    let estimates = identify_all(&tasks);
    Ok((estimates.into_iter().zip(&tasks).zip(prepared))
        .map(|((estimate, task), one)| Ok(identified(kept, study, task, one, estimate?)?))
        .collect())
}

/// A tightening simulated with its own estimate.
fn identified(
    kept: Kept,
    study: &Study,
    task: &FitTask<'_>,
    prepared: &Prepared,
    estimate: Estimate,
) -> Result<Evaluated, ModelError> {
    let (model, input) = (&*task.model, &*task.input);
    tracing::debug!(
        tightening = prepared.tightening.id.number,
        status = ?estimate.status,
        iterations = estimate.iterations,
        conic_solves = estimate.conic_solves,
        "identified"
    );
    let preset = study.preprocess.preset;
    simulated(
        study,
        model,
        input,
        prepared,
        estimate,
        (task.unscored(), kept),
        |estimate, measures| {
            let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
            let mut rejections = preparation_rejections(prepared, model, input, &values);
            let selection = &study.selection;
            rejections.extend(selection.rejections(preset, model.scale(), estimate, measures));
            rejections
        },
    )
}

/// Simulates a tightening that is kept for validation with parameters found elsewhere: from its first sample to its last, and
/// where that can be from the measured motion again and again. What the study holds for its group, it has.
pub fn validated(
    study: &Study,
    prepared: &Prepared,
    estimate: &Estimate,
) -> Result<Evaluated, StudyError> {
    let tightening = &prepared.tightening;
    let model = study.model_for(tightening)?;
    let input = free_input(study, prepared);
    let mut estimate = estimate.clone();
    for (parameter, own) in estimate.parameters.iter_mut().zip(model.parameters()) {
        if own.fixed {
            parameter.value = own.value;
        }
        parameter.standard_error = None;
        parameter.interval = None;
    }
    let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
    let mut evaluated = simulated(
        study,
        &model,
        &input,
        prepared,
        estimate,
        (study.validation.unscored_samples, Kept::Signals),
        |_, _| vec![Rejection::Validation],
    )?;
    evaluated.result.validation = (evaluated.traces.as_ref())
        .map(|free| predicted(study, &model, &input, tightening, &values, free));
    Ok(evaluated)
}

/// What is known of a segment that could not be used; its findings say why.
pub fn without_estimate(study: &Study, recording: &Recording, segment: &Segment) -> Evaluated {
    let end = segment.end.min(recording.torque_nm.len());
    let torque = recording
        .torque_nm
        .get(segment.start..end)
        .unwrap_or_default();
    let finite = torque.iter().copied().filter(|torque| torque.is_finite());
    let peak_torque_nm = finite.reduce(f64::max).unwrap_or(f64::NAN);
    Evaluated {
        result: TighteningResult {
            started_at_s: None,
            id: TighteningId {
                file: recording.file.clone(),
                number: segment.number,
            },
            conditions: recording.conditions.clone(),
            rig: study.preprocess.rig.rig(recording),
            peak_torque_nm,
            target_torque_nm: target_torque_nm(peak_torque_nm),
            estimate: None,
            measures: FitMeasures::default(),
            selection: Selection {
                rejections: vec![Rejection::DataQuality],
            },
            corrections: Vec::new(),
            noise: None,
            validation: None,
        },
        traces: None,
        onset: None,
    }
}

/// The input of the simulation that is compared with the measurement.
pub fn input(study: &Study, prepared: &Prepared) -> Input {
    let free = free_input(study, prepared);
    study.identify.simulation.of(free, &prepared.tightening)
}

/// The input as the study says it behaves, when its pulse begins and since when the sensor's signal has been integrated.
fn free_input(study: &Study, prepared: &Prepared) -> Input {
    let tightening = &prepared.tightening;
    let interval_s = tightening.time_base.interval_s;
    let onset_s = tightening.onset.unwrap_or(0) as f64 * interval_s;
    let input = Input::new(&tightening.torque_nm, interval_s, study.model.intersample())
        .in_steps(study.model.steps_per_sample())
        .with_onset(onset_s)
        .with_torque_before(torque_before_nm(study, &tightening.torque_nm));
    match study.preprocess.preset {
        // The original integrates from the segment's start, where its time is 0.
        Preset::Thesis => input
            .with_rest_before(tightening.time_base.start_s)
            .with_zero_at(prepared.zero_sample),
        Preset::Snug => input,
    }
}

/// The torque \[Nm\] before the first sample of a machine's recording, which begins at rest where nothing else is said: none, if the
/// input is 0 anywhere on its way. An input that never is holds a load, before as then.
pub(crate) fn torque_before_nm(study: &Study, torque_nm: &[f64]) -> Option<f64> {
    let is_machine = matches!(study.model.scale, Scale::Rig { .. });
    let least = torque_nm.iter().copied().fold(f64::INFINITY, f64::min);
    let most = torque_nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let passes_zero = least <= 0.0 && most >= 0.0;
    (is_machine && passes_zero).then_some(0.0)
}

/// A model without `effects`, and what `values` are of what is left.
fn without(
    mut effects: impl Iterator<Item = Effect>,
    model: &Model,
    values: &[f64],
) -> Result<(Model, Vec<f64>), ModelError> {
    let mut found = model.clone();
    for (parameter, value) in found.parameters_mut().iter_mut().zip(values) {
        parameter.value = *value;
    }
    let left = effects.try_fold(found, |model, effect| model.without_effect(effect))?;
    let own = left.parameters().iter().map(|p| p.value).collect();
    Ok((left, own))
}

/// What preparation rejects a tightening for, once the model's sensor effects are taken out of the displacement.
///
/// The original program looks at the displacement before any fit; a bias that the model has found is no reason any more.
fn preparation_rejections(
    prepared: &Prepared,
    model: &Model,
    input: &Input,
    values: &[f64],
) -> Vec<Rejection> {
    let sensors = || model.effects().filter(|effect| effect.measurement_only());
    let measured = prepared.tightening.motion.displacement_rad.as_ref();
    let (Some(_), Some(measured), true) =
        (prepared.thesis_checks, measured, sensors().next().is_some())
    else {
        return prepared.rejections();
    };
    let Ok((plain, own)) = without(sensors(), model, values) else {
        return prepared.rejections();
    };
    let displacement = |model: &Model, values: &[f64]| {
        let mut output = vec![0.0; measured.len()];
        let done = model.output(values, input, Quantity::Displacement, &mut output);
        done.map(|()| output)
    };
    let (Ok(sensed), Ok(moved)) = (displacement(model, values), displacement(&plain, &own)) else {
        return prepared.rejections();
    };
    let corrected: Vec<f64> = (measured.iter().zip(sensed.iter().zip(&moved)))
        .map(|(measured, (sensed, moved))| measured - (sensed - moved))
        .collect();
    Prepared {
        thesis_checks: Some(ThesisChecks::of(&corrected)),
        ..prepared.clone()
    }
    .rejections()
}

/// Whether a tightening that preparation found no fault with would be selected with this estimate.
pub fn is_usable(
    study: &Study,
    task: &FitTask<'_>,
    model: &Model,
    estimate: &Estimate,
) -> Result<bool, ModelError> {
    let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
    let tightening = &task.tightening;
    let traces = traces(model, &task.input, tightening, &values)?;
    let measures = measures(study, tightening, &traces, estimate, task.unscored());
    let (preset, scale) = (study.preprocess.preset, model.scale());
    let rejections = (study.selection).rejections(preset, scale, estimate, &measures);
    Ok(rejections.is_empty())
}

/// Everything that follows from a tightening and its parameters.
fn simulated(
    study: &Study,
    model: &Model,
    input: &Input,
    prepared: &Prepared,
    estimate: Estimate,
    (unscored, kept): (usize, Kept),
    rejections: impl FnOnce(&Estimate, &FitMeasures) -> Vec<Rejection>,
) -> Result<Evaluated, ModelError> {
    let tightening = &prepared.tightening;
    let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
    let failed = estimate.status == FitStatus::Failed || values.iter().any(|v| !v.is_finite());
    let (measures, traces) = match kept {
        _ if failed => (FitMeasures::default(), None),
        Kept::Signals => {
            let traces = traces(model, input, tightening, &values)?;
            let measures = measures(study, tightening, &traces, &estimate, unscored);
            (measures, Some(traces))
        }
        Kept::Numbers => {
            let motion = model.simulate(&values, input)?;
            (
                numbers(study, tightening, &motion, &estimate, unscored),
                None,
            )
        }
    };
    let selection = Selection {
        rejections: rejections(&estimate, &measures),
    };
    Ok(Evaluated {
        result: TighteningResult {
            started_at_s: None,
            id: tightening.id.clone(),
            conditions: tightening.conditions.clone(),
            rig: tightening.rig,
            peak_torque_nm: tightening.peak_torque_nm,
            target_torque_nm: tightening.target_torque_nm,
            estimate: Some(estimate),
            measures,
            selection,
            corrections: tightening.corrections.clone(),
            noise: tightening.noise.clone(),
            validation: None,
        },
        traces,
        onset: tightening.onset,
    })
}

fn traces(
    model: &Model,
    input: &Input,
    tightening: &Tightening,
    values: &[f64],
) -> Result<Traces, ModelError> {
    let simulated = model.simulate(values, input)?;
    let force = |motion: &Motion| {
        motion
            .acceleration_rad_per_s2
            .as_ref()
            .map_or_else(Vec::new, |acceleration| {
                inverse_dynamics_force(&tightening.rig, &tightening.torque_nm, acceleration)
            })
    };
    let euler = euler_displacement(
        &tightening.rig,
        values,
        &tightening.torque_nm,
        tightening.time_base.interval_s,
    )?;
    Ok(Traces {
        before: Motion::default(),
        time_base: tightening.time_base,
        torque_nm: tightening.torque_nm.clone(),
        measured: tightening.motion.clone(),
        euler_displacement_rad: converged(euler, &simulated),
        force_f1_n: spring_damper_force(&tightening.rig, values, &simulated)?,
        force_f2_n: force(&tightening.motion),
        force_f3_n: force(&simulated),
        grip_force_n: tightening.grip_force_n.clone(),
        simulated,
    })
}

/// Beyond this multiple of the exact displacement's peak the Euler method has diverged.
const DIVERGED_RATIO: f64 = 10.0;

/// The Euler displacement, or nothing where the sampling is too coarse for the method and it ran away.
fn converged(euler: Vec<f64>, simulated: &Motion) -> Vec<f64> {
    let largest = |samples: &[f64]| samples.iter().fold(0.0_f64, |peak, x| peak.max(x.abs()));
    let exact = simulated.displacement_rad.as_deref().map_or(0.0, largest);
    let bounded = euler.iter().all(|x| x.abs() <= DIVERGED_RATIO * exact);
    if bounded { euler } else { Vec::new() }
}

fn measures(
    study: &Study,
    tightening: &Tightening,
    traces: &Traces,
    estimate: &Estimate,
    unscored: usize,
) -> FitMeasures {
    let pair = |quantity| pair(tightening, &traces.simulated, quantity, unscored);
    let displacement = pair(Quantity::Displacement);
    let euler = scored(&traces.euler_displacement_rad, unscored);
    FitMeasures {
        fit_percent_fitted_output: pair(study.identify.fitted_output)
            .and_then(|(y, s)| agreement::fit_percent(y, s)),
        rms_displacement_rad: displacement.map(|(y, s)| agreement::rms_residual(y, s)),
        euler_accuracy_percent: displacement
            .filter(|_| !traces.euler_displacement_rad.is_empty())
            .and_then(|(y, _)| agreement::accuracy_percent(y, euler)),
        peak_force_f1_n: peak(&traces.force_f1_n),
        peak_force_f2_n: peak(&traces.force_f2_n),
        peak_force_f3_n: peak(&traces.force_f3_n),
        peak_grip_force_n: traces.grip_force_n.as_deref().and_then(peak),
        ..numbers(study, tightening, &traces.simulated, estimate, unscored)
    }
}

/// The samples that are compared.
fn scored(samples: &[f64], unscored: usize) -> &[f64] {
    samples.get(unscored..).unwrap_or_default()
}

/// What was measured and what was simulated of a quantity.
fn pair<'a>(
    tightening: &'a Tightening,
    simulated: &'a Motion,
    quantity: Quantity,
    unscored: usize,
) -> Option<(&'a [f64], &'a [f64])> {
    let measured = tightening.motion.get(quantity)?;
    let simulated = simulated.get(quantity)?;
    Some((scored(measured, unscored), scored(simulated, unscored)))
}

/// The measures that selection and a table of results take; the fit of the fitted output only where it takes the noise's place.
fn numbers(
    study: &Study,
    tightening: &Tightening,
    simulated: &Motion,
    estimate: &Estimate,
    unscored: usize,
) -> FitMeasures {
    let pair = |quantity| pair(tightening, simulated, quantity, unscored);
    let [m, c, k] = std::array::from_fn(|index| estimate.parameters[index].value);
    let on_bound = |name: &str| {
        let mut active = estimate.active_constraints.iter();
        active.any(|active| active.starts_with(name))
    };
    let rig = &tightening.rig;
    // A mass or stiffness that was stopped by its bound says nothing about a frequency.
    let natural = derived::natural_frequency(estimate)
        .filter(|_| !on_bound(BASE_PARAMETERS[0]) && !on_bound(BASE_PARAMETERS[2]));
    let damped = derived::damped_frequency(rig, estimate);
    let ratio = derived::damping(rig, estimate);
    let low = |derived: Option<derived::Derived>| Some(derived?.interval?.low);
    let high = |derived: Option<derived::Derived>| Some(derived?.interval?.high);
    let error_over_noise = tightening.noise.as_ref().and_then(|noise| {
        let (measured, simulated) = pair(noise.quantity)?;
        agreement::error_over_noise(measured, simulated, noise)
    });
    FitMeasures {
        fit_percent: pair(Quantity::Displacement).and_then(|(y, s)| agreement::fit_percent(y, s)),
        fit_percent_fitted_output: match error_over_noise {
            Some(_) => None,
            None => {
                pair(study.identify.fitted_output).and_then(|(y, s)| agreement::fit_percent(y, s))
            }
        },
        error_over_noise,
        natural_frequency_hz: natural.map(|natural| natural.value),
        natural_frequency_low_hz: low(natural),
        natural_frequency_high_hz: high(natural),
        damped_frequency_hz: damped.map(|damped| damped.value),
        damped_frequency_low_hz: low(damped),
        damped_frequency_high_hz: high(damped),
        damping_ratio: ratio.map(|ratio| ratio.value),
        damping_ratio_low: low(ratio),
        damping_ratio_high: high(ratio),
        thesis_damping_ratio: thesis_damping_ratio(study.selection.tool_mass_kg, m, c, k),
        ..FitMeasures::default()
    }
}

/// max |F|.
fn peak(force: &[f64]) -> Option<f64> {
    force.iter().map(|force| force.abs()).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_campaign::Rig;

    /// The lag's time constant comes first and has the plain name, the branch's after it is called after its effect until the
    /// lag is gone.
    #[test]
    fn what_is_left_of_a_model_keeps_its_values_whatever_it_is_called() {
        let rig = Rig {
            lever_arm_m: 0.33,
            known_inertia_kg_m2: 0.275,
        };
        let effects = [Effect::AccelerationLag, Effect::MaxwellBranch];
        let model = Model::new(rig, &effects).unwrap();
        let values = [2.0, 90.0, 2200.0, 0.001, 400.0, 0.05];
        let (left, own) = without([effects[0]].into_iter(), &model, &values).unwrap();
        assert_eq!(left.parameters()[4].name, "tau_s");
        assert_eq!(own, [2.0, 90.0, 2200.0, 400.0, 0.05]);
    }
}
