//! Curves over time, panel by panel: what the page's script draws, and a still picture where no script runs.

pub(crate) mod decimation;
pub(crate) mod traces_json;

use crate::figure::{Axis, Bar, Figure, Mark, captioned, legend, linear_range};
use maud::{Markup, html};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Digits that drawing and reading off need.
pub const DIGITS: i32 = 6;
/// Points of a curve in a still picture.
pub const STILL_POINTS: usize = 400;

/// What time counts from, unless a panel says otherwise.
const SINCE_START: &str = "time since the window's start";

/// Unit of a time axis of that length and how many of it one second has: milliseconds up to two seconds.
pub fn time_unit(length_s: f64) -> (&'static str, f64) {
    if length_s <= 2.0 {
        ("ms", 1000.0)
    } else {
        ("s", 1.0)
    }
}

/// From each kept sample to the next, the first from the window's start.
pub fn steps(kept: &[usize]) -> Vec<usize> {
    let mut previous = 0;
    kept.iter()
        .map(|index| index - std::mem::replace(&mut previous, *index))
        .collect()
}

/// JSON that can stand inside a `script` element whatever its text says.
pub fn embedded(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

/// One panel: curves of one unit over time.
pub struct Panel<S> {
    /// Heading.
    pub title: String,
    /// Vertical axis: quantity and unit.
    pub axis: String,
    /// Its curves, from back to front.
    pub series: Vec<Series<S>>,
    /// Whether it shows a residual, with the band of the noise behind it.
    pub residual: bool,
    /// What its time counts from, where that is not the window's start.
    pub time: Option<&'static str>,
}

/// One curve of a panel.
pub struct Series<S> {
    /// Name in the legend.
    pub label: Cow<'static, str>,
    /// Colour.
    pub class: &'static str,
    /// Where its values come from.
    pub source: S,
}

/// Values of one curve at the times that are drawn; `None` where not finite.
pub type Values = Vec<Option<f64>>;

/// What one tightening has to show in a panel.
pub struct Curves {
    /// What the picture shows, for readers who cannot see it.
    pub description: String,
    /// Times since the window's start, in the unit that `time_unit` names.
    pub times: Vec<f64>,
    /// Unit of the times.
    pub time_unit: &'static str,
    /// Values of every series; `None` for a signal that the tightening lacks.
    pub values: Vec<Option<Values>>,
    /// Half the height of the band of the noise behind a residual, in the signal's unit; `None` where it is not known.
    pub noise: Option<f64>,
    /// Text of the band under the pointer; none when empty.
    pub noise_title: String,
}

impl<S> Panel<S> {
    /// What the script needs to know of the panel.
    pub fn json(&self) -> Value {
        let series: Vec<Value> = self
            .series
            .iter()
            .map(|series| json!({ "label": series.label, "class": series.class }))
            .collect();
        json!({ "title": self.title, "axis": self.axis, "series": series, "residual": self.residual, "time": self.time })
    }

    /// The panel without JavaScript.
    pub fn still(&self, curves: Curves) -> Markup {
        let noise = curves.noise.filter(|_| self.residual);
        let values = curves.values.iter().flatten().flatten().flatten().copied();
        let band = noise.iter().flat_map(|noise| [-noise, *noise]);
        let (low, high) = linear_range(values.chain(band), 0.05);
        let end = curves.times.last().copied().unwrap_or(1.0);
        let mut entries: Vec<(&str, &str)> = self
            .series
            .iter()
            .map(|series| (series.class, &*series.label))
            .collect();
        let mut marks = Vec::new();
        if let Some(noise) = noise {
            entries.push(("c-band", "95 % of the noise"));
            let band = Bar {
                x: (0.0, end),
                y: (-noise, noise),
                title: curves.noise_title,
            };
            marks.push(Mark::Bars("c-band", vec![band]));
        }
        for (series, values) in self.series.iter().zip(curves.values) {
            if let Some(values) = values {
                let points = curves.times.iter().zip(values);
                let points = points.map(|(time, value)| Some((*time, value?)));
                marks.push(Mark::Line(series.class, points.collect()));
            }
        }
        let since = self.time.unwrap_or(SINCE_START);
        let time = format!("{since} [{}]", curves.time_unit);
        let figure = Figure {
            description: curves.description,
            width: 520.0,
            height: 260.0,
            x: Axis::linear(time, 0.0, end, 6),
            y: Axis::linear(&self.axis, low, high, 5),
            marks,
        };
        let drawing = html! { div data-panel="" { (figure.svg()) (legend(&entries)) } };
        captioned(&self.title, drawing, None)
    }
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
