//! The force that would have to be added: over time with its band, and over displacement and velocity.

use super::force_map;
use crate::figure::{Axis, Figure, Mark, captioned, legend, linear_range};
use maud::{Markup, html};
use snug_campaign::{ForceCurve, ForceMap, Location};

/// Both pictures, those there are.
pub fn figures(location: &Location) -> Markup {
    let (curve, map) = (&location.force_over_time, &location.force_map);
    let (over_time, over_state) = (!curve.at.is_empty(), force_map::holds(map));
    if !over_time && !over_state {
        return html! {};
    }
    html! {
        h4 { "The missing force" }
        p { "The force between tool and hand that would have to be added so that the model met the measurement, averaged over \
            the tightenings. Its shape names the law: the same for going and coming back is a spring, one sign per direction of \
            motion is friction, a fixed time after the onset is a nerve." }
        (drawings(curve, map))
    }
}

/// The pictures alone.
pub fn drawings(curve: &ForceCurve, map: &ForceMap) -> Markup {
    html! {
        div.figures {
            @if !curve.at.is_empty() { (over_time_figure(curve)) }
            @if force_map::holds(map) { (force_map::figure(map)) }
        }
    }
}

fn over_time_figure(curve: &ForceCurve) -> Markup {
    let times: Vec<f64> = curve.at.iter().map(|time| 1000.0 * time).collect();
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        times.iter().copied().zip(values.iter().copied()).collect()
    };
    let all = [&curve.force_n, &curve.low_n, &curve.high_n];
    let (low, high) = linear_range(all.into_iter().flatten().copied().chain([0.0]), 0.06);
    let (start, end) = linear_range(times.iter().copied(), 0.0);
    let figure = Figure {
        description: "Missing force over time since the pulse began, with its 95 % band".into(),
        width: 520.0,
        height: 320.0,
        x: Axis::linear("time since the pulse began [ms]", start, end, 6),
        y: Axis::linear("missing force [N]", low, high, 6),
        marks: vec![
            Mark::Band("c-band", points(&curve.low_n), points(&curve.high_n)),
            Mark::rule("c-zero", (start, end), (0.0, 0.0)),
            Mark::Line(
                "c-rejected",
                points(&curve.force_n).into_iter().map(Some).collect(),
            ),
        ],
    };
    captioned(
        "Over time",
        html! { (figure.svg()) (legend(&[("c-rejected", "mean over tightenings"), ("c-band", "95 % band")])) },
        Some("Where the band holds zero, nothing is proven to be missing."),
    )
}
