//! Data for the page's interactive viewer of curves, and a still picture of the first tightening where no script runs.

use super::{Render, Section, nothing};
use crate::curves::traces_json::{Example, Panel, examples, panels, residual_quantity};
use crate::curves::{Curves, STILL_POINTS, embedded};
use crate::words::number::{between, rounded, short, significant};
use crate::words::outcome::outcome_words;
use crate::words::quantity;
use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};
use snug_campaign::{CampaignResult, FitMeasures, NORMAL_95, TighteningResult};

/// Measured and simulated signals of single tightenings.
pub const SECTION: Section = Section {
    anchor: "tightening-figures",
    short_title: "Curve fits",
    title: "Model and measurement, tightening by tightening",
    render: Render::Always(render),
};

fn render(result: &CampaignResult) -> Markup {
    let examples = examples(result);
    let panels = panels(result);
    let Some(first) = examples.first() else {
        return nothing("No signals were kept for drawing.");
    };
    let data = json!({
        "panels": panels.iter().map(Panel::json).collect::<Vec<_>>(),
        "examples": examples.iter().map(|example| example_json(example, &panels, result)).collect::<Vec<_>>(),
    });
    html! {
        @if examples.len() < result.tightenings.len() {
            p { "Signals of " (examples.len()) " of " (result.tightenings.len()) " tightenings are kept here, evenly spread; the recording \
                holds every tightening, as many samples of it as the study's " code { "record" } " says." }
        }
        p.help.scripted {
            "Choose a tightening; point at a curve to read values; drag across to zoom, double-click to see all again. Keys in a \
            figure: ← → move the cursor, + − zoom, Esc shows all, n and p step through the tightenings."
        }
        div.viewer data-viewer="" {
            div.chooser.scripted {
                button type="button" data-step="-1" aria-label="previous tightening" { "‹" }
                label { span.hidden { "tightening" }
                    select data-choice="" {
                        @for (number, example) in examples.iter().enumerate() {
                            option value=(number) { (choice(&result.tightenings[example.tightening])) }
                        }
                    }
                }
                button type="button" data-step="1" aria-label="next tightening" { "›" }
            }
            p.current data-current="" aria-live="polite" { (heading(&result.tightenings[first.tightening], result)) }
            div.figures {
                @for panel in &panels { (still(panel, first, result)) }
                (facts_card(first, result))
            }
        }
        script type="application/json" id="viewer-data" { (PreEscaped(embedded(&data))) }
    }
}

fn choice(tightening: &TighteningResult) -> String {
    let mark = if tightening.selection.selected() {
        "✓"
    } else {
        "✗"
    };
    format!("{mark} {}", tightening.id)
}

/// Name, conditions and outcome in one line.
fn heading(tightening: &TighteningResult, result: &CampaignResult) -> String {
    let conditions = &tightening.conditions;
    let mut parts = vec![tightening.id.to_string()];
    parts.extend(
        [
            &conditions.participant,
            &conditions.strategy,
            &conditions.joint,
        ]
        .into_iter()
        .flatten()
        .cloned(),
    );
    if let Some(pace) = conditions.pace_per_min {
        parts.push(format!("{} per minute", short(pace)));
    }
    parts.push(format!(
        "peak {} {} {}",
        if result.units.input_is_torque() {
            "torque"
        } else {
            "input"
        },
        significant(tightening.peak_torque_nm * result.units.input_per_nm, 4),
        result.units.input
    ));
    parts.push(outcome_words(&tightening.selection.rejections));
    parts.join(" · ")
}

fn example_json(example: &Example, panels: &[Panel], result: &CampaignResult) -> Value {
    let tightening = &result.tightenings[example.tightening];
    let mut value = example.json(panels);
    value["heading"] = json!(heading(tightening, result));
    value["noise"] = json!(noise_band(tightening, result));
    value["facts"] = json!(facts(tightening, result));
    value["note"] = json!(note(example, tightening, result));
    value
}

/// 1.96 standard deviations of the noise of the quantity whose residual is drawn; `None` when it is not known.
pub(super) fn noise_band(tightening: &TighteningResult, result: &CampaignResult) -> Option<f64> {
    tightening
        .noise
        .as_ref()
        .filter(|noise| noise.quantity == residual_quantity(result))
        .map(|noise| NORMAL_95 * noise.standard_deviation * result.units.output_per_rad)
        .filter(|band| band.is_finite())
}

/// Where the window begins and how large the noise is.
fn note(example: &Example, tightening: &TighteningResult, result: &CampaignResult) -> String {
    let mut text = format!(
        "The window begins {} s after the segment's start.",
        significant(example.start_s(), 4)
    );
    if let Some(noise) = &tightening.noise {
        text += &format!(
            " Noise of the fitted output: standard deviation {} {}.",
            significant(noise.standard_deviation * result.units.output_per_rad, 3),
            result.units.motion(noise.quantity)
        );
    }
    text
}

