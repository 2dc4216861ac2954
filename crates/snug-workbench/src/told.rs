//! What pages are told, as JSON: every number as text, with its unit and interval.

mod tested;
mod tightening;

use crate::campaign::Campaign;
use crate::campaign::focus::Closer;
use crate::changes::{Changes, EffectSet};
use crate::error::WorkbenchError;
use serde_json::{Value, json};
use snug_campaign::EffectParameter;
use snug_campaign::words::number::{percent, significant};
use snug_diagnose::{CloserLook, FitStep, LiveFit};
use snug_model::Effect;

pub(crate) use tested::{tested, testing};
pub(crate) use tightening::tightening;

/// That a fit is under way; a page that shows no error yet begins with that of the model to begin with.
pub(crate) fn fitting(campaign: &Campaign, number: usize, effects: &EffectSet) -> Value {
    json!({
        "kind": "fitting",
        "number": number,
        "effects": effects.names(),
        "begins": campaign.shown(campaign.base.error()),
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
        "tested": worth(campaign, fit),
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
fn worth(campaign: &Campaign, fit: &LiveFit) -> String {
    match fit.effects() == campaign.prepared.effects.as_slice() {
        true => "This is the study's own model.".into(),
        false => campaign.says("Not yet tested on tightenings it was not fitted to."),
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

/// `stiffness of the reflex 639.7 [633.4, 646.0] N/m`.
fn size(campaign: &Campaign, parameter: &EffectParameter) -> String {
    let size = campaign.prepared.vocabulary.size(parameter);
    campaign.says(&size.size().to_string())
}

/// What is looked at more closely, and what the models leave there; the present one may be the first.
pub(crate) fn closer(
    campaign: &Campaign,
    closer: &Closer,
    look: &CloserLook,
    is_base: bool,
) -> Value {
    let says = closer.says(campaign).unwrap_or_default();
    let [base, now] = look.errors().map(|error| campaign.shown(error));
    let errors = match is_base {
        true => now,
        false => format!("{base} → {now}"),
    };
    let worth = match closer.is_of_a_part() {
        true => format!(
            "Promises count in these {} samples, in the size that whole windows predict.",
            look.samples()
        ),
        false => "Promises count there.".to_owned(),
    };
    let sentence = format!(
        "A closer look at {says}: error {errors} {}. {worth}",
        campaign.error_unit
    );
    json!({ "kind": "closer", "sentence": campaign.says(&sentence) })
}

/// How many tightenings would be selected with the model to begin with, and with the present one.
pub(crate) fn usable(campaign: &Campaign, before: usize, now: usize) -> Value {
    let all = campaign.prepared.live.tasks().len();
    let sentence = match before == now {
        true => format!("usable tightenings: {now} of {all}"),
        false => format!("usable tightenings: {before} → {now} of {all}"),
    };
    json!({ "kind": "usable", "sentence": campaign.says(&sentence) })
}

/// What came of a fit from numbers that were set by hand.
pub(crate) fn from_here(
    campaign: &Campaign,
    before: &LiveFit,
    fit: &LiveFit,
    is_lower: bool,
) -> Value {
    let (was, is) = (campaign.shown(before.error()), campaign.shown(fit.error()));
    let sentence = match is_lower {
        true => format!("From here the fit ends lower: {was} → {is}."),
        false if was == is => "From here the fit ends where it ended before.".to_owned(),
        false => {
            format!("From here the fit ends at {is}, above {was}: what was there before is kept.")
        }
    };
    json!({ "kind": "from_here", "sentence": sentence })
}
