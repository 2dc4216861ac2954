//! Axes of a figure: scales with ticks at round numbers, drawn also where values are equal, missing or not finite.

use crate::words::number::{fixed, short, superscript};

/// A mark on an axis with its text.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Where, in the unit that the axis' label names.
    pub at: f64,
    /// What stands beside it.
    pub text: String,
    /// A heading over the rows below it, not a row of its own.
    pub heading: bool,
}

impl Tick {
    fn new(at: f64, text: String) -> Self {
        Self {
            at,
            text,
            heading: false,
        }
    }
}

/// One axis: a range of data coordinates, its ticks and its label with unit.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Name and unit.
    pub label: String,
    low: f64,
    high: f64,
    logarithmic: bool,
    ticks: Vec<Tick>,
}

impl Axis {
    /// A straight scale from `low` to `high` with about `count` ticks at round numbers.
    pub fn linear(label: impl Into<String>, low: f64, high: f64, count: usize) -> Self {
        let (low, high) = widened(low, high);
        Self {
            label: scaled_label(label.into(), common_power(low, high)),
            low,
            high,
            logarithmic: false,
            ticks: round_ticks(low, high, count),
        }
    }

    /// A logarithmic scale from `low` to `high`, both above zero, with ticks at 1, 2, 5 times powers of ten, or at round
    /// numbers where it is less than a factor of four wide.
    pub fn logarithmic(label: impl Into<String>, low: f64, high: f64) -> Self {
        let low = if low > 0.0 { low } else { 1e-3 };
        let high = if high > 1.02 * low { high } else { 1.02 * low };
        let ticks = if high / low < 4.0 {
            round_ticks(low, high, 5)
        } else {
            decade_ticks(low, high)
        };
        Self {
            label: label.into(),
            low,
            high,
            logarithmic: true,
            ticks,
        }
    }

    /// Counts upwards and downwards from zero, with whole numbers at the ticks and no sign.
    pub fn counts(label: &str, down: usize, up: usize) -> Self {
        let mut axis = Self::linear(label, -(down as f64) * 1.06, (up as f64).max(1.0) * 1.06, 5);
        axis.ticks.retain(|tick| tick.at.fract() == 0.0);
        for tick in &mut axis.ticks {
            tick.text = fixed(tick.at.abs(), 0);
        }
        axis
    }

    /// One row per entry from top to bottom, at −0, −1, −2 …; a row is its text and whether it is a heading.
    pub fn rows(rows: &[(String, bool)]) -> Self {
        let ticks = rows
            .iter()
            .enumerate()
            .map(|(row, (text, heading))| Tick {
                at: -(row as f64),
                text: text.clone(),
                heading: *heading,
            })
            .collect();
        Self {
            label: String::new(),
            low: 0.5 - rows.len().max(1) as f64,
            high: 0.5,
            logarithmic: false,
            ticks,
        }
    }

    /// Where a value lies, 0 at the low and 1 at the high end.
    pub fn position(&self, value: f64) -> f64 {
        if self.logarithmic {
            // What a logarithmic scale cannot hold stands at its low end.
            return (value.max(self.low) / self.low).ln() / (self.high / self.low).ln();
        }
        (value - self.low) / (self.high - self.low)
    }

    /// The range drawn.
    pub fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// The ticks, from low to high.
    pub fn ticks(&self) -> &[Tick] {
        &self.ticks
    }

    /// Characters of the longest tick text.
    pub fn widest_tick(&self) -> usize {
        let width = |tick: &Tick| {
            let count = tick.text.chars().count();
            // A heading is bold: an eighth wider.
            if tick.heading {
                count + count.div_ceil(8)
            } else {
                count
            }
        };
        self.ticks.iter().map(width).max().unwrap_or(0)
    }
}

/// The range of finite values with `margin` of its width added on both sides; 0 to 1 without values.
pub fn linear_range(values: impl IntoIterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (low, high) = values
        .into_iter()
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
    if low > high {
        return (0.0, 1.0);
    }
    let (low, high) = widened(low, high);
    let room = margin * (high - low);
    (low - room, high + room)
}

/// A range of some width, whatever comes in.
fn widened(low: f64, high: f64) -> (f64, f64) {
    if !(low.is_finite() && high.is_finite()) {
        return (0.0, 1.0);
    }
    if high - low > 1e-12 * low.abs().max(high.abs()).max(1e-300) {
        return (low, high);
    }
    let room = if low == 0.0 { 0.5 } else { 0.1 * low.abs() };
    (low - room, high + room)
}

