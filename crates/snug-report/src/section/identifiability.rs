//! Whether data or constraints decided the estimates: how fits ended, interval widths, correlations, noise sources.

use super::{Render, Section, headings, nothing};
use crate::grouping::grouped;
use crate::quartiles::Quartiles;
use crate::tables::json;
use crate::words::number::{fixed, missing, percent, share, short, significant};
use crate::words::outcome::{STATUSES, status_meaning};
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::{CampaignResult, Estimate, Interval, NoiseSource};
use std::collections::BTreeMap;

/// How identifications ended and how well the data determine the parameters.
pub const SECTION: Section = Section {
    anchor: "identifiability",
    short_title: "Identifiability",
    title: "How sure the estimates are",
    render: Render::Always(render),
};

fn render(result: &CampaignResult) -> Markup {
    let estimates: Vec<&Estimate> = result
        .tightenings
        .iter()
        .filter_map(|tightening| tightening.estimate.as_ref())
        .collect();
    if estimates.is_empty() {
        return nothing("No tightening allowed an identification.");
    }
    let without = result.tightenings.len() - estimates.len();
    html! {
        @if without > 0 { p { (without) " of " (result.tightenings.len()) " tightenings allowed no identification." } }
        div.columns {
            (statuses(&estimates))
            (constraints(&estimates))
        }
        (certainty(&estimates, result))
        (correlations(&estimates, result))
        p { (effort(&estimates)) }
        p { (noise(result)) }
    }
}

fn statuses(estimates: &[&Estimate]) -> Markup {
    html! { div.scroll tabindex="0" role="region" aria-label="How identifications ended" { table {
        caption { "How identifications ended" }
        thead { tr { th scope="col" { "status" } th scope="col" { "tightenings" } th.words scope="col" { "meaning" } } }
        tbody { @for status in STATUSES {
            @let count = estimates.iter().filter(|estimate| estimate.status == status).count();
            @if count > 0 { tr {
                th scope="row" { (json::name(status).replace('_', " ")) }
                td { (count) " (" (percent(share(count, estimates.len()).unwrap_or(f64::NAN))) ")" }
                td.words { (status_meaning(status)) }
            } }
        } }
    } } }
}

fn constraints(estimates: &[&Estimate]) -> Markup {
    let mut active: BTreeMap<&str, usize> = BTreeMap::new();
    for name in estimates
        .iter()
        .flat_map(|estimate| &estimate.active_constraints)
    {
        *active.entry(name).or_default() += 1;
    }
    html! {
        @if active.is_empty() {
            p { "No constraint is active: every estimate is the data's free choice." }
        } @else {
            div.scroll tabindex="0" role="region" aria-label="Active constraints" { table {
                caption { "Constraints that decided instead of the data" }
                (headings(&["active constraint", "tightenings"]))
                tbody { @for (name, count) in active { tr {
                    th scope="row" { (name.replace('_', " ")) }
                    td { (count) " (" (percent(share(count, estimates.len()).unwrap_or(f64::NAN))) ")" }
                } } }
            } }
        }
    }
}

/// Half the interval in percent of the value, per parameter.
fn certainty(estimates: &[&Estimate], result: &CampaignResult) -> Markup {
    let parameters = estimates.iter().flat_map(|estimate| &estimate.parameters);
    let widths = grouped(parameters.map(|parameter| {
        let width =
            |interval: Interval| 50.0 * (interval.high - interval.low) / parameter.value.abs();
        (parameter.name.as_str(), parameter.interval.map(width))
    }));
    html! { div.scroll tabindex="0" role="region" aria-label="Widths of the intervals" { table {
        caption { "Half the 95 % interval in percent of the value" }
        (headings(&["parameter", "tightenings with interval", "median [%]", "middle half [%]", "widest [%]"]))
        tbody { @for (name, values) in &widths {
            @let spread = Quartiles::of(values.iter().flatten().copied());
            tr {
                th scope="row" { (quantity::name(name, result).words) }
                td { (values.iter().flatten().count()) " of " (estimates.len()) }
                @if let Some(spread) = spread {
                    td { (significant(spread.median, 2)) }
                    td { (significant(spread.low, 2)) " to " (significant(spread.high, 2)) }
                    td { (significant(spread.maximum, 2)) }
                } @else {
                    @for _ in 0..3 { td { (missing("no tightening has an interval: fixed, or at a constraint")) } }
                }
            }
        } }
    } } }
}

