//! One tightening under the models that are looked at.

use crate::campaign::Campaign;
use serde_json::{Value, json};
use snug_campaign::words::effect_name::{effect_name, unit_text};
use snug_campaign::words::number::rounded;
use snug_campaign::{Interval, ParameterEstimate};
use snug_diagnose::{ByHand, Derived, HandNumber, LiveFit, LiveTightening};
use snug_model::{Effect, Law};

/// One tightening in words: heading, and m, c, k under the model before, under the present one and under a rival; the numbers that
/// can be set by hand.
pub(crate) fn tightening(
    campaign: &Campaign,
    member: usize,
    models: [(&LiveFit, &LiveTightening); 2],
    rival: Option<(&LiveFit, &LiveTightening)>,
    by_hand: Option<&ByHand>,
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
    let columns: Vec<&LiveTightening> = [Some(before), Some(now), rival]
        .into_iter()
        .flatten()
        .map(|(_, seen)| seen)
        .collect();
    let row = |name: &str, amount: &dyn Fn(&LiveTightening) -> Value| -> Value {
        let amounts = columns.iter().map(|seen| amount(seen));
        std::iter::once(name.into()).chain(amounts).collect()
    };
    let base = now.1.base.iter().enumerate();
    let mut facts: Vec<Value> = base
        .map(|(place, parameter)| {
            let name = base_name(campaign, parameter);
            row(&name, &|seen| amount(campaign, &seen.base[place]))
        })
        .collect();
    facts.push(row("rings at", &|seen| pole(seen.rings_at_hz, "Hz")));
    facts.push(row("damping ratio ζ", &|seen| {
        pole(seen.damping_ratio, "")
    }));
    let error = |fit: &LiveFit| campaign.shown(fit.errors()[member]);
    let interval_s = campaign.prepared.live.tasks()[member]
        .tightening
        .time_base
        .interval_s;
    let place = campaign.worst_first.iter().position(|&one| one == member);
    json!({
        "number": member + 1,
        "heading": heading.join(" · "),
        "place": format!("{} of {}, worst first", place.map_or(0, |place| place + 1), campaign.worst_first.len()),
        "error_before": error(before.0),
        "error": error(now.0),
        "facts": facts,
        "interval_s": interval_s,
        "rival": rival.map(|(fit, _)| json!({
            "error": campaign.shown(fit.error()),
            "error_here": error(fit),
            "sizes": sizes(campaign, fit),
        })),
        "numbers": now.1.numbers.iter().map(|number| by_hand_number(campaign, number)).collect::<Vec<_>>(),
        "by_hand": by_hand.map(|by_hand| campaign.shown(by_hand.error)),
    })
}

/// A number of the pair of poles, and its interval.
fn pole(derived: Option<Derived>, unit: &str) -> Value {
    let Some(Derived { value, interval }) = derived else {
        return json!(["–", ""]);
    };
    let shown = rounded(value, interval);
    let interval = shown.interval.unwrap_or_else(|| "no interval".into());
    json!([format!("{} {unit}", shown.value).trim_end(), interval])
}

/// Every size of a model's effects, in words.
fn sizes(campaign: &Campaign, fit: &LiveFit) -> Vec<String> {
    let all = fit.sizes().iter().flat_map(|(_, sizes)| sizes);
    all.map(|size| super::size(campaign, size)).collect()
}

/// A number that can be set: what it is, its value and range as the model counts, and what to multiply with to show it.
fn by_hand_number(campaign: &Campaign, number: &HandNumber) -> Value {
    let (factor, unit) = unit_of(campaign, &number.name, &number.unit);
    let name = match number.effect {
        None => named(campaign, &number.name, &number.unit),
        Some(effect) => meaning(campaign, effect, &number.name),
    };
    let interval = number
        .interval
        .map(|interval| [interval.low, interval.high]);
    json!({
        "name": name,
        "unit": unit_text(&unit),
        "factor": factor,
        "value": number.value,
        "low": number.range.start(),
        "high": number.range.end(),
        "interval": interval,
    })
}

/// What a size of an effect means, in the words of the rig.
fn meaning(campaign: &Campaign, effect: Effect, name: &str) -> String {
    let specs = effect.description().parameters.iter();
    let mut found = specs.filter(|spec| name.ends_with(spec.name));
    let meaning = found.next().map_or(name, |spec| spec.meaning);
    let effect = effect_name(effect.name());
    match meaning.contains(effect.as_str()) {
        true => campaign.says(meaning),
        false => campaign.says(&format!("{effect}: {meaning}")),
    }
}

/// `mass m`; of what turns, `inertia I`.
fn base_name(campaign: &Campaign, parameter: &ParameterEstimate) -> String {
    named(campaign, &parameter.name, &parameter.unit)
}

fn named(campaign: &Campaign, name: &str, unit: &str) -> String {
    let (_, unit) = campaign.prepared.vocabulary.about(unit);
    match name {
        "mass_kg" if unit == "kg m^2" => "inertia I".into(),
        "mass_kg" => "mass m".into(),
        "damping_kg_per_s" => "damping c".into(),
        "stiffness_n_per_m" => "stiffness k".into(),
        other => effect_name(other),
    }
}

/// By what a number is multiplied to be shown, and in which unit: of m, c and k on a rig of volts that of its own signals.
fn unit_of(campaign: &Campaign, name: &str, unit: &str) -> (f64, String) {
    let of_signals = campaign.prepared.units.base_parameter(name);
    of_signals.map_or_else(
        || campaign.prepared.vocabulary.about(unit),
        |unit| (1.0, unit),
    )
}

/// Value with unit, and the interval.
fn amount(campaign: &Campaign, parameter: &ParameterEstimate) -> Value {
    let (factor, unit) = unit_of(campaign, &parameter.name, &parameter.unit);
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
