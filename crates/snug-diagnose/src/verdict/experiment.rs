//! The experiment that tells twins apart: tightenings are simulated with the one and fitted with the other.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::library::named;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use crate::pooled::sizes::held;
use crate::verdict::thresholds::{MOST_TIGHTENINGS, PATTERNS, TELLING};
use snug_campaign::Experiment;
use snug_campaign::words::statement;
use snug_identify::FitTask;
use snug_least_squares::PooledSettings;
use snug_model::{Effect, Input};
use std::borrow::Cow;

/// How the torque of a tightening at hand is changed for a tightening to be made.
struct Change {
    words: &'static str,
    torque: f64,
    duration: f64,
}

const CHANGES: &[Change] = &[
    Change {
        words: "as they were",
        torque: 1.0,
        duration: 1.0,
    },
    Change {
        words: "with half the target torque",
        torque: 0.5,
        duration: 1.0,
    },
    Change {
        words: "with 1.5 times the target torque",
        torque: 1.5,
        duration: 1.0,
    },
    Change {
        words: "on a harder joint (pulse half as long)",
        torque: 1.0,
        duration: 0.5,
    },
    Change {
        words: "on a softer joint (pulse twice as long)",
        torque: 1.0,
        duration: 2.0,
    },
    Change {
        words: "with 1.5 times the target torque on a softer joint",
        torque: 1.5,
        duration: 2.0,
    },
];

/// The change of conditions under which `second`, refitted, stays furthest from `first`.
pub(crate) fn separating_experiment(
    cases: Cases<'_>,
    first: &Fitted,
    second: Effect,
) -> Option<Experiment> {
    let chosen = *first.effects.last()?;
    let few = first.spread(PATTERNS);
    let mut best: Option<(&Change, f64)> = None;
    for change in CHANGES {
        let distance = distance(cases, first, second, &few, change)?;
        if best.is_none_or(|(_, known)| distance > known) {
            best = Some((change, distance));
        }
    }
    let (change, distance) = best?;
    let tightenings = (distance > 1e-3)
        .then(|| (TELLING / distance).ceil().max(1.0) as usize)
        .filter(|number| *number <= MOST_TIGHTENINGS);
    let between = [chosen, second].map(|effect| named(effect).spoken());
    Some(Experiment {
        between: between.to_vec(),
        conditions: change.words.to_owned(),
        tightenings,
        distance_per_tightening: distance,
        statement: statement::experiment(&between, change.words, tightenings),
    })
}

/// Mean squared distance over noise per tightening between data simulated with `first` and `second` refitted to them.
fn distance(
    cases: Cases<'_>,
    first: &Fitted,
    second: Effect,
    few: &[usize],
    change: &Change,
) -> Option<f64> {
    let mut made = Vec::new();
    for &index in few {
        made.push(simulated(&cases[index], first, index, change)?);
    }
    let mut effects = first.effects.clone();
    effects.pop();
    let base = fit_effects(
        cases.others(&made),
        &effects,
        None,
        Clusters { per_case: 1 },
    )
    .ok()?;
    effects.push(second);
    let mut pooled = PooledModel::new(cases.others(&made), &effects).ok()?;
    let start = base.start(&pooled);
    let end = pooled.fit(&start, &PooledSettings::default()).ok()?;
    Some(2.0 * end.cost() / made.len() as f64)
}

/// A tightening as `first` says it would go under changed conditions, without noise.
fn simulated<'a>(
    case: &FitTask<'a>,
    first: &Fitted,
    member: usize,
    change: &Change,
) -> Option<FitTask<'a>> {
    let model = held(case, first, member, None)?;
    let samples = case.tightening.torque_nm.len();
    let interval_s = case.tightening.time_base.interval_s;
    let onset = case.tightening.onset.unwrap_or(0);
    let torque: Vec<f64> = (0..samples)
        .map(|index| {
            let since = (index as f64 - onset as f64) / change.duration + onset as f64;
            let at = since.clamp(0.0, (samples - 1) as f64);
            let (low, part) = (at as usize, at.fract());
            let high = (low + 1).min(samples - 1);
            let torque = &case.tightening.torque_nm;
            change.torque * (torque[low] * (1.0 - part) + torque[high] * part)
        })
        .collect();
    let input = Input::new(&torque, interval_s, snug_campaign::Intersample::Linear)
        .with_onset(case.input.onset_s())
        .with_rest_before(case.input.rest_before_s());
    let values: Vec<f64> = model.parameters().iter().map(|p| p.value).collect();
    let mut tightening = case.tightening.clone().into_owned();
    tightening.motion = model.simulate(&values, &input).ok()?;
    tightening.torque_nm = torque;
    tightening.corrections.clear();
    Some(FitTask {
        tightening: Cow::Owned(tightening),
        input: Cow::Owned(input),
        model: case.model.clone(),
        settings: case.settings.clone(),
    })
}
