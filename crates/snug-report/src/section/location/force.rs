//! The force that would have to be added: over time with its band, and over displacement and velocity.

use super::force_map;
use crate::figure::{Axis, Figure, Mark, captioned, legend, linear_range};
use maud::{Markup, html};
use snug_campaign::{ForceCurve, Location};

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
        div.figures {
            @if over_time { (over_time_figure(curve, None)) }
            @if over_state { (force_map::figure(map, false)) }
        }
    }
}

/// The pictures alone, beside what another model lacked before; a cell of the map can be chosen.
pub fn live(location: &Location, before: Option<&Location>) -> Markup {
    let (curve, map) = (&location.force_over_time, &location.force_map);
    let before = before.map(|before| &before.force_over_time);
    html! {
        @if !curve.at.is_empty() { (over_time_figure(curve, before)) }
        @if force_map::holds(map) { (force_map::figure(map, true)) }
    }
}

fn over_time_figure(curve: &ForceCurve, before: Option<&ForceCurve>) -> Markup {
    let times: Vec<f64> = curve.at.iter().map(|time| 1000.0 * time).collect();
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        times.iter().copied().zip(values.iter().copied()).collect()
    };
    let line = |curve: &ForceCurve| -> Vec<Option<(f64, f64)>> {
        let points = curve.at.iter().zip(&curve.force_n);
        points
            .map(|(at, force)| Some((1000.0 * at, *force)))
            .collect()
    };
    let all = [&curve.force_n, &curve.low_n, &curve.high_n];
    let was = before.iter().flat_map(|before| &before.force_n);
    let all = all.into_iter().flatten().chain(was).copied();
    let (low, high) = linear_range(all.chain([0.0]), 0.06);
    let (start, end) = linear_range(times.iter().copied(), 0.0);
    // As before and now are drawn in curves.
    let was = before.map(|before| Mark::Line("c-rejected", line(before)));
    let class = if before.is_some() {
        "c-simulated"
    } else {
        "c-rejected"
    };
    let figure = Figure {
        description: "Missing force over time since the pulse began, with its 95 % band".into(),
        width: 520.0,
        height: 320.0,
        x: Axis::linear("time since the pulse began [ms]", start, end, 6),
        y: Axis::linear("missing force [N]", low, high, 6),
        marks: [
            Mark::Band("c-band", points(&curve.low_n), points(&curve.high_n)),
            Mark::rule("c-zero", (start, end), (0.0, 0.0)),
        ]
        .into_iter()
        .chain(was)
        .chain([Mark::Line(class, line(curve))])
        .collect(),
    };
    let mut entries = vec![(class, "mean over tightenings"), ("c-band", "95 % band")];
    entries.extend(before.map(|_| ("c-rejected", "before the last click")));
    captioned(
        "Missing force over time",
        html! { (figure.svg()) (legend(&entries)) },
        Some("Where the band holds zero, nothing is proven to be missing."),
    )
}
