//! What the final model gained on one tightening: curves to zoom into, or still ones where no script runs.

use super::DiagnosisSection;
use crate::decimation;
use crate::figure::{Axis, Bar, Figure, Mark, captioned, legend, linear_range};
use crate::number::{drawn, significant};
use crate::traces_json::embedded;
use maud::{Markup, PreEscaped, html};
use serde_json::json;
use snug_campaign::{CampaignResult, Diagnosis, NORMAL_95, Quantity, Showcase};

/// One tightening with the study's own model and with the final one.
pub const SECTION: DiagnosisSection = DiagnosisSection {
    anchor: "before-after",
    short_title: "Before and after",
    title: "Before and after",
    render,
};

/// Points of a line in the interactive picture, and in the still one.
const POINTS: usize = 1200;
const STILL_POINTS: usize = 400;
const DIGITS: i32 = 6;

/// A panel: its heading, axis, signals, and the noise band behind a residual.
struct Panel {
    title: String,
    axis: String,
    lines: Vec<Line>,
    band: Option<f64>,
}

struct Line {
    label: &'static str,
    class: &'static str,
    values: Vec<f64>,
}

fn line(label: &'static str, class: &'static str, values: &[f64]) -> Line {
    Line {
        label,
        class,
        values: values.to_vec(),
    }
}

fn render(diagnosis: &Diagnosis, _: &CampaignResult) -> Option<Markup> {
    let showcase = diagnosis.showcase.as_ref()?;
    let panels = panels(diagnosis, showcase);
    if panels.is_empty() {
        return None;
    }
    let interval_s = showcase.after.time_base.interval_s;
    let length = showcase.after.torque_nm.len();
    let (unit, per_second) = if length as f64 * interval_s <= 2.0 {
        ("ms", 1000.0)
    } else {
        ("s", 1.0)
    };
    let kept_samples = kept(&panels, POINTS);
    let mut previous = 0;
    let steps: Vec<usize> = kept_samples
        .iter()
        .map(|index| index - std::mem::replace(&mut previous, *index))
        .collect();
    let data = json!({
        "panels": panels.iter().map(panel_json).collect::<Vec<_>>(),
        "examples": [{
            "step": interval_s * per_second,
            "unit": unit,
            "steps": steps,
            "signals": panels.iter().map(|panel| signals(panel, &kept_samples)).collect::<Vec<_>>(),
            "noise": panels.iter().find_map(|panel| panel.band),
        }],
    });
    let still_kept = kept(&panels, STILL_POINTS);
    Some(html! {
        p { "The tightening that the study's own model misses most, " strong { (showcase.id) }
            ": the same measurement with the model before (" em { "study's own" } ") and after (" em { "final model" } ")." }
        p.help.scripted { "Point at a curve to read values; drag across to zoom, double-click to see all again." }
        div.viewer data-viewer="showcase-data" {
            div.figures {
                @for panel in &panels { (still(panel, &still_kept, interval_s * per_second, unit)) }
            }
        }
        script type="application/json" id="showcase-data" { (PreEscaped(embedded(&data))) }
    })
}

fn panels(diagnosis: &Diagnosis, showcase: &Showcase) -> Vec<Panel> {
    [
        Quantity::Displacement,
        Quantity::Velocity,
        Quantity::Acceleration,
    ]
    .into_iter()
    .flat_map(|quantity| {
        let compared = diagnosis.compared_output.contains(quantity.name());
        // Velocity is drawn only where it is what is compared.
        if quantity == Quantity::Velocity && !compared {
            return vec![];
        }
        of_quantity(diagnosis, showcase, quantity).unwrap_or_default()
    })
    .collect()
}

