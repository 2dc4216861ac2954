//! Whether what is left is white: its correlation with itself later, and with the torque.

use crate::figure::{Axis, Figure, Mark, captioned, legend, linear_range};
use maud::{Markup, html};
use snug_campaign::ResidualCorrelation;

/// Both pictures with what they are good for.
pub fn figures(correlation: &ResidualCorrelation) -> Markup {
    html! {
        h4 { "Is what is left noise?" }
        p { "Of white noise nearly all correlations stay within the band. Where the residual follows the torque later, the model lacks \
            something that the torque sets going; where it goes before the torque, the torque is logged late or answers the motion." }
        div.figures { (drawings(correlation)) }
    }
}

/// The pictures alone.
pub fn drawings(correlation: &ResidualCorrelation) -> Markup {
    html! {
        (figure(
            "Residual with itself later",
            "Correlation of the residual with itself later, with the band of white noise",
            "later by [ms]",
            (&correlation.lag_s, &correlation.own),
            correlation.half_width,
        ))
        (figure(
            "Residual with the torque",
            "Correlation of the residual with the torque, later and earlier, with the band of white noise",
            "residual later than the torque by [ms]",
            (&correlation.torque_lag_s, &correlation.with_torque),
            correlation.half_width,
        ))
    }
}

fn figure(
    caption: &str,
    description: &str,
    axis: &str,
    (lags_s, values): (&[f64], &[f64]),
    half_width: f64,
) -> Markup {
    let points = lags_s.iter().zip(values);
    let points: Vec<(f64, f64)> = points.map(|(lag, value)| (1000.0 * lag, *value)).collect();
    let (left, right) = linear_range(points.iter().map(|(lag, _)| *lag), 0.0);
    let band = [-half_width, 0.0, half_width];
    let (low, high) = linear_range(values.iter().chain(&band).copied(), 0.06);
    let edge = |level: f64| vec![(left, level), (right, level)];
    let drawing = Figure {
        description: description.to_owned(),
        width: 520.0,
        height: 260.0,
        x: Axis::linear(axis, left, right, 6),
        y: Axis::linear("correlation", low, high, 6),
        marks: vec![
            Mark::Band("c-band", edge(-half_width), edge(half_width)),
            Mark::rule("c-zero", (left, right), (0.0, 0.0)),
            Mark::Line("c-simulated", points.into_iter().map(Some).collect()),
        ],
    };
    let key = [
        ("c-simulated", "residual"),
        ("c-band", "95 % of white noise"),
    ];
    captioned(caption, html! { (drawing.svg()) (legend(&key)) }, None)
}
