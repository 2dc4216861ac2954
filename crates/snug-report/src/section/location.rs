//! Brings every view of the misfit into one section, with the drift that a missing effect leaves in fitted values.

mod aspects;
pub(crate) mod correlation;
pub(crate) mod force;
mod force_map;
pub(crate) mod response;

use super::{BEYOND_CHANCE, Render, Section};
use crate::words::number::{measured, missing, p_value, percent};
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::{CampaignResult, Diagnosis, Drift, Location, SignalUnits};

/// Where the model fails.
pub const SECTION: Section = Section {
    anchor: "location",
    short_title: "Where it fails",
    title: "Where the model fails",
    render: Render::Diagnosed(render),
};

fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    let own = Some(&diagnosis.location).filter(|location| holds(location));
    let last = diagnosis
        .final_location
        .as_ref()
        .filter(|location| holds(location));
    if own.is_none() && last.is_none() && diagnosis.drift.is_empty() {
        return None;
    }
    Some(html! {
        @if let Some(location) = own {
            @if last.is_some() { h3 { "The study's own model" } }
            (looked_at(location, &result.units))
        }
        @if !diagnosis.drift.is_empty() { (drift(&diagnosis.drift, result)) }
        @if let Some(location) = last {
            h3 { "The final model" }
            (remarks(location))
            details {
                summary { "Every view of the final model's misfit" }
                (views(location, &result.units))
            }
        }
    })
}

/// Whether there is anything to show.
fn holds(location: &Location) -> bool {
    !location.aspects.is_empty()
        || !location.remarks.is_empty()
        || !location.force_over_time.at.is_empty()
        || !location.force_map.force_n.is_empty()
}

fn looked_at(location: &Location, units: &SignalUnits) -> Markup {
    html! { (remarks(location)) (views(location, units)) }
}

fn remarks(location: &Location) -> Markup {
    html! {
        @if !location.remarks.is_empty() { ul.reasons { @for remark in &location.remarks { li { (remark) } } } }
        @if let Some(share) = location.repeatable_share.filter(|share| share.is_finite()) {
            @if share < 0.005 { p { "Nothing of the misfit repeats from tightening to tightening." } }
            @else { p { strong { (percent(share)) } " of the squared misfit repeats: a simple law learnt from the other tightenings \
                predicts it. A missing effect can explain more than that, because its force need not follow so simple a law." } }
        }
    }
}

fn views(location: &Location, units: &SignalUnits) -> Markup {
    html! {
        (aspects::figures(&location.aspects, units))
        (force::figures(location))
        @if let Some(correlation) = &location.correlation { (correlation::figures(correlation)) }
        @if let Some(response) = &location.response { (response::figures(response, units)) }
        @else if location.correlation.is_some() { (response::none()) }
    }
}

fn drift(drifts: &[Drift], result: &CampaignResult) -> Markup {
    html! {
        h3 { "Fitted values that drift with what they should not depend on" }
        p { "A hand's stiffness must not depend on how hard the tool kicks. Where a fitted value changes with it, an effect \
            that the model lacks hides in that value. The change is over the range seen, within each participant." }
        @if drifts.iter().any(drifting) { (drift_table(drifts, result)) } @else {
            p { "Here none of them changes beyond chance." }
            details { summary { "What was tested" } (drift_table(drifts, result)) }
        }
    }
}

/// Whether the change is beyond chance, all tests together.
fn drifting(row: &Drift) -> bool {
    row.p_adjusted.is_some_and(|p| p < BEYOND_CHANCE)
}

fn drift_table(drifts: &[Drift], result: &CampaignResult) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Fitted values that drift" { table {
            thead { tr {
                @for heading in ["fitted value", "changes with"] { th.words scope="col" { (heading) } }
                th scope="col" { "by [%], 95 % interval" }
                th scope="col" { "p" }
                th scope="col" { "adjusted p" }
            } }
            tbody { @for row in drifts { tr {
                th scope="row" { (quantity::name(&row.parameter, result).words) }
                td.words { (quantity::name(&row.against, result).words) }
                td.strong[drifting(row)] {
                    (measured(Some(row.change_percent), row.interval_percent, "could not be estimated"))
                }
                td { (tested(row.p)) }
                td { (tested(row.p_adjusted)) }
            } } }
        } }
    }
}

fn tested(p: Option<f64>) -> Markup {
    match p {
        Some(p) => html! { (p_value(Some(p))) },
        None => missing("too few tightenings to test"),
    }
}
