//! The page's opening: the outcome in one sentence, key numbers, and a warning where data were left out or changed.

use super::{Render, Section, findings_of, fitted};
use crate::quartiles::Quartiles;
use crate::words::effect_words::sentence;
use crate::words::number::{
    fixed, missing, percent, percent_interval, plain, rounded, share, short,
};
use crate::words::quantity;
use crate::words::quantity::capitalised;
use maud::{Markup, html};
use snug_campaign::words::counted;
use snug_campaign::words::effect_name::effect_name;
use snug_campaign::words::program::program;
use snug_campaign::{
    CampaignResult, ConditionSummary, Conditions, FitMeasures, QuantitySummary, Severity,
    TighteningResult,
};
use std::collections::BTreeSet;

/// What was measured, what came out, the key numbers.
pub const SECTION: Section = Section {
    anchor: "overview",
    short_title: "Overview",
    title: "What was measured and what came out",
    render: Render::Always(render),
};

fn render(result: &CampaignResult) -> Markup {
    let verdict = result.diagnosis.as_ref();
    html! {
        @if let Some(found) = verdict {
            p.lead { span.verdict.(found.verdict.name()) { (found.word()) } " " (sentence(&found.headline)) }
        }
        p.lead[verdict.is_none()] { (outcome(result)) }
        p { (measured(result)) }
        (key_numbers(result))
        (attention(result))
    }
}

/// The result in one sentence a manager can repeat.
fn outcome(result: &CampaignResult) -> String {
    let all = fitted(result).count();
    let kept = result.tightenings.len() - all;
    let mut text = match all {
        0 if kept == 0 => {
            "No tightening was found in the data, so there is nothing to evaluate.".into()
        }
        0 => "No tightening was fitted.".into(),
        _ => usable(result, all),
    };
    if kept > 0 {
        text += &format!(
            " {} kept for validation, simulated with the parameters of the others.",
            if kept == 1 {
                "1 was".into()
            } else {
                format!("{kept} were")
            }
        );
    }
    text
}

fn usable(result: &CampaignResult, all: usize) -> String {
    let selected = selected(result).count();
    let share = percent(share(selected, all).unwrap_or(f64::NAN));
    let model = model_words(result);
    if selected == 0 {
        return format!(
            "None of {} could be used with {model}.",
            counted(all, "tightening")
        );
    }
    let agreement = match error_over_noise(result) {
        // The verdict, right above, judges all tightenings together, and is the better judge.
        Some(ratio) if result.diagnosis.is_some() => format!(
            "in half of them the model leaves {} times the measurement noise or less",
            fixed(ratio, 2)
        ),
        Some(ratio) if ratio <= 1.1 => format!(
            "what the model leaves unexplained there is hardly more than the measurement noise ({} times); whether a faint \
             effect hides in it, “{} diagnose” tells",
            fixed(ratio, 2),
            program()
        ),
        Some(ratio) if ratio <= 2.0 => format!(
            "there the model misses the measurement by {} times the noise: a small part of the motion is unexplained",
            fixed(ratio, 2)
        ),
        Some(ratio) => format!(
            "yet even there the model misses the measurement by {} times the noise: an effect is missing from the model, \
             or an error sits in the data",
            fixed(ratio, 1)
        ),
        None => {
            "how far the rest is noise could not be judged, because no noise floor is known".into()
        }
    };
    format!(
        "{selected} of {} ({share}) are usable with {model}; {agreement}.",
        counted(all, "tightening")
    )
}

fn model_words(result: &CampaignResult) -> String {
    let base = if result.units.mechanical() {
        "the damped mass–spring model of the hand and arm"
    } else {
        "the damped mass–spring model"
    };
    if result.effects.is_empty() {
        return base.into();
    }
    let effects: Vec<String> = result
        .effects
        .iter()
        .map(|effect| effect_name(effect))
        .collect();
    format!("{base} plus {}", effects.join(", "))
}

fn measured(result: &CampaignResult) -> String {
    let files: BTreeSet<&str> = result
        .tightenings
        .iter()
        .map(|tightening| tightening.id.file.as_str())
        .collect();
    let mut text = format!(
        "{} in {}",
        counted(result.tightenings.len(), "tightening"),
        counted(files.len(), "file")
    );
    let participants = levels(result, |conditions| conditions.participant.clone());
    if !participants.is_empty() {
        text += &format!(", by {}", counted(participants.len(), "participant"));
    }
    for (word, levels) in [
        ("strategy", levels(result, |c| c.strategy.clone())),
        ("joint", levels(result, |c| c.joint.clone())),
    ] {
        if !levels.is_empty() {
            text += &format!("; {word} {}", levels.join(", "));
        }
    }
    let paces = numbers(
        result
            .tightenings
            .iter()
            .filter_map(|t| t.conditions.pace_per_min),
    );
    if !paces.is_empty() {
        text += &format!("; {} per minute", paces.join(", "));
    }
    // Without a pulse there is no target: its torque rounds to zero.
    let pulses = result.tightenings.iter().map(|t| t.target_torque_nm);
    let targets = numbers(pulses.filter(|target| *target != 0.0));
    if !targets.is_empty() && result.units.input_is_torque() {
        text += &format!("; target torque {} Nm", targets.join(", "));
    }
    format!(
        "{text}. Preset {}; fitted output: {}.",
        result.preset, result.fitted_output
    )
}