fn of_quantity(
    diagnosis: &Diagnosis,
    showcase: &Showcase,
    quantity: Quantity,
) -> Option<Vec<Panel>> {
    let measured = showcase.after.measured.get(quantity)?;
    let before = showcase.before.simulated.get(quantity)?;
    let after = showcase.after.simulated.get(quantity)?;
    let (symbol, unit) = match quantity {
        Quantity::Displacement => ("angle θ", "rad"),
        Quantity::Velocity => ("velocity ω", "rad/s"),
        Quantity::Acceleration => ("acceleration α", "rad/s²"),
    };
    let residual = |simulated: &[f64]| -> Vec<f64> {
        measured.iter().zip(simulated).map(|(y, s)| y - s).collect()
    };
    let noise = diagnosis
        .noise
        .acceleration_rad_per_s2
        .filter(|noise| quantity == Quantity::Acceleration && noise.is_finite());
    Some(vec![
        Panel {
            title: format!(
                "{}: model and measurement",
                crate::quantity::capitalised(quantity.name())
            ),
            axis: format!("{symbol} [{unit}]"),
            lines: vec![
                line(
                    "measured",
                    if quantity == Quantity::Displacement {
                        "c-measured broad"
                    } else {
                        "c-measured"
                    },
                    measured,
                ),
                line("before", "c-rejected", before),
                line("after", "c-simulated", after),
            ],
            band: None,
        },
        Panel {
            title: format!(
                "{}: what is left over",
                crate::quantity::capitalised(quantity.name())
            ),
            axis: format!("measured − simulated [{unit}]"),
            lines: vec![
                line("before", "c-rejected", &residual(before)),
                line("after", "c-simulated", &residual(after)),
            ],
            band: noise.map(|noise| NORMAL_95 * noise),
        },
    ])
}

/// Samples that keep the shape of every line.
fn kept(panels: &[Panel], points: usize) -> Vec<usize> {
    let lines: Vec<&[f64]> = panels
        .iter()
        .flat_map(|panel| panel.lines.iter().map(|line| line.values.as_slice()))
        .collect();
    // The last panel's first line is the noisiest: a residual.
    let leading = panels
        .last()
        .and_then(|panel| panel.lines.first())
        .map_or(&[][..], |line| line.values.as_slice());
    decimation::indices(leading, &lines, points)
}

fn panel_json(panel: &Panel) -> serde_json::Value {
    let series: Vec<serde_json::Value> = panel
        .lines
        .iter()
        .map(|line| json!({ "label": line.label, "class": line.class }))
        .collect();
    json!({ "title": panel.title, "axis": panel.axis, "series": series, "residual": panel.band.is_some() })
}

fn signals(panel: &Panel, kept: &[usize]) -> Vec<Vec<Option<f64>>> {
    panel
        .lines
        .iter()
        .map(|line| {
            kept.iter()
                .map(|index| {
                    line.values
                        .get(*index)
                        .and_then(|value| drawn(*value, DIGITS))
                })
                .collect()
        })
        .collect()
}

/// A panel without JavaScript.
fn still(panel: &Panel, kept: &[usize], step: f64, unit: &str) -> Markup {
    let values = signals(panel, kept);
    let all = values.iter().flatten().flatten().copied();
    let (low, high) = linear_range(all.chain(panel.band.iter().flat_map(|b| [-b, *b])), 0.05);
    let end = kept.last().map_or(1.0, |last| *last as f64 * step);
    let mut marks: Vec<Mark> = panel
        .band
        .map(|band| Mark::Bars {
            class: "c-band",
            bars: vec![Bar {
                x: (0.0, end),
                y: (-band, band),
                title: format!("95 % of the noise: ±{} rad/s²", significant(band, 2)),
            }],
        })
        .into_iter()
        .collect();
    marks.extend(panel.lines.iter().zip(values).map(|(line, values)| {
        Mark::Line {
            class: line.class,
            points: kept
                .iter()
                .zip(values)
                .map(|(index, value)| value.map(|value| (*index as f64 * step, value)))
                .collect(),
        }
    }));
    let figure = Figure {
        description: panel.title.clone(),
        width: 520.0,
        height: 260.0,
        x: Axis::linear(
            format!("time since the window's start [{unit}]"),
            0.0,
            end,
            6,
        ),
        y: Axis::linear(&panel.axis, low, high, 5),
        marks,
    };
    let mut entries: Vec<(&str, &str)> = panel
        .lines
        .iter()
        .map(|line| (line.class, line.label))
        .collect();
    if panel.band.is_some() {
        entries.push(("c-band", "95 % of the noise"));
    }
    captioned(
        &panel.title,
        html! { div data-panel="" { (figure.svg()) (legend(&entries)) } },
        None,
    )
}
