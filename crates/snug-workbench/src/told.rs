//! What pages are told, as JSON: every number as text, with its unit and interval.

use crate::campaign::Campaign;
use crate::changes::{Changes, EffectSet};
use crate::error::WorkbenchError;
use serde_json::{Value, json};
use snug_campaign::words::effect_name::{effect_name, unit_text};
use snug_campaign::words::number::{percent, rounded, significant};
use snug_campaign::{EffectParameter, Interval, ParameterEstimate};
use snug_diagnose::{FitStep, LiveFit, LiveTightening};
use snug_model::Effect;

/// That a fit is under way.
pub(crate) fn fitting(campaign: &Campaign, number: usize, effects: &EffectSet) -> Value {
    json!({
        "kind": "fitting",
        "number": number,
        "effects": effects.names(),
        "tested": campaign.says("Fitting all tightenings together …"),
    })
}

/// A step of the fit under way.
pub(crate) fn step(campaign: &Campaign, number: usize, step: FitStep) -> Value {
    json!({
        "kind": "step",
        "number": number,
        "iteration": step.iteration,
        "error": step.error,
        "shown": campaign.shown(step.error),
    })
}

/// That a model cannot be fitted.
pub(crate) fn failed(campaign: &Campaign, effects: &EffectSet, error: &WorkbenchError) -> Value {
    let names = effects.names().iter().map(|name| campaign.called(name));
    let names: Vec<String> = names.collect();
    let sentence = format!(
        "The model with {} could not be fitted: {error}. The model before is kept.",
        names.join(", ")
    );
    json!({ "kind": "failed", "sentence": sentence })
}

/// What candidates promise beside the present model.
pub(crate) fn promises(effects: &[Effect], shares: &[f64]) -> Value {
    let pairs = effects.iter().zip(shares);
    let shares: Vec<Value> = pairs
        .map(|(effect, &share)| json!({ "effect": effect.name(), "share": share, "shown": percent(share) }))
        .collect();
    json!({ "kind": "promises", "shares": shares })
}

/// The present model, fitted, and the way to it.
pub(crate) fn fitted(
    campaign: &Campaign,
    changes: &Changes,
    fit: &LiveFit,
    error_of: &dyn Fn(&EffectSet) -> Option<f64>,
    seconds: Option<f64>,
) -> Value {
    let present = changes.present();
    let before = changes.past().last();
    let sizes: Vec<Value> = (fit.sizes().iter())
        .map(|(effect, sizes)| json!({ "effect": effect.name(), "sizes": sizes.iter().map(|one| size(campaign, one)).collect::<Vec<_>>() }))
        .collect();
    json!({
        "kind": "fitted",
        "effects": present.names(),
        "before": before.map(EffectSet::names),
        "error": fit.error(),
        "shown": campaign.shown(fit.error()),
        "error_before": before.and_then(error_of).map(|error| campaign.shown(error)),
        "says": says(fit),
        "tested": tested(campaign, fit),
        "step": before.map(|before| change(campaign, before, present)),
        "sizes": sizes,
        "ladder": ladder(campaign, changes, error_of),
        "can_undo": before.is_some(),
        "can_redo": changes.can_redo(),
        "took": seconds.map_or_else(
            || "fitted before".into(),
            |seconds| format!("fitted in {} s", significant(seconds, 2)),
        ),
    })
}

/// What the error means.
fn says(fit: &LiveFit) -> String {
    let mut text = match (fit.is_over_noise(), fit.is_at_noise()) {
        (true, true) => "Nothing but the noise is left.".to_owned(),
        (true, false) => "More than the noise is left: 1 would be nothing but noise.".to_owned(),
        (false, _) => "How much of this is noise is not known.".to_owned(),
    };
    if !fit.has_converged() {
        text += " The fit stopped before it had arrived.";
    }
    text
}

/// What a fresh fit is worth.
fn tested(campaign: &Campaign, fit: &LiveFit) -> String {
    match fit.effects() == campaign.prepared.effects.as_slice() {
        true => "This is the study's own model.".into(),
        false => {
            campaign.says("Not yet tested on tightenings it was not fitted to; the command cargo xtask add does that.")
        }
    }
}