fn levels(result: &CampaignResult, read: fn(&Conditions) -> Option<String>) -> Vec<String> {
    let levels: BTreeSet<String> = result
        .tightenings
        .iter()
        .filter_map(|tightening| read(&tightening.conditions))
        .collect();
    levels.into_iter().collect()
}

fn numbers(values: impl Iterator<Item = f64>) -> Vec<String> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values.into_iter().map(short).collect()
}

fn selected(result: &CampaignResult) -> impl Iterator<Item = &TighteningResult> {
    let tightenings = result.tightenings.iter();
    tightenings.filter(|tightening| tightening.selection.selected())
}

/// Median and quartiles of a measure over the selected tightenings.
fn spread(result: &CampaignResult, read: fn(&FitMeasures) -> Option<f64>) -> Option<Quartiles> {
    Quartiles::of(selected(result).filter_map(|tightening| read(&tightening.measures)))
}

fn error_over_noise(result: &CampaignResult) -> Option<f64> {
    spread(result, |measures| measures.error_over_noise).map(|quartiles| quartiles.median)
}

struct Card {
    name: String,
    value: Markup,
    unit: String,
    note: String,
}

fn key_numbers(result: &CampaignResult) -> Markup {
    let mut cards = vec![share_card(result)];
    cards.push(measure_card(
        "Fit of the displacement",
        "%",
        spread(result, |measures| measures.fit_percent),
        1,
    ));
    cards.push(measure_card(
        "Error over noise",
        "× noise",
        spread(result, |measures| measures.error_over_noise),
        2,
    ));
    for row in everything(result)
        .iter()
        .flat_map(|summary| &summary.quantities)
    {
        cards.push(quantity_card(row, result));
    }
    html! {
        dl.cards {
            @for card in cards {
                div.card {
                    dt { (card.name) }
                    dd { span.value { (card.value) } " " span.unit { (card.unit) } }
                    dd.note { (card.note) }
                }
            }
        }
    }
}

/// The summary over all tightenings together.
fn everything(result: &CampaignResult) -> Option<&ConditionSummary> {
    let mut summaries = result.conditions.iter();
    summaries.find(|summary| summary.factor == "all")
}

fn share_card(result: &CampaignResult) -> Card {
    let (selected, all) = (selected(result).count(), fitted(result).count());
    let interval = everything(result).and_then(|summary| summary.selected_share_interval);
    Card {
        name: "Selected".into(),
        value: plain(
            share(selected, all).map(|share| 100.0 * share),
            3,
            "no tightenings",
        ),
        unit: "%".into(),
        note: match interval {
            Some(interval) => format!(
                "{selected} of {all}; 95 % interval {}",
                percent_interval(interval)
            ),
            None => format!("{selected} of {all}"),
        },
    }
}

fn measure_card(name: &str, unit: &str, spread: Option<Quartiles>, decimals: i32) -> Card {
    let why = "no selected tightening has this measure";
    Card {
        name: format!("{name}, median"),
        value: match spread {
            Some(spread) => html! { (fixed(spread.median, decimals)) },
            None => missing(why),
        },
        unit: unit.into(),
        note: match spread {
            Some(spread) => format!(
                "middle half of the tightenings {} to {} {unit}",
                fixed(spread.low, decimals),
                fixed(spread.high, decimals)
            ),
            None => why.into(),
        },
    }
}

fn quantity_card(row: &QuantitySummary, result: &CampaignResult) -> Card {
    let name = quantity::name(&row.quantity, result);
    let why = "no selected tightening";
    let mean = row
        .selected
        .as_ref()
        .filter(|moments| moments.mean.is_finite())
        .map(|moments| rounded(moments.mean, moments.mean_interval));
    Card {
        name: capitalised(&format!("{} {}", name.words, name.symbol))
            .trim_end()
            .to_string()
            + ", mean",
        value: match &mean {
            Some(mean) => html! { (mean.value) },
            None => missing(why),
        },
        unit: name.unit,
        note: match mean {
            Some(mean) => mean.interval.map_or_else(
                || "no interval from one tightening".into(),
                |interval| format!("95 % interval {interval}"),
            ),
            None => why.into(),
        },
    }
}

/// What a reader must not miss: data that were left out.
fn attention(result: &CampaignResult) -> Markup {
    let left_out = findings_of(result, Severity::LeftOut);
    let repaired = findings_of(result, Severity::Repaired);
    html! {
        @if left_out + repaired > 0 {
            p.attention {
                (counted(left_out, "finding")) " left data out and " (counted(repaired, "finding"))
                " changed data: " a href="#findings" { "what and why" } "."
            }
        }
    }
}
