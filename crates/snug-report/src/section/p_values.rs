//! The tests as tables. Methods that respect participants come first: the others give p-values that are too small.

mod assumptions;

use super::{BEYOND_CHANCE, Render, Section, headings, nothing};
use crate::grouping::{first_seen, grouped};
use crate::words::number::{fixed, measured, missing, p_value, plain};
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::{CampaignResult, EffectSize, TestRow};

/// Tests of every quantity against every factor, methods side by side.
pub const SECTION: Section = Section {
    anchor: "p-values",
    short_title: "p-values",
    title: "Do the conditions differ? p-values",
    render: Render::Always(render),
};

fn render(result: &CampaignResult) -> Markup {
    if result.tests.is_empty() {
        return nothing("No comparison was made: it takes two groups with selected tightenings.");
    }
    let methods = methods(result);
    html! {
        p {
            "p is the probability of a difference at least this large if the condition made none. Tightenings of one participant \
            resemble each other; methods that take every tightening for independent therefore give p-values that are too small. \
            The methods marked " span.respects { "per participant" } " respect this: trust those. Adjusted p (Benjamini and \
            Hochberg, over each method's column) allows for the number of comparisons; bold means adjusted p below 0.05. \
            The effect size says whether a difference matters."
        }
        p.reading { (reading(result, &methods)) }
        (assumptions::explanation(result))
        (side_by_side(result, &methods))
        details {
            summary { "Every test with its statistic, degrees of freedom and notes" }
            (in_full(result))
        }
    }
}

/// Every method with whether it respects participants: those that do first, else in order of first appearance.
fn methods(result: &CampaignResult) -> Vec<(&str, bool)> {
    let mut methods: Vec<(&str, bool)> = Vec::new();
    for row in &result.tests {
        if !methods.iter().any(|(method, _)| *method == row.method) {
            methods.push((&row.method, row.respects_participants));
        }
    }
    methods.sort_by_key(|(_, respects)| !respects);
    methods
}

fn below_level(row: &TestRow) -> bool {
    row.p_adjusted.or(row.p).is_some_and(|p| p < BEYOND_CHANCE)
}

fn reading(result: &CampaignResult, methods: &[(&str, bool)]) -> String {
    let counts: Vec<String> = methods
        .iter()
        .map(|(method, _)| {
            let rows = || {
                result
                    .tests
                    .iter()
                    .filter(|row| row.method == *method && row.p.is_some())
            };
            let below = rows().filter(|row| below_level(row)).count();
            format!("{} {below} of {}", quantity::words(method), rows().count())
        })
        .collect();
    format!(
        "Differences found at adjusted p < 0.05: {}.",
        counts.join(", ")
    )
}

fn side_by_side(result: &CampaignResult, methods: &[(&str, bool)]) -> Markup {
    let tests = result.tests.iter();
    let compared = tests.map(|row| (row.quantity.as_str(), row.factor.as_str()));
    let quantities = grouped(first_seen(compared));
    let rows = |quantity: &str, factor: &str| -> Vec<&TestRow> {
        result
            .tests
            .iter()
            .filter(|row| row.quantity == quantity && row.factor == factor)
            .collect()
    };
    html! {
        div.scroll.wide tabindex="0" role="region" aria-label="p-values" { table.tests {
            caption { "p (adjusted p) and effect size per method" }
            thead { tr {
                th scope="col" { "factor" }
                @for (method, respects) in methods {
                    th.respected[*respects] scope="col" {
                        (quantity::words(method))
                        @if *respects { " " span.respects { "per participant" } }
                    }
                }
            } }
            @for (column, factors) in &quantities {
                tbody {
                    tr.group { th colspan=(methods.len() + 1) scope="rowgroup" { (quantity::name(column, result).with_unit()) } }
                    @for factor in factors { (factor_rows(factor, &rows(column, factor), methods)) }
                }
            }
        } }
    }
}

/// A factor's tests, and below them how what they presume stands.
fn factor_rows(factor: &str, rows: &[&TestRow], methods: &[(&str, bool)]) -> Markup {
    let checked = !assumptions::checks(rows).is_empty();
    html! {
        tr.checked[checked] {
            th scope="row" rowspan=[checked.then_some(2)] { (quantity::words(factor)) }
            @for (method, respects) in methods {
                td.respected[*respects] { (cell(rows.iter().copied().find(|row| row.method == *method))) }
            }
        }
        @if checked { tr.checks { td colspan=(methods.len()) { p { (assumptions::line(rows)) } } } }
    }
}

fn cell(row: Option<&TestRow>) -> Markup {
    let Some(row) = row else {
        return missing("this method does not apply here");
    };
    let Some(p) = row.p else {
        return missing(row.note.as_deref().unwrap_or("the test could not be made"));
    };
    html! {
        span.strong[below_level(row)] { (p_value(Some(p))) }
        @if row.p_adjusted.is_some() { " " span.interval { "(" (p_value(row.p_adjusted)) ")" } }
        @if let Some(effect) = &row.effect_size { span.spread { (effect_size(effect)) } }
    }
}

fn effect_size(effect: &EffectSize) -> Markup {
    html! {
        (quantity::words(&effect.name)) " "
        @if effect.interval.is_some() { (measured(Some(effect.value), effect.interval, "the size is not finite")) }
        @else { (plain(Some(effect.value), 3, "the size is not finite")) }
    }
}

fn in_full(result: &CampaignResult) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Every test in full" { table {
            (headings(&["quantity", "factor", "method", "statistic", "degrees of freedom", "p", "adjusted p", "effect size", "note"]))
            tbody { @for row in &result.tests { (full_row(row, result)) } }
        } }
    }
}

fn full_row(row: &TestRow, result: &CampaignResult) -> Markup {
    let why = row.note.as_deref().unwrap_or("the test could not be made");
    let freedom = freedom(&row.degrees_of_freedom);
    html! { tr {
        th scope="row" { (quantity::name(&row.quantity, result).words) }
        td.words { (quantity::words(&row.factor)) }
        td.words { (quantity::words(&row.method)) }
        td { (row.statistic_name) " = " (plain(row.statistic, 4, why)) }
        td { @if freedom.is_empty() { (missing("the method has none")) } @else { (freedom) } }
        td { @if row.p.is_some() { (p_value(row.p)) } @else { (missing(why)) } }
        td { @if row.p_adjusted.is_some() { (p_value(row.p_adjusted)) } @else { (missing(why)) } }
        td { @if let Some(effect) = &row.effect_size { (effect_size(effect)) } @else { (missing("none is defined")) } }
        td.words { (row.note.as_deref().unwrap_or("")) }
    } }
}

/// `1, 44`, with a decimal where there is one.
fn freedom(degrees_of_freedom: &[f64]) -> String {
    let shown: Vec<String> = degrees_of_freedom
        .iter()
        .map(|freedom| fixed(*freedom, if freedom.fract() == 0.0 { 0 } else { 1 }))
        .collect();
    shown.join(", ")
}
