//! The signals of the example tightenings, as the page's script and still pictures draw them.

use crate::curves;
use crate::curves::decimation;
use crate::curves::{DIGITS, Series, Values, steps, time_unit};
use crate::words::number::drawn;
use crate::words::signal_unit::motion_axis;
use serde_json::{Value, json};
use snug_campaign::{CampaignResult, Quantity, SignalUnits, Traces};

/// Points over all examples together: keeps the page small, and a lone example fine enough to zoom into.
const POINTS_IN_ALL: usize = 24_000;
/// The same of those that show before and after, whose measurements are drawn twice.
const POINTS_BEFORE_AND_AFTER: usize = 9_600;
const POINTS_PER_EXAMPLE: std::ops::RangeInclusive<usize> = 240..=4000;
/// A panel whose curves are signals of the examples.
pub type Panel = curves::Panel<Source>;

/// Short names of a signal's samples and, for residuals, of those taken away.
pub struct Source {
    key: &'static str,
    minus: Option<&'static str>,
}

fn series(key: &'static str, label: &'static str, class: &'static str) -> Series<Source> {
    Series {
        label: label.into(),
        class,
        source: Source { key, minus: None },
    }
}

fn panel(title: &str, axis: String, series: Vec<Series<Source>>) -> Panel {
    Panel {
        title: title.into(),
        axis,
        series,
        residual: false,
        time: None,
    }
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
        let there = |source: &Source| there(source.key) && source.minus.is_none_or(there);
        panel.series.retain(|series| there(&series.source));
    }
    panels.retain(|panel| !panel.series.is_empty());
    panels
}

/// A motion as measured, before and after, and what either model leaves; `None` where the example lacks one of them.
pub fn before_after_panels(units: &SignalUnits, quantity: Quantity, has_noise: bool) -> [Panel; 2] {
    let [measured, simulated, before] = match quantity {
        Quantity::Displacement => ["xm", "xs", "xb"],
        Quantity::Velocity => ["vm", "vs", "vb"],
        Quantity::Acceleration => ["am", "as", "ab"],
    };
    let broad = match quantity {
        Quantity::Displacement => "c-measured broad",
        _ => "c-measured",
    };
    let left = |model, label, class| Series {
        label,
        class,
        source: Source {
            key: measured,
            minus: Some(model),
        },
    };
    let name = crate::words::quantity::capitalised(quantity.name());
    let motion = panel(
        &format!("{name}: model and measurement"),
        motion_axis(units, quantity),
        vec![
            series(measured, "measured", broad),
            series(before, "before", "c-rejected"),
            series(simulated, "after", "c-simulated"),
        ],
    );
    let rest = Panel {
        title: format!("{name}: what is left over"),
        axis: format!("measured − simulated [{}]", units.motion(quantity)),
        series: vec![
            left(before, "before".into(), "c-rejected"),
            left(simulated, "after".into(), "c-simulated"),
        ],
        residual: has_noise,
        time: None,
    };
    [motion, rest]
}

fn motion_panels(units: &SignalUnits) -> Vec<Panel> {
    vec![
        panel(
            "Curve fit: displacement",
            motion_axis(units, Quantity::Displacement),
            vec![
                series("xm", "measured", "c-measured broad"),
                series("xs", "simulated", "c-simulated"),
                series("xe", "Euler method", "c-euler"),
            ],
        ),
        panel(
            "Acceleration",
            motion_axis(units, Quantity::Acceleration),
            vec![
                series("am", "measured", "c-measured"),
                series("as", "simulated", "c-simulated"),
            ],
        ),
    ]
}

fn residual_panel(quantity: Quantity, units: &SignalUnits) -> Panel {
    let (measured, simulated) = match quantity {
        Quantity::Displacement => ("xm", "xs"),
        Quantity::Velocity => ("vm", "vs"),
        Quantity::Acceleration => ("am", "as"),
    };
    let mut residual = series(measured, "measured − simulated", "c-residual");
    residual.source.minus = Some(simulated);
    Panel {
        title: "Residual of the fitted output".into(),
        axis: format!("residual: {}", motion_axis(units, quantity)),
        series: vec![residual],
        residual: true,
        time: None,
    }
}

