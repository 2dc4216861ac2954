//! The signals of the example tightenings, as the page's script and still pictures draw them.

use crate::decimation;
use crate::number::drawn;
use crate::signal_unit::motion_axis;
use serde_json::{Value, json};
use snug_campaign::{CampaignResult, Quantity, SignalUnits, Traces};

/// Points over all examples together: keeps the page small, and a lone example fine enough to zoom into.
const POINTS_IN_ALL: usize = 24_000;
const POINTS_PER_EXAMPLE: std::ops::RangeInclusive<usize> = 240..=4000;
/// Digits that drawing and reading off need.
const DIGITS: i32 = 6;

/// A signal of a panel; `minus` names the signal taken away from it.
pub struct Series {
    /// Short name of the samples.
    pub key: &'static str,
    /// Short name of the samples taken away, for residuals.
    pub minus: Option<&'static str>,
    /// Name in the legend.
    pub label: &'static str,
    /// Colour.
    pub class: &'static str,
}

/// One panel: signals of one unit over time.
pub struct Panel {
    /// Heading.
    pub title: &'static str,
    /// Vertical axis: quantity and unit.
    pub axis: String,
    /// Signals from back to front.
    pub series: Vec<Series>,
    /// Whether it shows a residual, with the band of the noise behind it.
    pub residual: bool,
}

fn series(key: &'static str, label: &'static str, class: &'static str) -> Series {
    Series {
        key,
        minus: None,
        label,
        class,
    }
}

fn residual(measured: &'static str, simulated: &'static str) -> Vec<Series> {
    vec![Series {
        key: measured,
        minus: Some(simulated),
        label: "measured − simulated",
        class: "c-residual",
    }]
}

/// The panels, in reading order, that at least one example has signals for.
pub fn panels(result: &CampaignResult) -> Vec<Panel> {
    let units = &result.units;
    let mut panels = motion_panels(units);
    panels.push(residual_panel(residual_quantity(result), units));
    if units.input_is_torque() {
        panels.push(force_panel());
    }
    panels.push(input_panel(units));
    let there = |key| {
        result
            .examples
            .iter()
            .any(|(_, traces)| samples(traces, key).is_some())
    };
    for panel in &mut panels {
        panel
            .series
            .retain(|series| there(series.key) && series.minus.is_none_or(there));
    }
    panels.retain(|panel| !panel.series.is_empty());
    panels
}

fn motion_panels(units: &SignalUnits) -> Vec<Panel> {
    vec![
        Panel {
            title: "Curve fit: displacement",
            axis: motion_axis(units, Quantity::Displacement),
            series: vec![
                series("xm", "measured", "c-measured broad"),
                series("xs", "simulated", "c-simulated"),
                series("xe", "Euler method", "c-euler"),
            ],
            residual: false,
        },
        Panel {
            title: "Acceleration",
            axis: motion_axis(units, Quantity::Acceleration),
            series: vec![
                series("am", "measured", "c-measured"),
                series("as", "simulated", "c-simulated"),
            ],
            residual: false,
        },
    ]
}

fn residual_panel(quantity: Quantity, units: &SignalUnits) -> Panel {
    let (measured, simulated) = match quantity {
        Quantity::Displacement => ("xm", "xs"),
        Quantity::Velocity => ("vm", "vs"),
        Quantity::Acceleration => ("am", "as"),
    };
    Panel {
        title: "Residual of the fitted output",
        axis: format!("residual: {}", motion_axis(units, quantity)),
        series: residual(measured, simulated),
        residual: true,
    }
}

fn force_panel() -> Panel {
    Panel {
        title: "Force between tool and hand",
        axis: "force [N]".into(),
        series: vec![
            series("f2", "F2 from measured α", "c-f2"),
            series("fo", "F_op_J measured", "c-measured"),
            series("f3", "F3 from simulated α", "c-f3"),
            series("f1", "F1 spring and damper", "c-f1"),
        ],
        residual: false,
    }
}

fn input_panel(units: &SignalUnits) -> Panel {
    let (title, axis) = if units.input_is_torque() {
        ("Torque pulse", "joint torque T [Nm]".to_owned())
    } else {
        ("Input", format!("input [{}]", units.input))
    };
    Panel {
        title,
        axis,
        series: vec![series("tq", "measured", "c-measured")],
        residual: false,
    }
}

/// The fitted quantity where the examples hold it measured and simulated, else the first that they do hold.
pub fn residual_quantity(result: &CampaignResult) -> Quantity {
    let named = match result.fitted_output.to_lowercase() {
        text if text.contains("displacement") || text.contains("angle") => Quantity::Displacement,
        text if text.contains("velocity") => Quantity::Velocity,
        _ => Quantity::Acceleration,
    };
    let holds = |quantity: &Quantity| {
        result.examples.iter().any(|(_, traces)| {
            traces.measured.get(*quantity).is_some() && traces.simulated.get(*quantity).is_some()
        })
    };
    [
        named,
        Quantity::Acceleration,
        Quantity::Displacement,
        Quantity::Velocity,
    ]
    .into_iter()
    .find(holds)
    .unwrap_or(named)
}

