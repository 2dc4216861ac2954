//! Groups side by side: mean, interval and spread of every quantity per level of every factor, drawn and as tables.

use super::{Render, Section, factors, nothing};
use crate::figure::{Axis, Dot, Figure, Mark, Segment, captioned, legend, linear_range};
use crate::grouping::first_seen;
use crate::words::number::{missing, percent, percent_interval, rounded, share, significant};
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::{CampaignResult, ConditionSummary, Moments, QuantitySummary};

/// Means and standard deviations per condition.
pub const SECTION: Section = Section {
    anchor: "conditions",
    short_title: "Conditions",
    title: "Means and spreads per condition",
    render: Render::Always(render),
};

type Side = fn(&QuantitySummary) -> Option<&Moments>;

fn render(result: &CampaignResult) -> Markup {
    let quantities = quantities(result);
    if quantities.is_empty() {
        return nothing("There are no groups to compare.");
    }
    html! {
        @if anything_selected(&quantities, result) {
            (drawings(&quantities, result))
        } @else {
            (nothing("No tightening is selected, so there are no means to draw."))
        }
        (table("Selected tightenings: mean [95 % interval], standard deviation (SD), count (n)", &quantities, result, |row| {
            row.selected.as_ref()
        }))
        details {
            summary { "The same over the rejected tightenings that have an estimate" }
            (table("Rejected tightenings", &quantities, result, |row| row.rejected.as_ref()))
        }
    }
}

fn anything_selected(quantities: &[&str], result: &CampaignResult) -> bool {
    result.conditions.iter().any(|summary| {
        quantities
            .iter()
            .any(|column| moments(summary, column, |row| row.selected.as_ref()).is_some())
    })
}

fn drawings(quantities: &[&str], result: &CampaignResult) -> Markup {
    html! {
        p {
            "Each dot is the mean of the selected tightenings of a group with its 95 % interval (thick); the thin line reaches \
            one standard deviation to both sides, which is how much single tightenings differ. An interval that ends at the frame \
            goes on beyond it: its group is too small to say much."
        }
        (legend(&[("c-selected", "mean and 95 % interval"), ("c-quiet", "± standard deviation")]))
        div.figures.small { @for column in quantities { (drawing(column, result)) } }
    }
}

/// The quantities that stand in the table, in order of first appearance.
fn quantities(result: &CampaignResult) -> Vec<&str> {
    let rows = result
        .conditions
        .iter()
        .flat_map(|summary| &summary.quantities);
    first_seen(rows.map(|row| row.quantity.as_str()))
}

fn moments<'a>(summary: &'a ConditionSummary, column: &str, side: Side) -> Option<&'a Moments> {
    summary
        .quantities
        .iter()
        .find(|row| row.quantity == column)
        .and_then(side)
}

fn table(caption: &str, columns: &[&str], result: &CampaignResult, side: Side) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Means and spreads per condition" { table.conditions {
            caption { (caption) }
            thead { tr {
                th scope="col" { "condition" }
                th scope="col" { "selected share" }
                @for column in columns { th scope="col" { (quantity::name(column, result).with_unit()) } }
            } }
            @for (factor, levels) in factors(result) {
                tbody {
                    @if factor != "all" {
                        tr.group { th colspan=(columns.len() + 2) scope="rowgroup" { (quantity::words(factor)) } }
                    }
                    @for summary in levels {
                        tr {
                            th scope="row" { (summary.level) }
                            td { (selected_share(summary)) }
                            @for column in columns { td { (cell(moments(summary, column, side))) } }
                        }
                    }
                }
            }
        } }
    }
}

fn selected_share(summary: &ConditionSummary) -> Markup {
    html! {
        (percent(share(summary.selected, summary.tightenings).unwrap_or(f64::NAN)))
        @if let Some(interval) = summary.selected_share_interval {
            " " span.interval { (percent_interval(interval)) }
        }
        span.spread { (summary.selected) " of " (summary.tightenings) }
    }
}