fn force_panel() -> Panel {
    panel(
        "Force between tool and hand",
        "force [N]".into(),
        vec![
            series("f2", "F2 from measured α", "c-f2"),
            series("fo", "F_op_J measured", "c-measured"),
            series("f3", "F3 from simulated α", "c-f3"),
            series("f1", "F1 spring and damper", "c-f1"),
        ],
    )
}

fn input_panel(units: &SignalUnits) -> Panel {
    let (title, axis) = if units.input_is_torque() {
        ("Torque pulse", "joint torque T [Nm]".to_owned())
    } else {
        ("Input", format!("input [{}]", units.input))
    };
    panel(title, axis, vec![series("tq", "measured", "c-measured")])
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
        "xb" => traces.before.get(Quantity::Displacement),
        "vb" => traces.before.get(Quantity::Velocity),
        "ab" => traces.before.get(Quantity::Acceleration),
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
    /// In which units input and motions are shown.
    units: &'a SignalUnits,
}

/// The examples whose tightening exists, each decimated to its share of the points.
pub fn examples(result: &CampaignResult) -> Vec<Example<'_>> {
    examples_of(result, POINTS_IN_ALL)
}

fn examples_of(result: &CampaignResult, points_in_all: usize) -> Vec<Example<'_>> {
    let share = points_in_all / result.examples.len().max(1);
    let points = share.clamp(*POINTS_PER_EXAMPLE.start(), *POINTS_PER_EXAMPLE.end());
    result
        .examples
        .iter()
        .filter(|(tightening, _)| *tightening < result.tightenings.len())
        .map(|(tightening, traces)| Example::new(*tightening, traces, points, &result.units))
        .collect()
}

/// Those of them that were simulated with the model before, too.
pub fn before_and_after(result: &CampaignResult) -> Vec<Example<'_>> {
    let mut examples = examples_of(result, POINTS_BEFORE_AND_AFTER);
    examples.retain(|one| {
        let before = &one.traces.before;
        Quantity::ALL
            .iter()
            .any(|quantity| before.get(*quantity).is_some())
    });
    examples
}

impl<'a> Example<'a> {
    /// Chooses the samples to draw, at most about `points`.
    pub fn new(
        tightening: usize,
        traces: &'a Traces,
        points: usize,
        units: &'a SignalUnits,
    ) -> Self {
        let all = |keys: &[&str]| -> Vec<&'a [f64]> {
            keys.iter().filter_map(|key| samples(traces, key)).collect()
        };
        let leading = *all(&["am", "vm", "xm", "tq"]).first().unwrap_or(&&[][..]);
        let others = all(&[
            "xm", "xs", "xb", "xe", "as", "ab", "fo", "f1", "f2", "f3", "tq",
        ]);
        Self {
            tightening,
            traces,
            kept: decimation::indices(leading, &others, points),
            units,
        }
    }

    /// The same example with fewer points, for the still picture.
    pub fn coarser(&self, points: usize) -> Self {
        Self::new(self.tightening, self.traces, points, self.units)
    }

    /// Unit of the time axis and how many of it one second has: milliseconds up to two seconds.
    pub fn time_unit(&self) -> (&'static str, f64) {
        let last = self.kept.last().copied().unwrap_or(0);
        time_unit(last as f64 * self.traces.time_base.interval_s)
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

    /// The values of every series of a panel at those times.
    pub fn signals(&self, panel: &Panel) -> Vec<Option<Values>> {
        let of = |series: &Series<Source>| self.values(&series.source);
        panel.series.iter().map(of).collect()
    }

    /// A signal's values at those times; `None` when the example lacks it.
    fn values(&self, source: &Source) -> Option<Values> {
        let first = samples(self.traces, source.key)?;
        let second = match source.minus {
            Some(key) => Some(samples(self.traces, key)?),
            None => None,
        };
        let scale = match source.key.as_bytes().first() {
            Some(b'x' | b'v' | b'a') => self.units.output_per_rad,
            Some(b't') => self.units.input_per_nm,
            _ => 1.0,
        };
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
        let (unit, per_second) = self.time_unit();
        let signals: Vec<_> = panels.iter().map(|panel| self.signals(panel)).collect();
        json!({
            "step": self.traces.time_base.interval_s * per_second,
            "unit": unit,
            "steps": steps(&self.kept),
            "signals": signals,
        })
    }
}
