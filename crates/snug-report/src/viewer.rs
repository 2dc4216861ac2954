//! The pages' viewer of curves, for pages other than the report: its style, its script, and the data that both draw.

use crate::curves;
use crate::curves::decimation;
use crate::curves::{DIGITS, Series, Values, embedded, steps, time_unit};
use crate::section::location::{correlation, force, response};
use crate::words::number::{drawn, significant};
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
    /// What it makes of a torque that steps at the first sample; `None` where that is not drawn.
    pub step: Option<&'a [f64]>,
}

impl<'a> Simulated<'a> {
    /// The model with which all began.
    pub fn first(output: &'a [f64], step: Option<&'a [f64]>) -> Self {
        Self {
            label: "model to begin with",
            class: "c-rejected",
            output,
            step,
        }
    }

    /// The present model.
    pub fn now(output: &'a [f64], step: Option<&'a [f64]>) -> Self {
        Self {
            label: "now",
            class: "c-simulated",
            output,
            step,
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
    /// The torque \[Nm\] to which step responses step; `None` where none are drawn.
    pub step_nm: Option<f64>,
}

type Panel = curves::Panel<Vec<f64>>;

impl Compared<'_> {
    /// What the viewers draw: the output, and what is left over with the band of the noise; under `step` the models' step responses, for
    /// as long as they take to settle.
    pub fn json(&self) -> Value {
        let band = self.noise.filter(|noise| noise.is_finite());
        let band = band.map(|noise| NORMAL_95 * noise * self.units.output_per_rad);
        let mut told = self.drawn(&self.panels(), self.measured.len(), band);
        told["step"] = self.step_nm.map_or(Value::Null, |step_nm| {
            let steps: Vec<&[f64]> = self.models.iter().filter_map(|model| model.step).collect();
            self.drawn(&[self.step_panel(step_nm)], settled(&steps), None)
        });
        told
    }

    /// Panels over the first `samples`.
    fn drawn(&self, panels: &[Panel], samples: usize, band: Option<f64>) -> Value {
        let (unit, per_second) = time_unit(samples as f64 * self.interval_s);
        let lines: Vec<&[f64]> = panels
            .iter()
            .flat_map(|panel| panel.series.iter())
            .map(|line| &line.source[..samples.min(line.source.len())])
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
        json!({
            "panels": panels.iter().map(Panel::json).collect::<Vec<_>>(),
            "example": {
                "step": self.interval_s * per_second,
                "unit": unit,
                "steps": steps(&kept),
                "signals": panels.iter().map(signals).collect::<Vec<_>>(),
                "noise": band,
            },
        })
    }

    fn panels(&self) -> Vec<Panel> {
        let shown = |values: &[f64]| self.shown(values);
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
                time: None,
            },
            Panel {
                title: "What is left over: measured − simulated".into(),
                axis: format!("residual [{}]", self.units.motion(self.quantity)),
                series: rest,
                residual: self.noise.is_some(),
                time: None,
            },
        ]
    }

    fn shown(&self, values: &[f64]) -> Vec<f64> {
        let per_rad = self.units.output_per_rad;
        values.iter().map(|value| value * per_rad).collect()
    }

    fn step_panel(&self, step_nm: f64) -> Panel {
        let height = significant(step_nm * self.units.input_per_nm, 3);
        let input = match self.units.input.as_str() {
            "Nm" => "torque",
            "N" => "force",
            _ => "input",
        };
        let step = |model: &Simulated<'_>| {
            Some(Series {
                label: model.label.to_owned().into(),
                class: model.class,
                source: self.shown(model.step?),
            })
        };
        Panel {
            title: format!(
                "Step response: the models where the {input} steps to {height} {} and stays",
                self.units.input
            ),
            axis: (self.vocabulary).says(&motion_axis(self.units, self.quantity)),
            series: self.models.iter().filter_map(step).collect(),
            residual: false,
            time: Some("time since the step"),
        }
    }
}

