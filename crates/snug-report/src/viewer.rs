//! The pages' viewer of curves, for pages other than the report: its style, its script, and the data that both draw.

use crate::curves;
use crate::curves::decimation;
use crate::curves::{DIGITS, Series, Values, embedded, steps, time_unit};
use crate::section::location::{correlation, force};
use crate::words::number::drawn;
use crate::words::signal_unit::motion_axis;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::{Value, json};
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{Location, NORMAL_95, Quantity, SignalUnits};

/// Style of every page.
const STYLE: &str = concat!(
    include_str!("assets/page.css"),
    include_str!("assets/figures.css"),
    include_str!("assets/diagnosis.css")
);

/// Script of the viewer; a script that comes behind it in the same element finds what is there as `viewers`.
pub const SCRIPT: &str = concat!(
    "'use strict';\n",
    include_str!("assets/scale.js"),
    include_str!("assets/panel.js"),
    include_str!("assets/viewer.js")
);

/// Points of a line.
const POINTS: usize = 1200;

/// What one model makes of an output, in its SI unit, a value for each sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Simulated<'a> {
    /// Which model, as the legend says it.
    pub label: &'a str,
    /// The style of its line.
    pub class: &'static str,
    /// What it makes.
    pub output: &'a [f64],
}

impl<'a> Simulated<'a> {
    /// The model with which all began.
    pub fn first(output: &'a [f64]) -> Self {
        Self {
            label: "model to begin with",
            class: "c-rejected",
            output,
        }
    }

    /// The present model.
    pub fn now(output: &'a [f64]) -> Self {
        Self {
            label: "now",
            class: "c-simulated",
            output,
        }
    }
}

/// One output of one tightening, as measured and as models have it; all in its SI unit, a value for each sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared<'a> {
    /// Which output.
    pub quantity: Quantity,
    /// In which units it is shown.
    pub units: &'a SignalUnits,
    /// In whose words.
    pub vocabulary: Vocabulary,
    /// From sample to sample \[s\].
    pub interval_s: f64,
    /// As measured.
    pub measured: &'a [f64],
    /// As models have it, the last drawn above the others.
    pub models: Vec<Simulated<'a>>,
    /// What is drawn beside what is left over: what a missing effect would leave.
    pub signature: Option<Simulated<'a>>,
    /// Standard deviation of the measurement's noise in the output's SI unit; `None` where it is not known.
    pub noise: Option<f64>,
}

type Panel = curves::Panel<Vec<f64>>;

impl Compared<'_> {
    /// What the viewer draws: the output, and what is left over with the band of the noise.
    pub fn json(&self) -> Value {
        let panels = self.panels();
        let (unit, per_second) = time_unit(self.measured.len() as f64 * self.interval_s);
        let lines: Vec<&[f64]> = panels
            .iter()
            .flat_map(|panel| panel.series.iter().map(|line| line.source.as_slice()))
            .collect();
        let leading = lines.last().copied().unwrap_or_default();
        let kept = decimation::indices(leading, &lines, POINTS);
        let signals = |panel: &Panel| -> Vec<Values> {
            let values = |line: &Series<Vec<f64>>| {
                let kept = kept.iter().map(|&index| line.source.get(index));
                kept.map(|value| drawn(*value?, DIGITS)).collect()
            };
            panel.series.iter().map(values).collect()
        };
        let band = self.noise.filter(|noise| noise.is_finite());
        json!({
            "panels": panels.iter().map(Panel::json).collect::<Vec<_>>(),
            "example": {
                "step": self.interval_s * per_second,
                "unit": unit,
                "steps": steps(&kept),
                "signals": panels.iter().map(signals).collect::<Vec<_>>(),
                "noise": band.map(|noise| NORMAL_95 * noise * self.units.output_per_rad),
            },
        })
    }

    fn panels(&self) -> Vec<Panel> {
        let shown = |values: &[f64]| -> Vec<f64> {
            let per_rad = self.units.output_per_rad;
            values.iter().map(|value| value * per_rad).collect()
        };
        let left = |model: &[f64]| -> Vec<f64> {
            let pairs = self.measured.iter().zip(model);
            shown(
                &pairs
                    .map(|(measured, model)| measured - model)
                    .collect::<Vec<_>>(),
            )
        };
        let line = |label: &str, class, source| Series {
            label: label.to_owned().into(),
            class,
            source,
        };
        let drawn = |of: &dyn Fn(&[f64]) -> Vec<f64>| -> Vec<Series<Vec<f64>>> {
            let models = self.models.iter();
            models
                .map(|model| line(model.label, model.class, of(model.output)))
                .collect()
        };
        let mut motion = vec![line("measured", "c-measured", shown(self.measured))];
        motion.extend(drawn(&shown));
        let mut rest = drawn(&left);
        rest.extend(
            (self.signature)
                .map(|signature| line(signature.label, signature.class, shown(signature.output))),
        );
        let name = crate::words::quantity::capitalised(self.quantity.name());
        vec![
            Panel {
                title: format!("{name}: model and measurement"),
                axis: (self.vocabulary).says(&motion_axis(self.units, self.quantity)),
                series: motion,
                residual: false,
            },
            Panel {
                title: "What is left over: measured − simulated".into(),
                axis: format!("residual [{}]", self.units.motion(self.quantity)),
                series: rest,
                residual: self.noise.is_some(),
            },
        ]
    }
}