fn cell(moments: Option<&Moments>) -> Markup {
    let Some(moments) = moments else {
        return missing("no tightening in this group");
    };
    let mean = rounded(moments.mean, moments.mean_interval);
    html! {
        (mean.value)
        @if let Some(interval) = mean.interval { " " span.interval { (interval) } }
        span.spread {
            "SD "
            @match moments.standard_deviation {
                Some(deviation) => { (significant(deviation, 3)) }
                None => { (missing("needs two tightenings")) }
            }
            ", n " (moments.count)
        }
    }
}

/// Height, group and numbers of a row of the drawing.
type Placed<'a> = (f64, &'a ConditionSummary, &'a Moments);

/// Mean, interval and spread of one quantity, one row per level.
fn drawing(column: &str, result: &CampaignResult) -> Markup {
    let mut rows: Vec<(String, bool)> = Vec::new();
    let mut placed: Vec<Placed<'_>> = Vec::new();
    for (factor, levels) in factors(result) {
        if factor != "all" {
            rows.push((quantity::words(factor), true));
        }
        for summary in levels {
            if let Some(moments) = moments(summary, column, |row| row.selected.as_ref()) {
                placed.push((-(rows.len() as f64), summary, moments));
            }
            rows.push((summary.level.clone(), false));
        }
    }
    let name = quantity::name(column, result);
    let (low, high) = shown_range(&placed);
    let figure = Figure {
        description: format!(
            "Mean {} per condition with 95 % intervals",
            name.with_unit()
        ),
        width: 300.0,
        height: 56.0 + 17.0 * rows.len() as f64,
        x: Axis::linear(name.with_unit(), low, high, 5),
        y: Axis::rows(&rows),
        marks: marks(&placed, (low, high), &name.unit),
    };
    captioned(&quantity::capitalised(&name.words), figure.svg(), None)
}

/// Every mean with its standard deviation, and the intervals as far as they do not press all that together: that of two
/// tightenings is many times as wide as they differ.
fn shown_range(placed: &[Placed<'_>]) -> (f64, f64) {
    let spread: Vec<f64> = (placed.iter())
        .flat_map(|(_, _, moments)| {
            let deviation = moments.standard_deviation.unwrap_or(0.0);
            [moments.mean - deviation, moments.mean + deviation]
        })
        .collect();
    let (least, most) = linear_range(spread.iter().copied(), 0.5);
    let intervals = placed
        .iter()
        .filter_map(|(_, _, moments)| moments.mean_interval)
        .flat_map(|interval| [interval.low, interval.high])
        .map(|end| end.clamp(least, most));
    linear_range(intervals.chain(spread), 0.05)
}

fn marks(placed: &[Placed<'_>], (low, high): (f64, f64), unit: &str) -> Vec<Mark> {
    let spreads = placed.iter().filter_map(|(y, _, moments)| {
        let deviation = moments.standard_deviation?;
        Some(Segment {
            x: (moments.mean - deviation, moments.mean + deviation),
            y: (*y, *y),
        })
    });
    let intervals = placed.iter().filter_map(|(y, _, moments)| {
        let interval = moments.mean_interval?;
        Some(Segment {
            x: (interval.low.max(low), interval.high.min(high)),
            y: (*y, *y),
        })
    });
    let dots = placed.iter().map(|(y, summary, moments)| {
        let mean = rounded(moments.mean, moments.mean_interval);
        Dot {
            x: moments.mean,
            y: *y,
            title: format!(
                "{} {}: mean {} {} {unit}",
                quantity::words(&summary.factor),
                summary.level,
                mean.value,
                mean.interval.unwrap_or_default()
            )
            .trim_end()
            .into(),
        }
    });
    vec![
        Mark::Segments("c-quiet", spreads.collect()),
        Mark::Segments("thick c-selected", intervals.collect()),
        Mark::Dots("c-selected", dots.collect()),
    ]
}