/// The largest of 1, 2, 5 times a power of ten that gives at most about `count` ticks over `width`.
pub fn round_step(width: f64, count: usize) -> f64 {
    let raw = width / count.max(1) as f64;
    let power = 10f64.powf(raw.log10().floor());
    let factor = match raw / power {
        ratio if ratio <= 1.0 + 1e-9 => 1.0,
        ratio if ratio <= 2.0 + 1e-9 => 2.0,
        ratio if ratio <= 5.0 + 1e-9 => 5.0,
        _ => 10.0,
    };
    factor * power
}

/// The power of ten that is taken out of the ticks of a range and put into the axis' label.
fn common_power(low: f64, high: f64) -> i32 {
    let largest = low.abs().max(high.abs());
    if (1e-2..1e5).contains(&largest) {
        0
    } else {
        largest.log10().floor() as i32
    }
}

/// `stiffness k [N/m]` becomes `stiffness k [10⁵ N/m]`.
fn scaled_label(label: String, power: i32) -> String {
    if power == 0 {
        return label;
    }
    let factor = format!("10{}", superscript(power));
    match label.split_once('[') {
        Some((name, unit)) => format!("{name}[{factor} {unit}"),
        None => format!("{label} [{factor}]"),
    }
}

fn round_ticks(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let step = round_step(high - low, count);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let power = common_power(low, high);
    let decimals = power - (step.log10() + 1e-9).floor() as i32;
    (first..=last)
        .map(|multiple| {
            let at = multiple as f64 * step;
            Tick::new(at, fixed(at / 10f64.powi(power), decimals))
        })
        .collect()
}

fn decade_ticks(low: f64, high: f64) -> Vec<Tick> {
    let wide = high / low > 2000.0;
    let first = low.log10().floor() as i32;
    let last = high.log10().ceil() as i32;
    (first..=last)
        .flat_map(|power| [1.0, 2.0, 5.0].map(|factor| (power, factor)))
        .filter(|(_, factor)| !wide || *factor == 1.0)
        .map(|(power, factor)| factor * 10f64.powi(power))
        .filter(|at| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(at))
        .map(|at| Tick::new(at, short(at)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithmic_axis_spaces_equal_factors_equally() {
        let axis = Axis::logarithmic("error", 1.0, 100.0);
        assert_eq!(texts(&axis), ["1", "2", "5", "10", "20", "50", "100"]);
        assert!((axis.position(10.0) - 0.5).abs() < 1e-12);
        assert_eq!(axis.position(0.0), 0.0);
        let narrow = Axis::logarithmic("error", 0.95, 1.2);
        assert!(texts(&narrow).contains(&"1.00"));
        assert!(Axis::logarithmic("", f64::NAN, f64::NAN).ticks().len() < 9);
    }

    fn texts(axis: &Axis) -> Vec<&str> {
        axis.ticks().iter().map(|tick| tick.text.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::linear("t [ms]", 0.0, 300.0, 6);
        assert_eq!(texts(&axis), ["0", "50", "100", "150", "200", "250", "300"]);
        let axis = Axis::linear("θ [rad]", -0.013, 0.052, 5);
        assert_eq!(texts(&axis), ["0.00", "0.02", "0.04"]);
        let axis = Axis::linear("f [Hz]", 4.9, 6.1, 4);
        assert_eq!(texts(&axis), ["5.0", "5.5", "6.0"]);
    }

    #[test]
    fn large_and_small_values_share_a_power_of_ten() {
        let axis = Axis::linear("k3 [N/m³]", 9.4e5, 1.11e6, 5);
        assert_eq!(texts(&axis), ["0.95", "1.00", "1.05", "1.10"]);
        assert_eq!(axis.label, "k3 [10⁶ N/m³]");
        let axis = Axis::linear("θ [rad]", -2e-4, 4e-4, 4);
        assert_eq!(texts(&axis), ["−2", "0", "2", "4"]);
        assert_eq!(axis.label, "θ [10⁻⁴ rad]");
    }

    #[test]
    fn a_single_value_and_nothing_at_all_still_give_an_axis() {
        for (low, high) in [(3.0, 3.0), (0.0, 0.0), (f64::NAN, 1.0)] {
            let axis = Axis::linear("", low, high, 5);
            assert!(axis.ticks().len() >= 2, "{low} {high}");
        }
        assert_eq!(linear_range([], 0.1), (0.0, 1.0));
    }

    #[test]
    fn rows_run_from_top_to_bottom() {
        let axis = Axis::rows(&[("a".into(), false), ("b".into(), false)]);
        assert_eq!(axis.position(0.0), 0.75);
        assert_eq!(axis.position(-1.0), 0.25);
    }
}
