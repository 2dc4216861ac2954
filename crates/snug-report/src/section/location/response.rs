//! How the motion answers the torque over frequency: gain, phase and coherence, measured beside simulated.

use crate::figure::{Axis, Figure, Mark, captioned, legend, linear_range};
use crate::words::quantity::capitalised;
use maud::{Markup, html};
use snug_campaign::{FrequencyResponse, Response, SignalUnits};
use std::f64::consts::{PI, TAU};

/// The pictures with what they are good for.
pub fn figures(response: &FrequencyResponse, units: &SignalUnits) -> Markup {
    html! {
        h4 { "The response over frequency" }
        p { "How strongly and how late the motion answers the torque at each frequency (Bode), over all tightenings. Measured and simulated \
            motion go through the same estimate, so that where the curves part the model is wrong there: at low frequencies its stiffness, \
            about the resonance its damping, at high ones its mass." }
        div.figures { (drawings(response, None, units)) }
    }
}

/// The pictures alone, beside another model `before`.
pub fn drawings(
    response: &FrequencyResponse,
    before: Option<&FrequencyResponse>,
    units: &SignalUnits,
) -> Markup {
    let before = before.filter(|before| before.frequency_hz == response.frequency_hz);
    html! {
        (gain(response, before, units))
        (phase(response, before))
        (coherence(response))
    }
}

/// What is said in their place where there is nothing to draw.
pub fn none() -> Markup {
    html! {
        p.note { "No response over frequency is drawn: too few frequencies at which the motion follows the torque coherently. Noise, feedback or a             law that is far from linear does that." }
    }
}

/// Points over frequency.
type Points = Vec<(f64, f64)>;

fn points(response: &FrequencyResponse, values: impl IntoIterator<Item = f64>) -> Points {
    response.frequency_hz.iter().copied().zip(values).collect()
}

fn line(class: &'static str, points: Points) -> Mark {
    Mark::Line(class, points.into_iter().map(Some).collect())
}

/// From the lowest to the highest frequency.
fn frequencies(response: &FrequencyResponse) -> Axis {
    let end = |at: Option<&f64>| at.copied().unwrap_or(1.0);
    let (low, high) = (
        end(response.frequency_hz.first()),
        end(response.frequency_hz.last()),
    );
    Axis::logarithmic("frequency [Hz]", low, high)
}

/// The models that are drawn, as everywhere: the present one blue, the one before orange, a single one as it is told alone.
fn models<'a>(
    response: &'a FrequencyResponse,
    before: Option<&'a FrequencyResponse>,
) -> Vec<(&'static str, &'static str, &'a FrequencyResponse)> {
    let now = |label| ("c-simulated", label, response);
    match before {
        Some(before) => vec![("c-rejected", "before the last click", before), now("now")],
        None => vec![now("simulated")],
    }
}

fn gain(
    response: &FrequencyResponse,
    before: Option<&FrequencyResponse>,
    units: &SignalUnits,
) -> Markup {
    let scale = units.output_per_rad / units.input_per_nm;
    let gains = |all: &[Response]| -> Vec<f64> { all.iter().map(|one| scale * one.gain).collect() };
    let measured = points(response, gains(&response.measured));
    let ends = |end: &dyn Fn(usize) -> Option<f64>| -> Points {
        let ends = (0..measured.len()).map(|at| end(at).map_or(measured[at].1, |end| scale * end));
        points(response, ends)
    };
    let low = ends(&|at| response.gain_interval[at].map(|interval| interval.low));
    let high = ends(&|at| response.gain_interval[at].map(|interval| interval.high));
    let mut marks = vec![
        Mark::Band("c-band", low, high),
        line("c-measured", measured.clone()),
    ];
    let mut shown: Vec<f64> = measured.iter().map(|point| point.1).collect();
    let mut key = vec![("c-measured", "measured"), ("c-band", "95 % interval")];
    for (class, label, model) in models(response, before) {
        let gains = gains(&model.simulated);
        shown.extend(&gains);
        key.push((class, label));
        marks.push(line(class, points(model, gains)));
    }
    let least = shown.iter().copied().fold(f64::INFINITY, f64::min);
    let most = shown.iter().copied().fold(0.0, f64::max);
    let name = capitalised(response.quantity.name());
    let figure = Figure {
        description: "Gain from the torque to the motion over frequency, measured and simulated"
            .into(),
        width: 520.0,
        height: 300.0,
        x: frequencies(response),
        y: Axis::logarithmic(
            format!(
                "gain [({})/{}]",
                units.motion(response.quantity),
                units.input
            ),
            0.8 * least,
            1.25 * most,
        ),
        marks,
    };
    let note = format!(
        "The windows tell frequencies apart that are {} Hz from each other; a resonance narrower than that looks broader, in the model as in the \
         measurement.",
        crate::words::number::significant(response.resolution_hz, 2)
    );
    captioned(
        &format!("{name}: gain over frequency"),
        html! { (figure.svg()) (legend(&key)) },
        Some(&note),
    )
}