/// Share of its way \[–\] within which a step response has settled. Customary.
const SETTLED: f64 = 0.02;
/// Samples of a step response that are drawn at least. Chosen.
const FEWEST: usize = 100;

/// Samples until all have settled, and half as many more.
fn settled(steps: &[&[f64]]) -> usize {
    let until = |step: &[f64]| -> usize {
        let end = step.last().copied().unwrap_or(0.0);
        let way = step.iter().map(|y| (y - end).abs()).fold(0.0, f64::max);
        let moves = step.iter().rposition(|y| (y - end).abs() > SETTLED * way);
        moves.map_or(0, |last| last + 1)
    };
    let longest = steps.iter().map(|step| step.len()).max().unwrap_or(0);
    let until = steps.iter().map(|step| until(step)).max().unwrap_or(0);
    (until + until / 2).max(FEWEST).min(longest)
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
/// with itself and with the torque, then the response over frequency in these units: as the report draws them but for `data-cell`, of each cell of the map its edges, displacement \[m\] and
/// velocity \[m/s\] of the grip. Nothing where there is none.
pub fn what_is_left(location: &Location, before: Option<&Location>, units: &SignalUnits) -> Markup {
    let response_before = before.and_then(|before| before.response.as_ref());
    html! {
        div.figures {
            (force::live(location, before))
            @if let Some(correlation) = &location.correlation { (correlation::drawings(correlation)) }
            @if let Some(response) = &location.response { (response::drawings(response, response_before, units)) }
            @else { (response::none()) }
        }
    }
}

/// Where a viewer of this name draws, `panels` one below the other; `data` is what it begins with.
pub fn viewer(name: &str, data: &Value, panels: &[&str]) -> Markup {
    html! {
        div.viewer data-viewer=(name) {
            div.figures {
                @for title in panels {
                    figure { figcaption { (title) } div data-panel="" {} }
                }
            }
        }
        script type="application/json" id=(name) { (PreEscaped(embedded(data))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// e^(−t/τ) is within 2 % after 3.9 τ; what has hardly begun to move is drawn to its end.
    #[test]
    fn a_step_is_drawn_until_it_has_settled() {
        let falling: Vec<f64> = (0..100_000)
            .map(|t| (-f64::from(t) / 1000.0).exp())
            .collect();
        let until = settled(&[&falling, &[1.0; 100_000]]);
        assert!(
            (until as f64 / (1.5 * 3912.0) - 1.0).abs() < 1e-3,
            "{until}"
        );
        let rising: Vec<f64> = (0..500).map(f64::from).collect();
        assert_eq!(settled(&[&rising]), 500);
        assert_eq!((settled(&[&[0.0; 7]]), settled(&[])), (7, 0));
    }

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
                Simulated::first(&[0.0, 4.0, 2.0], None),
                Simulated::now(&[2.0, 2.0, 6.0], Some(&[0.0, 4.0, 8.0])),
            ],
            signature: None,
            noise: Some(0.1),
            step_nm: Some(30.0),
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
        let step = &told["step"]["panels"][0];
        assert_eq!(step["time"], "time since the step");
        assert_eq!(
            step["title"],
            "Step response: the models where the torque steps to 30.0 Nm and stays"
        );
        let drawn = &told["step"]["example"]["signals"];
        assert_eq!(drawn[0], json!([[0.0, 2.0, 4.0]]));
        let alone = Compared {
            models: vec![Simulated::now(&[2.0, 2.0, 6.0], None)],
            signature: Some(Simulated {
                label: "friction",
                class: "c-signature",
                output: &[0.0, 2.0, 0.0],
                step: None,
            }),
            step_nm: None,
            ..compared
        }
        .json();
        let lines = |panel: usize| alone["panels"][panel]["series"].as_array().map(Vec::len);
        assert_eq!((lines(0), lines(1)), (Some(2), Some(2)));
        assert_eq!(alone["example"]["signals"][1][1], json!([0.0, 1.0, 0.0]));
    }
}
