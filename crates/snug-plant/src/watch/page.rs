//! `watch.html`: what changed, worst first; every tool in a line; and the way down to one tightening.

mod figures;

use super::curve::Curve;
use super::daily::By;
use super::quantities::{Quantities, Quantity};
use super::summary::{Found, Judged, JudgedSeries, QuantityFound, Watched};
use figures::{curves_figure, strip};
use maud::{Markup, PreEscaped, html};
use snug_campaign::words::capitalised;
use snug_campaign::words::effect_name::effect_name;
use snug_campaign::words::number::significant;
use snug_report::viewer::document;

const STYLE: &str = include_str!("assets/watch.css");
const SCRIPT: &str = include_str!("assets/watch.js");

/// Digits of a shown value.
const DIGITS: i32 = 3;

/// Quantities of a tool that are drawn: those that changed first.
const MOST_STRIPS: usize = 6;

/// The page.
pub fn page(
    judged: &Judged,
    watched: &Watched,
    quantities: &Quantities,
    curves: &[Curve],
) -> String {
    let body = html! {
        a.skip href="#changed" { "Skip to what changed" }
        main.plant {
            header.top {
                p.kind { "Snug plant" }
                h1 { (headline(watched)) }
                p.lead { (lead(watched)) }
            }
            section id="changed" aria-labelledby="changed-title" {
                h2 id="changed-title" { "What changed or differs, worst first" }
                @if watched.tools.is_empty() && watched.joints_and_stations.is_empty() {
                    p { "Nothing." }
                }
                @for found in &watched.tools { (card(judged, quantities, found, curves)) }
                @if !watched.joints_and_stations.is_empty() {
                    h3 { "Joints and stations" }
                    @for found in &watched.joints_and_stations { (card(judged, quantities, found, &[])) }
                }
            }
            (every_tool(judged, watched, quantities))
            (method(watched))
        }
        script { (PreEscaped(SCRIPT)) }
    };
    document("Snug plant", STYLE, &body).into_string()
}

fn headline(watched: &Watched) -> String {
    let changed = watched
        .tools
        .iter()
        .filter(|found| found.since.is_some())
        .count();
    let all = watched.tools.len() + watched.quiet_tools;
    match changed {
        0 => format!("No tool of {all} changed"),
        1 => format!("1 tool of {all} changed"),
        some => format!("{some} tools of {all} changed"),
    }
}

fn lead(watched: &Watched) -> String {
    let told = watched.tools.iter().filter(|found| found.since.is_some());
    let each = told
        .take(6)
        .map(|found| match (&found.effect, &found.since) {
            (Some(effect), Some(since)) => {
                format!("{}: {} since {since}", found.name, effect_name(effect))
            }
            (_, since) => {
                let what = found
                    .changed
                    .first()
                    .map_or("", |first| first.name.as_str());
                format!(
                    "{}: {what} since {}",
                    found.name,
                    since.as_deref().unwrap_or("?")
                )
            }
        });
    let text = each.collect::<Vec<_>>().join(" · ");
    match text.is_empty() {
        true => "Nothing is told of any tool's days beyond chance.".to_owned(),
        false => text,
    }
}