/// `+ stretch reflex − backlash`.
fn change(campaign: &Campaign, before: &EffectSet, after: &EffectSet) -> String {
    let gained = (after.beyond(before)).map(|name| format!("+ {}", campaign.called(name)));
    let lost = (before.beyond(after)).map(|name| format!("− {}", campaign.called(name)));
    gained.chain(lost).collect::<Vec<_>>().join(" ")
}

/// The models from the first to the present one with what each leaves.
fn ladder(
    campaign: &Campaign,
    changes: &Changes,
    error_of: &dyn Fn(&EffectSet) -> Option<f64>,
) -> Vec<Value> {
    let base = campaign.base_set();
    let all: Vec<&EffectSet> = changes.past().iter().chain([changes.present()]).collect();
    let rungs = all.iter().enumerate().map(|(place, &set)| {
        let name = match place.checked_sub(1).map(|before| all[before]) {
            Some(before) => change(campaign, before, set),
            None if *set == base && base.names().is_empty() => "mass, damper, spring".into(),
            None => "the study's own model".into(),
        };
        let error = error_of(set);
        json!({
            "name": name,
            "effects": set.names(),
            "error": error,
            "shown": error.map_or_else(|| "not fitted".into(), |error| campaign.shown(error)),
        })
    });
    rungs.collect()
}

/// `stiffness of the reflex 638.8 [632.6, 645.0] N/m`.
fn size(campaign: &Campaign, parameter: &EffectParameter) -> String {
    let size = campaign.prepared.vocabulary.size(parameter);
    campaign.says(&size.size().to_string())
}

/// One tightening in words: heading, and m, c, k under the model before and under the present one.
pub(crate) fn tightening(
    campaign: &Campaign,
    member: usize,
    models: [(&LiveFit, &LiveTightening); 2],
) -> Value {
    let tightening = &campaign.prepared.live.tasks()[member].tightening;
    let conditions = &tightening.conditions;
    let mut heading = vec![tightening.id.to_string()];
    let named = [
        &conditions.participant,
        &conditions.strategy,
        &conditions.joint,
    ];
    heading.extend(named.into_iter().flatten().cloned());
    let [before, now] = models;
    let pairs = before.1.base.iter().zip(&now.1.base);
    let facts: Vec<Value> = pairs
        .map(|(before, now)| {
            json!([
                base_name(campaign, now),
                amount(campaign, before),
                amount(campaign, now)
            ])
        })
        .collect();
    let error = |fit: &LiveFit| campaign.shown(fit.errors()[member]);
    let place = campaign.worst_first.iter().position(|&one| one == member);
    json!({
        "number": member + 1,
        "heading": heading.join(" · "),
        "place": format!("{} of {}, worst first", place.map_or(0, |place| place + 1), campaign.worst_first.len()),
        "error_before": error(before.0),
        "error": error(now.0),
        "facts": facts,
    })
}

/// `mass m`; of what turns, `inertia I`.
fn base_name(campaign: &Campaign, parameter: &ParameterEstimate) -> String {
    let (_, unit) = campaign.prepared.vocabulary.about(&parameter.unit);
    match parameter.name.as_str() {
        "mass_kg" if unit == "kg m^2" => "inertia I".into(),
        "mass_kg" => "mass m".into(),
        "damping_kg_per_s" => "damping c".into(),
        "stiffness_n_per_m" => "stiffness k".into(),
        other => effect_name(other),
    }
}

/// Value with unit, and the interval.
fn amount(campaign: &Campaign, parameter: &ParameterEstimate) -> Value {
    let (factor, unit) = campaign.prepared.vocabulary.about(&parameter.unit);
    let interval = parameter.interval.map(|ends| Interval {
        low: factor * ends.low,
        high: factor * ends.high,
    });
    let shown = rounded(factor * parameter.value, interval);
    let interval = match (shown.interval, parameter.fixed) {
        (Some(interval), _) => interval,
        (None, true) => "held fixed".into(),
        (None, false) => "no interval".into(),
    };
    json!([format!("{} {}", shown.value, unit_text(&unit)), interval])
}
