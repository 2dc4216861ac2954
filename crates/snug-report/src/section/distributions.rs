//! Histograms around the bulk of the values; what lies beyond the axis is counted in words and squeezes nothing.

use super::{Render, Section, fitted, nothing};
use crate::figure::{Axis, Bar, Figure, Mark, captioned, legend, round_step};
use crate::quartiles::Quartiles;
use crate::tables::tightenings_csv::effect_parameters;
use crate::words::number::significant;
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::words::counted;
use snug_campaign::{CampaignResult, TighteningResult};

/// Histograms of what was estimated, selected above and rejected below the line.
pub const SECTION: Section = Section {
    anchor: "distributions",
    short_title: "Distributions",
    title: "Distributions of selected and rejected values",
    render: Render::Always(render),
};

/// About how many bars a histogram has. Chosen.
const BARS: usize = 18;
/// Width of an axis over the values it shows, at the least \[–\]. Chosen.
const SPAN_RATIO: f64 = 0.02;

fn render(result: &CampaignResult) -> Markup {
    let mut columns = vec![
        "mass_kg",
        "damping_kg_per_s",
        "stiffness_n_per_m",
        "natural_frequency_hz",
    ];
    // A value that all tightenings share has no distribution.
    let own = |column: &&str| {
        let mut values = fitted(result).filter_map(|tightening| value(tightening, column));
        let first = values.next();
        values.any(|value| Some(value) != first)
    };
    columns.extend(effect_parameters(result).into_iter().filter(own));
    columns.extend(["fit_percent", "error_over_noise"]);
    let drawings: Vec<Markup> = columns
        .iter()
        .filter_map(|column| histogram(column, result))
        .collect();
    if drawings.is_empty() {
        return nothing("No tightening has an estimate, so there is nothing to distribute.");
    }
    html! {
        p { "Bars above the line count selected tightenings, bars below it rejected ones that have a value." }
        (legend(&[("c-selected", "selected"), ("c-rejected", "rejected")]))
        div.figures.small { @for drawing in drawings { (drawing) } }
    }
}

fn value(tightening: &TighteningResult, column: &str) -> Option<f64> {
    let value = match column {
        "natural_frequency_hz" => tightening.measures.natural_frequency_hz,
        "fit_percent" => tightening.measures.fit_percent,
        "error_over_noise" => tightening.measures.error_over_noise,
        parameter => tightening.estimate.as_ref()?.value(parameter),
    };
    value.filter(|value| value.is_finite())
}

/// Values that a reader looks for however far they lie from the bulk: bad fits.
fn always_shown(column: &str) -> Option<(f64, f64)> {
    match column {
        "fit_percent" => Some((50.0, 100.0)),
        "error_over_noise" => Some((0.0, 10.0)),
        _ => None,
    }
}

/// `None` where no tightening has a value.
fn histogram(column: &str, result: &CampaignResult) -> Option<Markup> {
    let split = |wanted: bool| -> Vec<f64> {
        fitted(result)
            .filter(|tightening| tightening.selection.selected() == wanted)
            .filter_map(|tightening| value(tightening, column))
            .collect()
    };
    let (selected, rejected) = (split(true), split(false));
    let edges = Edges::around(&selected, &rejected, always_shown(column))?;
    let (above, below) = (edges.counts(&selected), edges.counts(&rejected));
    let outside =
        selected.len() + rejected.len() - above.iter().sum::<usize>() - below.iter().sum::<usize>();
    let tallest = above.iter().max().copied().unwrap_or(0);
    let deepest = below.iter().max().copied().unwrap_or(0);
    let name = quantity::name(column, result);
    let figure = Figure {
        description: format!(
            "Histogram of {}: {} selected, {} rejected tightenings",
            name.with_unit(),
            selected.len(),
            rejected.len()
        ),
        width: 300.0,
        height: 190.0,
        x: Axis::linear(name.with_unit(), edges.low, edges.high(), 5),
        y: Axis::counts("tightenings", deepest, tallest),
        marks: vec![
            bars("c-selected", &edges, &above, 1.0, &name.unit),
            bars("c-rejected", &edges, &below, -1.0, &name.unit),
            Mark::rule("c-zero", (edges.low, edges.high()), (0.0, 0.0)),
        ],
    };
    let note = (outside > 0).then(|| {
        let all = Quartiles::of(selected.iter().chain(&rejected).copied());
        let (low, high) = all.map_or((f64::NAN, f64::NAN), |all| (all.minimum, all.maximum));
        format!(
            "{} beyond the axis; the smallest is {}, the largest {}{}.",
            if outside == 1 {
                "1 value lies".to_owned()
            } else {
                format!("{outside} values lie")
            },
            significant(low, 3),
            significant(high, 3),
            if name.unit.is_empty() {
                String::new()
            } else {
                format!(" {}", name.unit)
            }
        )
    });
    Some(captioned(
        &quantity::capitalised(&name.words),
        figure.svg(),
        note.as_deref(),
    ))
}