/// The samples behind a short name; `None` when the example has none.
fn samples<'a>(traces: &'a Traces, key: &str) -> Option<&'a [f64]> {
    let samples = match key {
        "xm" => traces.measured.get(Quantity::Displacement),
        "vm" => traces.measured.get(Quantity::Velocity),
        "am" => traces.measured.get(Quantity::Acceleration),
        "xs" => traces.simulated.get(Quantity::Displacement),
        "vs" => traces.simulated.get(Quantity::Velocity),
        "as" => traces.simulated.get(Quantity::Acceleration),
        "xe" => Some(traces.euler_displacement_rad.as_slice()),
        "f1" => Some(traces.force_f1_n.as_slice()),
        "f2" => Some(traces.force_f2_n.as_slice()),
        "f3" => Some(traces.force_f3_n.as_slice()),
        "fo" => traces.grip_force_n.as_deref(),
        "tq" => Some(traces.torque_nm.as_slice()),
        _ => None,
    };
    samples.filter(|samples| !samples.is_empty())
}

/// One tightening's signals at the samples that are drawn.
pub struct Example<'a> {
    /// Index into the campaign's tightenings.
    pub tightening: usize,
    traces: &'a Traces,
    kept: Vec<usize>,
    /// What motions \[rad …\] are multiplied with to be shown.
    output_per_rad: f64,
}

/// The examples whose tightening exists, each decimated to its share of the points.
pub fn examples(result: &CampaignResult) -> Vec<Example<'_>> {
    let share = POINTS_IN_ALL / result.examples.len().max(1);
    let points = share.clamp(*POINTS_PER_EXAMPLE.start(), *POINTS_PER_EXAMPLE.end());
    result
        .examples
        .iter()
        .filter(|(tightening, _)| *tightening < result.tightenings.len())
        .map(|(tightening, traces)| {
            Example::new(*tightening, traces, points, result.units.output_per_rad)
        })
        .collect()
}

impl<'a> Example<'a> {
    /// Chooses the samples to draw, at most about `points`.
    pub fn new(tightening: usize, traces: &'a Traces, points: usize, output_per_rad: f64) -> Self {
        let all = |keys: &[&str]| -> Vec<&'a [f64]> {
            keys.iter().filter_map(|key| samples(traces, key)).collect()
        };
        let leading = *all(&["am", "vm", "xm", "tq"]).first().unwrap_or(&&[][..]);
        let others = all(&["xm", "xs", "xe", "as", "fo", "f1", "f2", "f3", "tq"]);
        Self {
            tightening,
            traces,
            kept: decimation::indices(leading, &others, points),
            output_per_rad,
        }
    }

    /// The same example with fewer points, for the still picture.
    pub fn coarser(&self, points: usize) -> Self {
        Self::new(self.tightening, self.traces, points, self.output_per_rad)
    }

    /// Unit of the time axis and how many of it one second has: milliseconds up to two seconds.
    pub fn time_unit(&self) -> (&'static str, f64) {
        let last = self.kept.last().copied().unwrap_or(0);
        if last as f64 * self.traces.time_base.interval_s <= 2.0 {
            ("ms", 1000.0)
        } else {
            ("s", 1.0)
        }
    }

    /// Time of the window's first sample in the segment \[s\].
    pub fn start_s(&self) -> f64 {
        self.traces.time_base.start_s
    }

    /// Times since the window's start, in [`Example::time_unit`].
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        let step = self.traces.time_base.interval_s * self.time_unit().1;
        self.kept.iter().map(move |index| *index as f64 * step)
    }

    /// A series' values at those times, `None` where not finite; nothing at all when the example lacks the signal.
    pub fn values(&self, series: &Series) -> Option<Vec<Option<f64>>> {
        let first = samples(self.traces, series.key)?;
        let second = match series.minus {
            Some(key) => Some(samples(self.traces, key)?),
            None => None,
        };
        let motion = matches!(series.key.as_bytes().first(), Some(b'x' | b'v' | b'a'));
        let scale = if motion { self.output_per_rad } else { 1.0 };
        let value = |index: usize| {
            let first = *first.get(index)?;
            match second {
                Some(second) => drawn(scale * (first - second.get(index)?), DIGITS),
                None => drawn(scale * first, DIGITS),
            }
        };
        Some(self.kept.iter().map(|index| value(*index)).collect())
    }

    /// What the script needs: steps between kept samples, and the samples of every series.
    pub fn json(&self, panels: &[Panel]) -> Value {
        let mut previous = 0;
        let steps: Vec<usize> = self
            .kept
            .iter()
            .map(|index| index - std::mem::replace(&mut previous, *index))
            .collect();
        let (unit, per_second) = self.time_unit();
        let signals: Vec<Value> = panels
            .iter()
            .map(|panel| {
                panel
                    .series
                    .iter()
                    .map(|series| json!(self.values(series)))
                    .collect()
            })
            .collect();
        json!({
            "step": self.traces.time_base.interval_s * per_second,
            "unit": unit,
            "steps": steps,
            "signals": signals,
        })
    }
}

/// JSON that can stand inside a `script` element whatever its text says.
pub fn embedded(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn embedded_text_cannot_end_the_script() {
        let text = embedded(&json!({ "name": "</script><!--<script>" }));
        assert!(!text.contains('<'));
        let back: Value = serde_json::from_str(&text).expect("still JSON");
        assert_eq!(back["name"], "</script><!--<script>");
    }
}
