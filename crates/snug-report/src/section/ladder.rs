//! Every model of the ladder with its error in fitted and in held-out data, and the share of tightenings it can use.

use super::{Render, Section};
use crate::figure::{Axis, Bar, Dot, Figure, Mark, captioned, legend};
use crate::words::number::{percent, plain, significant};
use maud::{Markup, html};
use snug_campaign::words::effect_name::unit_text;
use snug_campaign::{CampaignResult, Diagnosis, Rung, Verdict};

/// How the error falls, effect by effect.
pub const SECTION: Section = Section {
    anchor: "ladder",
    short_title: "Error ladder",
    title: "How the error falls",
    render: Render::Diagnosed(render),
};

/// Height of a rung's row \[px\]. Chosen.
const ROW: f64 = 46.0;

/// A way of holding data out: its colour, its place in the row, its words, its number.
struct View {
    class: &'static str,
    offset: f64,
    words: &'static str,
    read: fn(&Rung) -> Option<f64>,
}

const VIEWS: [View; 3] = [
    View {
        class: "c-purple",
        offset: -0.1,
        words: "tightenings held out",
        read: |rung| rung.heldout_error_over_noise,
    },
    View {
        class: "c-amber",
        offset: -0.22,
        words: "target torques held out",
        read: |rung| rung.heldout_target_error_over_noise,
    },
    View {
        class: "c-rejected",
        offset: -0.34,
        words: "participants held out",
        read: |rung| rung.heldout_participant_error_over_noise,
    },
];

fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    let rungs = &diagnosis.ladder;
    if rungs.is_empty() {
        return None;
    }
    let names = diagnosis.rung_names();
    let known = rungs.iter().any(|rung| rung.error_over_noise.is_some());
    let unit = output_unit(diagnosis);
    let error = if known {
        error_figure(rungs, &names)
    } else {
        rms_figure(rungs, &names, &unit)
    };
    Some(html! {
        @if known {
            p { "Each row is one model. The bar is what it leaves, as a multiple of the measurement noise: at 1.0, the thick line, \
                nothing but noise is left. The dots are the same in data that took no part in fixing the effects' sizes: \
                if they stay near the bar's end, the effect is a law and not an accident of these data." }
        } @else {
            p { "Each row is one model. The bar is what it leaves; how much of that is noise is not known." }
        }
        div.figures.ladder {
            (error)
            (selected_figure(rungs, &names))
        }
        (promised(diagnosis))
        (table(rungs, &names, &unit, &result.units.output))
    })
}

/// What the effect that the verdict names would make of the error.
fn promised(diagnosis: &Diagnosis) -> Markup {
    let first = diagnosis
        .ranking
        .first()
        .filter(|_| diagnosis.verdict == Verdict::MissingEffect)
        .and_then(|first| Some((first, first.error_over_noise?)));
    html! {
        @if let Some((first, error)) = first {
            p { "With " strong { (diagnosis.called(&first.effect)) } " in the model, the error would be " strong { (significant(error, 4)) }
                " times the noise." }
        }
    }
}

fn output_unit(diagnosis: &Diagnosis) -> String {
    let compared =
        |misfit: &&snug_campaign::Misfit| diagnosis.compared_output.contains(&misfit.quantity);
    diagnosis
        .comparison
        .pooled
        .iter()
        .find(compared)
        .map_or_else(|| "output's unit".into(), |misfit| unit_text(&misfit.unit))
}

fn rows(names: &[String]) -> Axis {
    let rows: Vec<(String, bool)> = names
        .iter()
        .map(|name| {
            let short: String = name.chars().take(30).collect();
            let cut = if short.len() < name.len() { "…" } else { "" };
            (short + cut, false)
        })
        .collect();
    Axis::rows(&rows)
}

fn height(names: &[String]) -> f64 {
    62.0 + ROW * names.len().max(2) as f64
}

fn error_figure(rungs: &[Rung], names: &[String]) -> Markup {
    let (low, high) = error_scale(rungs);
    let left = |rung: &Rung| rung.error_over_noise;
    let mut marks = vec![
        Mark::Bars("c-faint", bars(rungs, low, left, "error over noise")),
        Mark::rule("c-floor thick", (1.0, 1.0), (0.5, 0.5 - rungs.len() as f64)),
    ];
    let mut entries = vec![
        ("c-faint", "all tightenings"),
        ("c-floor", "nothing but noise"),
    ];
    for view in &VIEWS {
        let dots = view.dots(rungs, names);
        if !dots.is_empty() {
            entries.push((view.class, view.words));
            marks.push(Mark::Dots(view.class, dots));
        }
    }
    let figure = Figure {
        description: "Error over noise of each model of the ladder".into(),
        width: 520.0,
        height: height(names),
        x: Axis::logarithmic("error over noise [× noise]", low, high),
        y: rows(names),
        marks,
    };
    captioned(
        "Error over noise",
        html! { (figure.svg()) (legend(&entries)) },
        None,
    )
}

