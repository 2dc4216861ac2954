//! Which sensor errors were taken out, how large they were, and whether chance alone could make them so.

use super::{Render, Section, headings, nothing};
use crate::figure::{Axis, Dot, Figure, Mark, Segment, captioned, legend, linear_range};
use crate::grouping::grouped;
use crate::quartiles::Quartiles;
use crate::words::number::{missing, percent, share, significant};
use maud::{Markup, html};
use snug_campaign::words::effect_name::{effect_name, unit_text};
use snug_campaign::{CampaignResult, Correction, NORMAL_95};

/// What was measured in the quiet part and taken out before the fit.
pub const SECTION: Section = Section {
    anchor: "corrections",
    short_title: "Corrections",
    title: "What was corrected before the fit",
    render: Render::Always(render),
};

/// Beyond this many tightenings a figure shows every n-th.
const DRAWN: usize = 400;

/// One sensor error over the campaign: the tightenings' index and correction.
type Corrected<'a> = (&'a str, Vec<(usize, &'a Correction)>);

fn render(result: &CampaignResult) -> Markup {
    let corrected = corrected(result);
    if corrected.is_empty() {
        return nothing(
            "Nothing was corrected: the model was fitted to the data as they were measured.",
        );
    }
    html! {
        p {
            "The quiet part before each pulse shows what the sensors say when nothing moves. What was measured there was taken \
            out before the fit, significant or not. Significant means larger than chance would make it under the measured noise."
        }
        div.scroll tabindex="0" role="region" aria-label="What was corrected before the fit" { table {
            caption { "Corrections over all tightenings" }
            (headings(&["sensor error", "significant in", "typical size (median of |size|)", "from", "to",
                "standard error (median)", "unit"]))
            tbody { @for row in &corrected { (table_row(row)) } }
        } }
        div.figures { @for row in &corrected { (drawing(row, result)) } }
    }
}

fn corrected(result: &CampaignResult) -> Vec<Corrected<'_>> {
    let tightenings = result.tightenings.iter().enumerate();
    grouped(tightenings.flat_map(|(index, tightening)| {
        let corrections = tightening.corrections.iter();
        corrections.map(move |correction| (correction.effect.as_str(), (index, correction)))
    }))
}

fn table_row((effect, sizes): &Corrected) -> Markup {
    let significant_count = sizes.iter().filter(|(_, c)| c.significant).count();
    let spread = Quartiles::of(sizes.iter().map(|(_, c)| c.value));
    let magnitude = Quartiles::of(sizes.iter().map(|(_, c)| c.value.abs()));
    let errors = Quartiles::of(sizes.iter().map(|(_, c)| c.standard_error));
    let shown = |value: Option<f64>| match value {
        Some(value) => html! { (significant(value, 3)) },
        None => missing("no finite size"),
    };
    html! { tr {
        th scope="row" { (effect_name(effect)) }
        td { (significant_count) " of " (sizes.len())
            " (" (percent(share(significant_count, sizes.len()).unwrap_or(f64::NAN))) ")" }
        td { (shown(magnitude.map(|q| q.median))) }
        td { (shown(spread.map(|q| q.minimum))) }
        td { (shown(spread.map(|q| q.maximum))) }
        td { (shown(errors.map(|q| q.median))) }
        td { (unit(sizes)) }
    } }
}

fn unit(sizes: &[(usize, &Correction)]) -> String {
    sizes
        .first()
        .map_or_else(String::new, |(_, c)| unit_text(&c.unit))
}

/// Size with 95 % interval, tightening by tightening.
fn drawing((effect, all): &Corrected, result: &CampaignResult) -> Markup {
    let every = all.len().div_ceil(DRAWN).max(1);
    let drawn: Vec<(usize, &Correction)> = all.iter().step_by(every).copied().collect();
    let ends = drawn
        .iter()
        .flat_map(|(_, correction)| [interval(correction).0, interval(correction).1, 0.0]);
    let (low, high) = linear_range(ends, 0.04);
    let last = result.tightenings.len() as f64 + 1.0;
    let zero = Mark::rule("c-zero", (0.0, last), (0.0, 0.0));
    let mut marks = vec![zero];
    marks.extend(sizes("c-quiet", &drawn, false, result));
    marks.extend(sizes("c-selected", &drawn, true, result));
    let name = effect_name(effect);
    let figure = Figure {
        description: format!("{name} of every tightening with its 95 % interval"),
        width: 300.0,
        height: 190.0,
        x: Axis::linear("tightening, in campaign order", 0.0, last, 6),
        y: Axis::linear(format!("{name} [{}]", unit(all)), low, high, 5),
        marks,
    };
    captioned(
        &crate::words::quantity::capitalised(&name),
        html! {
            (figure.svg())
            (legend(&[("c-selected", "significant"), ("c-quiet", "not significant")]))
        },
        (every > 1)
            .then(|| format!("One in {every} tightenings is drawn."))
            .as_deref(),
    )
}

fn interval(correction: &Correction) -> (f64, f64) {
    let half = NORMAL_95 * correction.standard_error;
    (correction.value - half, correction.value + half)
}

/// Whiskers and dots of the corrections that are significant, or of those that are not.
fn sizes(
    class: &'static str,
    drawn: &[(usize, &Correction)],
    significance: bool,
    result: &CampaignResult,
) -> [Mark; 2] {
    let chosen = || {
        drawn
            .iter()
            .filter(|(_, correction)| correction.significant == significance)
            .map(|(index, correction)| (*index, *index as f64 + 1.0, *correction))
    };
    let segments = chosen().map(|(_, x, correction)| Segment {
        x: (x, x),
        y: interval(correction),
    });
    let dots = chosen().map(|(index, x, correction)| Dot {
        x,
        y: correction.value,
        title: format!(
            "{}: {} ± {} {}",
            result.tightenings[index].id,
            significant(correction.value, 3),
            significant(correction.standard_error, 2),
            unit_text(&correction.unit)
        ),
    });
    [
        Mark::Segments(class, segments.collect()),
        Mark::Dots(class, dots.collect()),
    ]
}
