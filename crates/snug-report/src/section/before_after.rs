//! What the final model gained on one tightening: curves to zoom into, or still ones where no script runs.

use super::{Render, Section};
use crate::curves::{
    self, Curves, DIGITS, STILL_POINTS, Series, Values, embedded, steps, time_unit,
};
use crate::decimation;
use crate::number::{drawn, significant};
use maud::{Markup, PreEscaped, html};
use serde_json::json;
use snug_campaign::{CampaignResult, Diagnosis, NORMAL_95, Quantity, Showcase};

/// One tightening with the study's own model and with the final one.
pub const SECTION: Section = Section {
    anchor: "before-after",
    short_title: "Before and after",
    title: "Before and after",
    render: Render::Diagnosed(render),
};

/// Points of a line in the interactive picture.
const POINTS: usize = 1200;

/// A panel whose curves hold all their samples.
type Panel = curves::Panel<Vec<f64>>;

fn line(label: &'static str, class: &'static str, values: &[f64]) -> Series<Vec<f64>> {
    Series {
        label: label.into(),
        class,
        source: values.to_vec(),
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
    let (unit, per_second) = time_unit(length as f64 * interval_s);
    let kept_samples = kept(&panels, POINTS);
    let noise = noise(diagnosis);
    let data = json!({
        "panels": panels.iter().map(Panel::json).collect::<Vec<_>>(),
        "examples": [{
            "step": interval_s * per_second,
            "unit": unit,
            "steps": steps(&kept_samples),
            "signals": panels.iter().map(|panel| signals(panel, &kept_samples)).collect::<Vec<_>>(),
            "noise": noise.filter(|_| panels.iter().any(|panel| panel.residual)),
        }],
    });
    let still_kept = kept(&panels, STILL_POINTS);
    Some(html! {
        p { "The tightening that the study's own model misses most, " strong { (showcase.id) }
            ": the same measurement with the model before (" em { "study's own" } ") and after (" em { "final model" } ")." }
        p.help.scripted { "Point at a curve to read values; drag across to zoom, double-click to see all again." }
        div.viewer data-viewer="showcase-data" {
            div.figures {
                @for panel in &panels { (still(panel, &still_kept, interval_s * per_second, unit, noise)) }
            }
        }
        script type="application/json" id="showcase-data" { (PreEscaped(embedded(&data))) }
    })
}

fn panels(diagnosis: &Diagnosis, showcase: &Showcase) -> Vec<Panel> {
    Quantity::ALL
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
    let name = crate::quantity::capitalised(quantity.name());
    Some(vec![
        Panel {
            title: format!("{name}: model and measurement"),
            axis: format!("{symbol} [{unit}]"),
            series: vec![
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
            residual: false,
        },
        Panel {
            title: format!("{name}: what is left over"),
            axis: format!("measured − simulated [{unit}]"),
            series: vec![
                line("before", "c-rejected", &residual(before)),
                line("after", "c-simulated", &residual(after)),
            ],
            residual: quantity == Quantity::Acceleration && noise(diagnosis).is_some(),
        },
    ])
}

/// 95 % of the noise of the acceleration to either side, where it is known.
fn noise(diagnosis: &Diagnosis) -> Option<f64> {
    let noise = diagnosis.noise.acceleration_rad_per_s2;
    noise
        .filter(|noise| noise.is_finite())
        .map(|noise| NORMAL_95 * noise)
}

/// Samples that keep the shape of every line.
fn kept(panels: &[Panel], points: usize) -> Vec<usize> {
    let lines: Vec<&[f64]> = panels
        .iter()
        .flat_map(|panel| panel.series.iter().map(|line| line.source.as_slice()))
        .collect();
    // The last panel's first line is the noisiest: a residual.
    let leading = panels
        .last()
        .and_then(|panel| panel.series.first())
        .map_or(&[][..], |line| line.source.as_slice());
    decimation::indices(leading, &lines, points)
}

fn signals(panel: &Panel, kept: &[usize]) -> Vec<Option<Values>> {
    let values = |line: &Series<Vec<f64>>| {
        let kept = kept.iter().map(|index| line.source.get(*index));
        kept.map(|value| drawn(*value?, DIGITS)).collect()
    };
    panel.series.iter().map(|line| Some(values(line))).collect()
}

/// A panel without JavaScript.
fn still(
    panel: &Panel,
    kept: &[usize],
    step: f64,
    time_unit: &'static str,
    noise: Option<f64>,
) -> Markup {
    panel.still(Curves {
        description: panel.title.clone(),
        times: kept.iter().map(|index| *index as f64 * step).collect(),
        time_unit,
        values: signals(panel, kept),
        noise,
        noise_title: noise.map_or_else(String::new, |noise| {
            format!("95 % of the noise: ±{} rad/s²", significant(noise, 2))
        }),
    })
}