/// A group that changed or differs.
fn card(judged: &Judged, quantities: &Quantities, found: &Found, curves: &[Curve]) -> Markup {
    let by = By::ALL.into_iter().find(|by| by.column() == found.by);
    let mut own: Vec<&JudgedSeries> =
        by.map_or_else(Vec::new, |by| judged.of_group(by, &found.name).collect());
    own.sort_by(|one, other| {
        (other.is_changed, other.shift())
            .partial_cmp(&(one.is_changed, one.shift()))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let curve = curves.iter().find(|curve| curve.tool == found.name);
    html! {
        article.card id=(format!("{}-{}", found.by, found.name)) {
            h3 { (found.by) " " (found.name) }
            p.says { (sentence(found)) }
            div.strips {
                @for one in own.iter().take(MOST_STRIPS) {
                    @if let Some(known) = quantities.named(&one.series.column) {
                        figure {
                            figcaption { (with_unit(&known.name, &known.unit)) }
                            (strip(one, 250.0, 84.0))
                        }
                    }
                }
            }
            (told(&found.changed, &found.differs_from_sisters))
            @if let Some(curve) = curve {
                details {
                    summary { "One tightening: " (curve.id) ", " (curve.day) ", error " (significant(curve.error_over_noise, DIGITS)) " times the noise" }
                    p.note { "The one since the change that its model explains worst; its key in the dataset is " code { (curve.key) } "." }
                    (curves_figure(curve))
                }
            }
        }
    }
}

fn sentence(found: &Found) -> String {
    let since = found.since.as_deref();
    match (&found.effect, since, found.changed.first()) {
        (Some(effect), Some(since), _) => {
            format!(
                "{} has changed since {since}.",
                capitalised(&effect_name(effect))
            )
        }
        (None, Some(since), Some(first)) => format!(
            "{} has changed since {since}. No effect of the model did: fit with effects, or improve on this tool's days, to name it.",
            capitalised(&first.name)
        ),
        _ => "Differs from its sisters; when it began is not among these days.".to_owned(),
    }
}

fn with_unit(name: &str, unit: &str) -> String {
    match unit.is_empty() {
        true => name.to_owned(),
        false => format!("{name} [{unit}]"),
    }
}

fn told(changed: &[QuantityFound], differs: &[QuantityFound]) -> Markup {
    let number = |value: Option<f64>| {
        value.map_or_else(|| "–".to_owned(), |value| significant(value, DIGITS))
    };
    let interval = |one: &QuantityFound| match (one.now_low, one.now_high) {
        (Some(low), Some(high)) => {
            format!(
                " ({} to {})",
                significant(low, DIGITS),
                significant(high, DIGITS)
            )
        }
        _ => String::new(),
    };
    let mut rows: Vec<&QuantityFound> = changed.iter().collect();
    rows.extend(
        differs
            .iter()
            .filter(|one| changed.iter().all(|other| other.column != one.column)),
    );
    html! {
        table {
            thead { tr { th { "quantity" } th { "since" } th { "before" } th { "now (95 % interval over days)" } th { "sisters" } th { "p of the change" } th { "p beside sisters" } } }
            tbody {
                @for one in rows {
                    tr {
                        td { (with_unit(&one.name, &one.unit)) }
                        td { (one.since.as_deref().unwrap_or("–")) }
                        td.number { (number(one.before)) }
                        td.number { (significant(one.now, DIGITS)) (interval(one)) }
                        td.number { (number(one.sisters)) }
                        td.number { (probability(one.change_p_adjusted)) }
                        td.number { (probability(one.sisters_p_adjusted)) }
                    }
                }
            }
        }
    }
}

fn probability(p: Option<f64>) -> String {
    match p {
        None => "–".to_owned(),
        Some(p) if p < 1e-4 => "< 0.0001".to_owned(),
        Some(p) => significant(p, 2),
    }
}

/// Every tool in a line: the error over its days, and where its quantities are now.
fn every_tool(judged: &Judged, watched: &Watched, quantities: &Quantities) -> Markup {
    let rank = |tool: &str| watched.tools.iter().position(|found| found.name == tool);
    let mut tools: Vec<&JudgedSeries> = (judged.all.iter())
        .filter(|one| one.series.by == By::Tool && one.series.column == quantities.0[0].column)
        .collect();
    tools.sort_by(|one, other| {
        let place = |series: &JudgedSeries| rank(&series.series.group).unwrap_or(usize::MAX);
        let level = other.level.mean.total_cmp(&one.level.mean);
        place(one).cmp(&place(other)).then(level)
    });
    html! {
        section id="tools" aria-labelledby="tools-title" {
            h2 id="tools-title" { "Every tool" }
            p { label { "Only tools whose name contains " input type="search" data-filter=""; } }
            table.tools {
                thead { tr {
                    th { "tool" } th { "days" } th { "error over noise, day by day" }
                    @for quantity in &quantities.0 { th { (with_unit(&quantity.name, &quantity.unit)) } }
                } }
                tbody {
                    @for one in tools { (tool_row(judged, quantities, one, rank(&one.series.group).is_some())) }
                }
            }
        }
    }
}

fn tool_row(
    judged: &Judged,
    quantities: &Quantities,
    error: &JudgedSeries,
    is_found: bool,
) -> Markup {
    let tool = &error.series.group;
    let of = |quantity: &Quantity| {
        let mut own = judged.of_group(By::Tool, tool);
        own.find(|one| one.series.column == quantity.column)
    };
    html! {
        tr data-tool=(tool) {
            th scope="row" {
                @if is_found { a href=(format!("#tool-{tool}")) { (tool) } } @else { (tool) }
            }
            td.number { (error.series.days.len()) }
            td { (strip(error, 160.0, 26.0)) }
            @for quantity in &quantities.0 {
                @match of(quantity) {
                    Some(one) => td.number.alarm[one.is_changed || one.differs] { (significant(one.level.mean, DIGITS)) },
                    None => td.number { "–" },
                }
            }
        }
    }
}

fn method(watched: &Watched) -> Markup {
    html! {
        section id="method" aria-labelledby="method-title" {
            h2 id="method-title" { "How it is judged" }
            p { "A day's value is the median of a group's tightenings whose fit found an optimum; days are what is independent. A change is the likeliest shift of the daily level: the likelihood-ratio test of a shift at an unknown place (Worsley 1979), its p bounded by the sum over places. A difference from sisters is an externally studentised deleted residual in a random-effects model of the others (restricted maximum likelihood; Viechtbauer and Cheung 2010), of whom those that lie outside by their median absolute deviation (Hampel 1974) are no yardstick." }
            p { "All groups and quantities of one question are adjusted together (Benjamini and Hochberg 1995); of what is told, at most " (significant(100.0 * watched.false_discovery_rate, 2)) " % is expected to be false. A change that is smaller than the spread of its days is not told." }
        }
    }
}