/// Both ends of the scale: a little beyond every error, and the noise always on it.
fn error_scale(rungs: &[Rung]) -> (f64, f64) {
    let errors = || {
        rungs.iter().flat_map(|rung| {
            let held_out = VIEWS.iter().filter_map(|view| (view.read)(rung));
            held_out.chain(rung.error_over_noise)
        })
    };
    let largest = errors()
        .filter(|error| error.is_finite())
        .fold(1.1, f64::max);
    let smallest = errors().filter(|error| *error > 0.0).fold(0.96, f64::min);
    (smallest, 1.08 * largest)
}

impl View {
    /// One dot per model for which it could be told.
    fn dots(&self, rungs: &[Rung], names: &[String]) -> Vec<Dot> {
        let rows = rungs.iter().zip(names).enumerate();
        rows.filter_map(|(row, (rung, name))| {
            let value = (self.read)(rung)?;
            let error = significant(value, 4);
            Some(Dot {
                x: value,
                y: -(row as f64) + self.offset,
                title: format!("{name}, {}: {error} times the noise", self.words),
            })
        })
        .collect()
    }
}

fn bars(rungs: &[Rung], from: f64, read: fn(&Rung) -> Option<f64>, what: &str) -> Vec<Bar> {
    rungs
        .iter()
        .enumerate()
        .filter_map(|(row, rung)| {
            let value = read(rung)?;
            Some(Bar {
                x: (from, value),
                y: (-(row as f64) - 0.02, -(row as f64) + 0.34),
                title: format!("{what} {}", significant(value, 4)),
            })
        })
        .collect()
}

fn rms_figure(rungs: &[Rung], names: &[String], unit: &str) -> Markup {
    let largest = rungs
        .iter()
        .map(|rung| rung.rms_fitted_output)
        .filter(|rms| rms.is_finite())
        .fold(0.0, f64::max);
    let axis = format!("root mean square of the residual [{unit}]");
    bar_figure(
        "What the model leaves",
        "Residual of each model of the ladder",
        Axis::linear(axis, 0.0, 1.06 * largest, 5),
        names,
        bars(rungs, 0.0, |rung| Some(rung.rms_fitted_output), "residual"),
    )
}

fn selected_figure(rungs: &[Rung], names: &[String]) -> Markup {
    let selected = |rung: &Rung| Some(100.0 * rung.selected_fraction);
    bar_figure(
        "Usable tightenings",
        "Share of tightenings selected with each model of the ladder",
        Axis::linear("tightenings selected [%]", 0.0, 100.0, 5),
        names,
        bars(rungs, 0.0, selected, "selected, percent:"),
    )
}

fn bar_figure(heading: &str, shows: &str, x: Axis, names: &[String], bars: Vec<Bar>) -> Markup {
    let figure = Figure {
        description: shows.into(),
        width: 520.0,
        height: height(names),
        x,
        y: rows(names),
        marks: vec![Mark::Bars("c-selected", bars)],
    };
    captioned(heading, figure.svg(), None)
}

fn table(rungs: &[Rung], names: &[String], unit: &str, displacement: &str) -> Markup {
    let unknown = "the noise is not known";
    let apart = "fewer than two groups to hold out, or the noise is not known";
    html! {
        div.scroll tabindex="0" role="region" aria-label="The ladder in numbers" { table.rungs {
            caption { "The ladder in numbers. Error over noise has no unit: it is a multiple of the measurement noise." }
            thead {
                tr {
                    th rowspan="2" scope="col" { "model" }
                    th colspan="4" scope="colgroup" { "error over noise [×]" }
                    th colspan="2" scope="colgroup" { "residual, root mean square" }
                    th rowspan="2" scope="col" { "median fit of the displacement [%]" }
                    th rowspan="2" scope="col" { "selected" }
                }
                tr {
                    @for heading in ["all", "tightenings held out", "targets held out", "participants held out"] { th scope="col" { (heading) } }
                    th scope="col" { "fitted output [" (unit) "]" }
                    th scope="col" { "displacement [" (displacement) "]" }
                }
            }
            tbody { @for (rung, name) in rungs.iter().zip(names) { tr {
                th scope="row" { (name) }
                td { (plain(rung.error_over_noise, 4, unknown)) }
                td { (plain(rung.heldout_error_over_noise, 4, unknown)) }
                td { (plain(rung.heldout_target_error_over_noise, 4, apart)) }
                td { (plain(rung.heldout_participant_error_over_noise, 4, apart)) }
                td { (plain(Some(rung.rms_fitted_output), 4, "not finite")) }
                td { (plain(rung.rms_displacement_rad, 3, "no displacement to compare with")) }
                td { (plain(rung.fit_percent_median, 4, "no displacement to compare with")) }
                td { (percent(rung.selected_fraction)) }
            } } }
        } }
    }
}