/// Which pair of parameters is most correlated, and how strongly.
fn correlations(estimates: &[&Estimate], result: &CampaignResult) -> Markup {
    let mut pairs: BTreeMap<(&str, &str), Vec<f64>> = BTreeMap::new();
    for (first, second, correlation) in estimates
        .iter()
        .filter_map(|estimate| estimate.identifiability.strongest_correlation.as_ref())
    {
        pairs.entry((first, second)).or_default().push(*correlation);
    }
    html! { @if !pairs.is_empty() {
        div.scroll tabindex="0" role="region" aria-label="Most correlated parameters" { table {
            caption { "The most correlated pair of parameters: near ±1 the data cannot tell the two apart" }
            (headings(&["pair", "tightenings", "correlation, median", "from", "to"]))
            tbody { @for ((first, second), values) in &pairs {
                @let spread = Quartiles::of(values.iter().copied());
                tr {
                    th scope="row" { (quantity::name(first, result).words) " and " (quantity::name(second, result).words) }
                    td { (values.len()) }
                    @if let Some(spread) = spread {
                        td { (fixed(spread.median, 3)) } td { (fixed(spread.minimum, 3)) } td { (fixed(spread.maximum, 3)) }
                    } @else {
                        @for _ in 0..3 { td { (missing("not finite")) } }
                    }
                }
            } }
        } }
    } }
}

fn effort(estimates: &[&Estimate]) -> String {
    let deficient = estimates
        .iter()
        .filter(|estimate| estimate.identifiability.rank < estimate.identifiability.free)
        .count();
    let condition = Quartiles::of(
        estimates
            .iter()
            .map(|estimate| estimate.identifiability.condition),
    );
    let iterations = Quartiles::of(estimates.iter().map(|estimate| estimate.iterations as f64));
    let conic: usize = estimates.iter().map(|estimate| estimate.conic_solves).sum();
    let shown = |spread: Option<Quartiles>| match spread {
        Some(spread) => format!(
            "{} (largest {})",
            short(spread.median),
            short(spread.maximum)
        ),
        None => crate::words::number::DASH.into(),
    };
    format!(
        "{deficient} of {} estimates lack full rank; condition number of the scaled sensitivities {}; iterations {}; \
         conic programs solved {conic}.",
        estimates.len(),
        shown(condition),
        shown(iterations)
    )
}

fn noise(result: &CampaignResult) -> String {
    let sources = [
        (NoiseSource::PreRoll, "measured in the quiet part"),
        (NoiseSource::Repeats, "from repeated tightenings"),
        (NoiseSource::Declared, "declared in the study"),
        (
            NoiseSource::Residual,
            "taken from the fit's own residual, which cannot tell lack of fit from noise",
        ),
    ];
    let count = |source| {
        result
            .tightenings
            .iter()
            .filter(|tightening| tightening.noise.as_ref().map(|noise| noise.source) == source)
            .count()
    };
    let mut parts: Vec<String> = sources
        .into_iter()
        .map(|(source, words)| (count(Some(source)), words))
        .filter(|(count, _)| *count > 0)
        .map(|(count, words)| format!("{words} for {count}"))
        .collect();
    if count(None) > 0 {
        parts.push(format!("unknown for {}", count(None)));
    }
    format!("Noise floor: {} tightenings.", parts.join("; "))
}
