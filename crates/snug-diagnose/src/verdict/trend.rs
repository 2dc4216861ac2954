//! What changes from tightening to tightening: fatigue shows in the fitted m, c, k, not in the misfit of any one.

use crate::pooled::sizes::described;
use crate::verdict::reasons::described as explanation;
use snug_campaign::{Drift, EffectParameter, RankedEffect};
use snug_identify::FitTask;
use snug_model::{BASE_PARAMETERS, Description, TRENDS};

/// The catalogue's trends as candidates, as far as they could be tested.
pub(crate) fn trends(
    drifts: &[Drift],
    cases: &[FitTask<'_>],
    level: f64,
) -> impl Iterator<Item = RankedEffect> {
    TRENDS
        .iter()
        .filter_map(move |trend| candidate(trend, drifts, cases, level))
}

/// One trend as a candidate: slopes of m, c, k over the tightening's number, tested within files.
///
/// It removes no misfit, since every tightening has its own m, c, k; its p is that of the clearest of the three slopes,
/// times three. `None` where no slope could be tested.
fn candidate(
    description: &'static Description,
    drifts: &[Drift],
    cases: &[FitTask<'_>],
    level: f64,
) -> Option<RankedEffect> {
    let numbers = || {
        cases
            .iter()
            .map(|case| f64::from(case.tightening.id.number))
    };
    let range = numbers().fold(f64::MIN, f64::max) - numbers().fold(f64::MAX, f64::min);
    let over_number = |parameter: &str| {
        let mut all = drifts.iter();
        all.find(|drift| drift.parameter == parameter && drift.against == "trial_number")
    };
    let tested: Vec<&Drift> = BASE_PARAMETERS
        .iter()
        .filter_map(|name| over_number(name))
        .collect();
    let smallest = tested.iter().filter_map(|drift| drift.p).reduce(f64::min)?;
    let per_tightening = |percent: f64| percent / 100.0 / range;
    let parameters: Vec<EffectParameter> = (description.parameters.iter().zip(BASE_PARAMETERS))
        .filter_map(|(spec, name)| {
            let drift = over_number(name)?;
            let interval = drift.interval_percent;
            Some(EffectParameter {
                value: per_tightening(drift.change_percent),
                low: interval.map(|interval| per_tightening(interval.low)),
                high: interval.map(|interval| per_tightening(interval.high)),
                standard_error: interval
                    .map(|interval| per_tightening(interval.high - interval.low) / 3.92),
                ..described(spec)
            })
        })
        .collect();
    let p_family = (smallest * tested.len() as f64).min(1.0);
    Some(RankedEffect {
        effect: description.name.to_owned(),
        kind: description.kind.name().to_owned(),
        unlisted: false,
        expression: None,
        score: 0.0,
        p_family,
        supported: p_family <= level,
        heldout_gain: 0.0,
        heldout_gain_error: 0.0,
        error_over_noise: None,
        behind_first: 0.0,
        twins: Vec::new(),
        plausible: parameters.iter().all(EffectParameter::is_plausible),
        explanation: explanation(description),
        parameters,
    })
}