fn bars(class: &'static str, edges: &Edges, counts: &[usize], sign: f64, unit: &str) -> Mark {
    let bars = counts
        .iter()
        .enumerate()
        .filter(|(_, count)| **count > 0)
        .map(|(bin, count)| {
            let (left, right) = edges.ends(bin);
            let height = sign * *count as f64;
            Bar {
                x: (left, right),
                y: (height.min(0.0), height.max(0.0)),
                title: format!(
                    "{} from {} to {} {unit}",
                    counted(*count, "tightening"),
                    significant(left, 4),
                    significant(right, 4)
                )
                .trim_end()
                .into(),
            }
        })
        .collect();
    Mark::Bars(class, bars)
}

/// Equally wide bins with round edges.
struct Edges {
    low: f64,
    width: f64,
    bins: usize,
}

impl Edges {
    /// Around the bulk of the values: up to three interquartile ranges beyond the quartiles of the selected ones (of all,
    /// where fewer than five are selected), so that a few absurd fits do not squeeze the rest into one bar.
    /// What lies within `always` is never cut.
    fn around(selected: &[f64], rejected: &[f64], always: Option<(f64, f64)>) -> Option<Self> {
        let all = Quartiles::of(selected.iter().chain(rejected).copied())?;
        let bulk = match Quartiles::of(selected.iter().copied()) {
            Some(bulk) if selected.len() >= 5 => bulk,
            _ => all,
        };
        let reach = 3.0 * (bulk.high - bulk.low);
        let (from, to) = always.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
        let low = all.minimum.max((bulk.low - reach).min(from));
        let high = all.maximum.min((bulk.high + reach).max(to));
        // Equal values stand in one bar of an axis that a reader can still tell numbers apart on.
        let span = (high - low).max(SPAN_RATIO * high.abs().max(1e-9));
        let width = round_step(span, BARS);
        let first = (low / width - 1e-9).floor();
        let last = (high / width + 1e-9).floor() + 1.0;
        Some(Self {
            low: first * width,
            width,
            bins: (last - first).max(1.0) as usize,
        })
    }

    fn high(&self) -> f64 {
        self.low + self.width * self.bins as f64
    }

    fn ends(&self, bin: usize) -> (f64, f64) {
        let left = self.low + self.width * bin as f64;
        (left, left + self.width)
    }

    /// Values per bin; values outside all bins are not counted.
    fn counts(&self, values: &[f64]) -> Vec<usize> {
        let mut counts = vec![0; self.bins];
        for value in values {
            let bin = ((value - self.low) / self.width).floor();
            if bin >= 0.0 && (bin as usize) < self.bins {
                counts[bin as usize] += 1;
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_hold_the_bulk_and_leave_out_the_absurd() {
        let selected: Vec<f64> = (0..100).map(|i| 1.0 + 0.02 * f64::from(i)).collect();
        let edges = Edges::around(&selected, &[1e6, -4e3], None).expect("there are values");
        assert!(edges.low <= 1.0 && edges.high() >= 2.98 && edges.high() < 10.0);
        assert_eq!(edges.counts(&selected).iter().sum::<usize>(), 100);
        assert_eq!(edges.counts(&[1e6, -4e3]).iter().sum::<usize>(), 0);
        assert!(Edges::around(&[], &[], None).is_none());
    }

    #[test]
    fn equal_values_make_one_bar() {
        let edges = Edges::around(&[2.0; 7], &[], None).expect("there are values");
        assert_eq!(edges.counts(&[2.0; 7]).iter().max(), Some(&7));
        assert!(edges.width > 1e-4 * 2.0, "{}", edges.width);
        let zeros = Edges::around(&[0.0], &[], None).expect("there is a value");
        assert_eq!(zeros.counts(&[0.0]).iter().sum::<usize>(), 1);
    }
}