/// A panel without JavaScript: the first example, all of it.
fn still(panel: &Panel, example: &Example, result: &CampaignResult) -> Markup {
    let example = example.coarser(STILL_POINTS);
    let tightening = &result.tightenings[example.tightening];
    panel.still(Curves {
        description: format!("{} of {}", panel.title, tightening.id),
        times: example.times().collect(),
        time_unit: example.time_unit().0,
        values: example.signals(panel),
        noise: noise_band(tightening, result),
        noise_title: String::new(),
    })
}

/// What was found out about one tightening: name, value with unit, interval.
fn facts(tightening: &TighteningResult, result: &CampaignResult) -> Vec<[String; 3]> {
    let mut facts = Vec::new();
    for parameter in tightening
        .estimate
        .iter()
        .flat_map(|estimate| &estimate.parameters)
    {
        let name = quantity::name(&parameter.name, result);
        let shown = rounded(parameter.value, parameter.interval);
        let interval = match shown.interval {
            Some(interval) => interval,
            None if parameter.fixed => "held fixed".into(),
            None => "no interval".into(),
        };
        facts.push([
            format!("{} {}", name.words, name.symbol).trim_end().into(),
            format!("{} {}", shown.value, name.unit),
            interval,
        ]);
    }
    facts.extend(derived_facts(tightening));
    facts.extend(agreement_facts(&tightening.measures, result));
    facts
}

/// What follows from the parameters, with its interval.
fn derived_facts(tightening: &TighteningResult) -> impl Iterator<Item = [String; 3]> {
    let measures = &tightening.measures;
    // Where all inertia is identified there is no tool beside it.
    let of_what = match tightening.rig.known_inertia_kg_m2 > 0.0 {
        true => " with the tool",
        false => "",
    };
    [
        (
            "natural frequency fₙ",
            "",
            measures.natural_frequency_hz,
            between(
                measures.natural_frequency_low_hz,
                measures.natural_frequency_high_hz,
            ),
            "Hz",
        ),
        (
            "damped frequency",
            of_what,
            measures.damped_frequency_hz,
            between(
                measures.damped_frequency_low_hz,
                measures.damped_frequency_high_hz,
            ),
            "Hz",
        ),
        (
            "damping ratio ζ",
            of_what,
            measures.damping_ratio,
            between(measures.damping_ratio_low, measures.damping_ratio_high),
            "",
        ),
    ]
    .into_iter()
    .filter_map(|(name, of_what, value, interval, unit)| {
        let value = value.filter(|value| value.is_finite())?;
        let shown = rounded(value, interval);
        Some([
            format!("{name}{of_what}"),
            format!("{} {unit}", shown.value),
            shown.interval.unwrap_or_else(|| "no interval".into()),
        ])
    })
}

/// How model and measurement agree in this window, and its largest forces.
fn agreement_facts(measures: &FitMeasures, result: &CampaignResult) -> Vec<[String; 3]> {
    const WINDOW: &str = "of this window";
    const LARGEST: &str = "largest of this window";
    let rms = measures
        .rms_displacement_rad
        .map(|rms| rms * result.units.output_per_rad);
    let mut rows = vec![
        ("fit of the displacement", measures.fit_percent, "%", WINDOW),
        (
            "fit of the fitted output",
            measures.fit_percent_fitted_output,
            "%",
            WINDOW,
        ),
        (
            "rms residual of the displacement",
            rms,
            result.units.output.as_str(),
            WINDOW,
        ),
        (
            "error over noise",
            measures.error_over_noise,
            "× noise",
            WINDOW,
        ),
        (
            "accuracy of the Euler method",
            measures.euler_accuracy_percent,
            "%",
            WINDOW,
        ),
    ];
    if result.units.input_is_torque() {
        rows.extend([
            ("|F1|", measures.peak_force_f1_n, "N", LARGEST),
            ("|F2|", measures.peak_force_f2_n, "N", LARGEST),
            ("|F3|", measures.peak_force_f3_n, "N", LARGEST),
            ("|F_op_J|", measures.peak_grip_force_n, "N", LARGEST),
        ]);
    }
    rows.into_iter()
        .filter_map(|(name, value, unit, of_what)| {
            let value = value.filter(|value| value.is_finite())?;
            let text = format!("{} {unit}", significant(value, 3));
            Some([name.into(), text, of_what.into()])
        })
        .collect()
}

fn facts_card(example: &Example, result: &CampaignResult) -> Markup {
    let tightening = &result.tightenings[example.tightening];
    html! {
        figure.facts {
            figcaption { "Estimate with 95 % intervals" }
            table { tbody data-facts="" {
                @for [name, value, interval] in facts(tightening, result) {
                    tr { th scope="row" { (name) } td { (value) } td.interval { (interval) } }
                }
            } }
            p.note data-note="" { (note(example, tightening, result)) }
        }
    }
}
