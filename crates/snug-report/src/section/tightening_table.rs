//! The table to look single tightenings up in; the page's script sorts and filters it by its `data-` attributes.

use super::{Render, Section, nothing};
use crate::curves::traces_json::examples;
use crate::tables::tightenings_csv::{BASE_PARAMETERS, effect_parameters};
use crate::words::number::{between, measured, missing, short, sort_key, sortable};
use crate::words::outcome::outcome_words;
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::{CampaignResult, TighteningResult};
use std::collections::HashMap;

/// Every tightening with its estimate, to sort and filter.
pub const SECTION: Section = Section {
    anchor: "tightenings",
    short_title: "Tightenings",
    title: "Every tightening",
    render: Render::Always(render),
};

fn render(result: &CampaignResult) -> Markup {
    if result.tightenings.is_empty() {
        return nothing("There is none.");
    }
    let mut parameters: Vec<&str> = BASE_PARAMETERS.to_vec();
    parameters.extend(effect_parameters(result));
    // A rig that is driven by something else has no target torque.
    let torque = result.units.input_is_torque();
    let drawn: HashMap<usize, usize> = examples(result)
        .iter()
        .enumerate()
        .map(|(number, example)| (example.tightening, number))
        .collect();
    html! {
        p { "Values with 95 % intervals. A name that is a link leads to the tightening's curves. tightenings.csv holds every digit." }
        div.filters.scripted {
            label { "Filter " input type="search" data-filter="" placeholder="file, participant, QS, poor fit …"; }
            label { "Show "
                select data-outcome="" {
                    option value="" { "all" }
                    option value="yes" { "selected" }
                    option value="no" { "rejected" }
                }
            }
            span.note data-shown="" aria-live="polite" {}
        }
        div.scroll.wide.tall tabindex="0" role="region" aria-label="Every tightening" { table.sortable data-sortable="" {
            thead { tr {
                @for heading in ["tightening", "outcome", "participant", "strategy", "joint"] { th.words scope="col" { (heading) } }
                th scope="col" { "pace [1/min]" }
                @if torque { th scope="col" { "target [Nm]" } }
                @for parameter in &parameters { th scope="col" { (quantity::name(parameter, result).with_unit()) } }
                @for heading in ["fₙ [Hz]", "fit [%]", "error over noise"] { th scope="col" { (heading) } }
            } }
            tbody {
                @for (index, tightening) in result.tightenings.iter().enumerate() {
                    (row(tightening, &parameters, drawn.get(&index).copied(), torque))
                }
            }
        } }
    }
}

fn row(
    tightening: &TighteningResult,
    parameters: &[&str],
    drawn: Option<usize>,
    torque: bool,
) -> Markup {
    let conditions = &tightening.conditions;
    let measures = &tightening.measures;
    let selected = tightening.selection.selected();
    let frequency = measures.natural_frequency_hz;
    let ends = between(
        measures.natural_frequency_low_hz,
        measures.natural_frequency_high_hz,
    );
    html! { tr data-selected=(if selected { "yes" } else { "no" }) {
        th scope="row" {
            @match drawn {
                Some(example) => a href="#tightening-figures" data-example=(example) { (tightening.id) },
                None => (tightening.id),
            }
        }
        td.words.good[selected].bad[!selected] { (outcome_words(&tightening.selection.rejections)) }
        @for word in [&conditions.participant, &conditions.strategy, &conditions.joint] {
            td.words { @if let Some(word) = word { (word) } @else { (missing("the file does not say")) } }
        }
        td data-v=[sort_key(conditions.pace_per_min)] { (setting(conditions.pace_per_min)) }
        @if torque {
            td data-v=[sort_key(Some(tightening.target_torque_nm))] { (setting(Some(tightening.target_torque_nm))) }
        }
        @for name in parameters { (parameter(tightening, name)) }
        td data-v=[sort_key(frequency)] { (measured(frequency, ends, "needs a positive mass and stiffness")) }
        (sortable(measures.fit_percent, 4, "no simulation to compare with"))
        (sortable(measures.error_over_noise, 4, "no noise floor or no fit"))
    } }
}

fn parameter(tightening: &TighteningResult, name: &str) -> Markup {
    let Some(estimate) = &tightening.estimate else {
        return html! { td { (missing("the data did not allow an identification")) } };
    };
    let Some(parameter) = estimate.parameter(name) else {
        return html! { td { (missing("not a parameter of this model")) } };
    };
    html! {
        td data-v=[sort_key(Some(parameter.value))] {
            (measured(Some(parameter.value), parameter.interval, "not finite"))
            @if parameter.fixed { " " span.interval { "fixed" } }
            @else if parameter.interval.is_none() { " " span.interval { "no interval" } }
        }
    }
}

fn setting(value: Option<f64>) -> Markup {
    match value.filter(|value| value.is_finite()) {
        Some(value) => html! { (short(value)) },
        None => missing("the file does not say"),
    }
}
