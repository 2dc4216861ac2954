//! Small figures, drawn once: a series over days, and a tightening's curves.

use super::super::curve::Curve;
use super::super::summary::JudgedSeries;
use crate::storage::partition::date_of;
use maud::{Markup, html};
use std::fmt::Write;

/// Points of a line at most: more than a small figure has pixels.
const POINTS: usize = 400;

/// Maps values to a stretch of pixels, from the lowest to the highest.
struct Axis {
    low: f64,
    per_unit: f64,
    from: f64,
}

impl Axis {
    fn of(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        let (low, high) = match high > low {
            true => (low, high),
            false if low.is_finite() => (low - 0.5, low + 0.5),
            false => (0.0, 1.0),
        };
        Self {
            low,
            per_unit: (to - from) / (high - low),
            from,
        }
    }

    fn at(&self, value: f64) -> f64 {
        self.from + self.per_unit * (value - self.low)
    }
}

/// A series over days: a dot a day, the levels before and after its change.
pub fn strip(one: &JudgedSeries, width: f64, height: f64) -> Markup {
    let days = &one.series.days;
    let x = Axis::of(days.iter().map(|day| f64::from(day.day)), 4.0, width - 4.0);
    let y = Axis::of(days.iter().map(|day| day.value), height - 4.0, 4.0);
    let mut line = String::new();
    for day in days {
        let _ = write!(
            line,
            "{:.1},{:.1} ",
            x.at(f64::from(day.day)),
            y.at(day.value)
        );
    }
    let change = one.change.filter(|_| one.is_changed);
    let ends = days.first().zip(days.last());
    let told = ends.map_or_else(String::new, |(first, last)| {
        format!(
            "{} to {}: {:.3e} to {:.3e}",
            date_of(first.day),
            date_of(last.day),
            first.value,
            last.value
        )
    });
    html! {
        svg.strip viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img" aria-label=(told) {
            @if let Some(change) = change {
                @let since = x.at(f64::from(days[change.first].day)) - 2.0;
                rect.since x=(format!("{since:.1}")) y="0" width=(format!("{:.1}", (width - since).max(0.0))) height=(height) {}
            }
            polyline points=(line.trim_end()) {}
            @if height > 40.0 {
                @for day in days.iter().take(POINTS) {
                    circle cx=(format!("{:.1}", x.at(f64::from(day.day)))) cy=(format!("{:.1}", y.at(day.value))) r="1.8" {}
                }
            }
            title { (told) }
        }
    }
}

/// Torque, and the fitted output as measured and as the model has it.
pub fn curves_figure(curve: &Curve) -> Markup {
    let unit = match curve.quantity {
        snug_campaign::Quantity::Displacement => "rad",
        snug_campaign::Quantity::Velocity => "rad/s",
        snug_campaign::Quantity::Acceleration => "rad/s²",
    };
    let (width, height) = (760.0, 190.0);
    let both = || curve.measured.iter().chain(&curve.simulated).copied();
    let motion = Axis::of(both(), height - 6.0, 6.0);
    let torque = Axis::of(curve.torque_nm.iter().copied(), height - 6.0, 6.0);
    let last = curve.measured.len().saturating_sub(1).max(1) as f64;
    let line = |values: &[f64], axis: &Axis| {
        let step = values.len().div_ceil(2 * POINTS).max(1);
        let mut text = String::new();
        for (index, value) in values.iter().enumerate().step_by(step) {
            let x = 4.0 + (width - 8.0) * index as f64 / last;
            let _ = write!(text, "{x:.1},{:.1} ", axis.at(*value));
        }
        text
    };
    let seconds = last * curve.interval_s;
    html! {
        figure.curves {
            figcaption {
                span.measured { "measured" } " and " span.simulated { "simulated" } " " (curve.quantity.name()) " [" (unit) "], "
                span.torque { "torque" } " [Nm], over " (format!("{seconds:.3}")) " s"
            }
            svg viewBox=(format!("0 0 {width} {height}")) role="img" aria-label=(format!("{} of {}", curve.quantity.name(), curve.id)) {
                polyline.torque points=(line(&curve.torque_nm, &torque)) {}
                polyline.measured points=(line(&curve.measured, &motion)) {}
                polyline.simulated points=(line(&curve.simulated, &motion)) {}
            }
        }
    }
}