/// A page of this title: the viewer's style and `style` in its head, `body` in its body.
pub fn document(title: &str, style: &str, body: &Markup) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                // An empty icon, so that a browser does not ask a server for one.
                link rel="icon" href="data:,";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body { (body) }
        }
    }
}

/// The missing force over time, beside what another model lacked `before`, and over displacement and velocity, then how the residual goes
/// with itself and with the torque: as the report draws them but for `data-cell`, of each cell of the map its edges, displacement \[m\] and
/// velocity \[m/s\] of the grip. Nothing where there is none.
pub fn what_is_left(location: &Location, before: Option<&Location>) -> Markup {
    html! {
        div.figures {
            (force::live(location, before))
            @if let Some(correlation) = &location.correlation { (correlation::drawings(correlation)) }
        }
    }
}

/// Where the viewer draws, `panels` one below the other; `data` is what it begins with.
pub fn viewer(data: &Value, panels: &[&str]) -> Markup {
    html! {
        div.viewer data-viewer="viewer-data" {
            div.figures {
                @for title in panels {
                    figure { figcaption { (title) } div data-panel="" {} }
                }
            }
        }
        script type="application/json" id="viewer-data" { (PreEscaped(embedded(data))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_over_is_measured_minus_simulated_in_the_shown_unit() {
        let units = SignalUnits {
            output: "m".into(),
            output_per_rad: 0.5,
            ..SignalUnits::default()
        };
        let compared = Compared {
            quantity: Quantity::Displacement,
            units: &units,
            vocabulary: Vocabulary::Hand,
            interval_s: 1e-3,
            measured: &[2.0, 4.0, 6.0],
            models: vec![
                Simulated::first(&[0.0, 4.0, 2.0]),
                Simulated::now(&[2.0, 2.0, 6.0]),
            ],
            signature: None,
            noise: Some(0.1),
        };
        let told = compared.json();
        let signals = &told["example"]["signals"];
        assert_eq!(
            signals[0],
            json!([[1.0, 2.0, 3.0], [0.0, 2.0, 1.0], [1.0, 1.0, 3.0]])
        );
        assert_eq!(signals[1], json!([[1.0, 0.0, 2.0], [0.0, 1.0, 0.0]]));
        assert_eq!(told["example"]["unit"], "ms");
        let band = told["example"]["noise"].as_f64().expect("it is known");
        assert!((band - 0.5 * 0.1 * NORMAL_95).abs() < 1e-12);
        assert_eq!(told["panels"][1]["residual"], true);
        let alone = Compared {
            models: vec![Simulated::now(&[2.0, 2.0, 6.0])],
            signature: Some(Simulated {
                label: "friction",
                class: "c-signature",
                output: &[0.0, 2.0, 0.0],
            }),
            ..compared
        }
        .json();
        let lines = |panel: usize| alone["panels"][panel]["series"].as_array().map(Vec::len);
        assert_eq!((lines(0), lines(1)), (Some(2), Some(2)));
        assert_eq!(alone["example"]["signals"][1][1], json!([0.0, 1.0, 0.0]));
    }
}