/// Angles that follow one another without a jump of a whole turn.
fn unwrapped(all: &[Response]) -> Vec<f64> {
    let mut last = 0.0;
    (all.iter())
        .map(|one| {
            last = nearest(one.phase_rad, last);
            last
        })
        .collect()
}

/// The same angle within half a turn of another \[rad\].
fn nearest(phase_rad: f64, to_rad: f64) -> f64 {
    phase_rad - TAU * ((phase_rad - to_rad) / TAU).round()
}

fn phase(response: &FrequencyResponse, before: Option<&FrequencyResponse>) -> Markup {
    const DEGREES: f64 = 180.0 / PI;
    let now = unwrapped(&response.simulated);
    let beside = |all: &[Response]| -> Vec<f64> {
        let pairs = all.iter().zip(&now);
        pairs
            .map(|(one, now)| DEGREES * nearest(one.phase_rad, *now))
            .collect()
    };
    let mut series = vec![("c-measured", "measured", beside(&response.measured))];
    for (class, label, model) in models(response, before) {
        series.push((class, label, beside(&model.simulated)));
    }
    let all = series.iter().flat_map(|(_, _, values)| values).copied();
    let (low, high) = linear_range(all, 0.06);
    let figure = Figure {
        description: "Phase from the torque to the motion over frequency, measured and simulated"
            .into(),
        width: 520.0,
        height: 260.0,
        x: frequencies(response),
        y: Axis::linear("phase [°]", low, high, 6),
        marks: (series.iter())
            .map(|(class, _, values)| line(class, points(response, values.iter().copied())))
            .collect(),
    };
    let key: Vec<(&str, &str)> = series
        .iter()
        .map(|(class, label, _)| (*class, *label))
        .collect();
    captioned(
        "Phase over frequency",
        html! { (figure.svg()) (legend(&key)) },
        None,
    )
}

fn coherence(response: &FrequencyResponse) -> Markup {
    let known = (response.frequency_hz.iter().zip(&response.coherence))
        .map(|(&frequency_hz, &coherence)| Some((frequency_hz, coherence?)));
    let figure = Figure {
        description: "Coherence of torque and measured motion over frequency".into(),
        width: 520.0,
        height: 260.0,
        x: frequencies(response),
        y: Axis::linear("coherence", 0.0, 1.0, 5),
        marks: vec![Mark::Line("c-measured", known.collect())],
    };
    captioned(
        "Coherence of torque and motion",
        html! { (figure.svg()) (legend(&[("c-measured", "measured")])) },
        Some(
            "1 where the motion follows the torque in the same linear way in every tightening; less where noise, a difference between \
             tightenings or a law that is not linear has a part.",
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_phase_goes_on_beyond_half_a_turn() {
        let at = |degrees: f64| Response {
            gain: 1.0,
            phase_rad: degrees * PI / 180.0,
        };
        let found = unwrapped(&[at(-170.0), at(175.0), at(150.0)]);
        let degrees: Vec<f64> = found.iter().map(|one| (one * 180.0 / PI).round()).collect();
        assert_eq!(degrees, [-170.0, -185.0, -210.0]);
    }
}
