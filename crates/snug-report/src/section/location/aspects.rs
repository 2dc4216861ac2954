//! The misfit along every way of looking, as small pictures of one kind.

use crate::figure::{Axis, Dot, Figure, Mark, Segment, captioned};
use crate::section::headings;
use crate::words::number::{measured, missing, percent, short, significant};
use maud::{Markup, html};
use snug_campaign::{Aspect, Share, SignalUnits};

/// More parts than this are drawn along an axis instead of as rows.
const MOST_ROWS: usize = 12;
/// From where on times are told in seconds \[s\], and places in the output's own unit: in a thousandth of it they have five digits.
const LONG_S: f64 = 10.0;
const FAR: f64 = 10.0;

/// The small pictures and, folded away, their numbers.
pub fn figures(aspects: &[Aspect], units: &SignalUnits) -> Markup {
    if aspects.iter().all(|aspect| aspect.parts.is_empty()) {
        return html! {};
    }
    html! {
        p { "How far the model misses the measurement in each part of the data, as a multiple of the noise there, with 95 % \
            intervals; the green line at 1 is nothing but noise. Every picture ends where its data end. The percentage beside a part is its share of everything \
            beyond the noise." }
        div.figures.small {
            @for aspect in aspects.iter().filter(|aspect| !aspect.parts.is_empty()) { (picture(aspect, units)) }
        }
        details {
            summary { "The same in numbers" }
            (table(aspects, units))
        }
    }
}

/// The largest error that a picture of its parts shows, ends of intervals among them: its axis ends there.
fn largest(aspect: &Aspect) -> f64 {
    let errors = aspect.parts.iter().flat_map(|part| {
        [
            Some(part.error_over_noise),
            part.interval.map(|one| one.high),
        ]
    });
    let finite = errors.flatten().filter(|error| error.is_finite());
    finite.fold(1.2, f64::max)
}

/// What an aspect is called, and the factor and unit that its edges are shown in.
struct Heading {
    title: String,
    factor: f64,
    unit: String,
}

impl Heading {
    /// `target torque [Nm]`: its unit stays as it is.
    fn in_a_sentence(&self) -> String {
        let mut letters = self.title.chars();
        letters.next().map_or_else(String::new, |first| {
            first.to_lowercase().chain(letters).collect()
        })
    }
}

fn heading(aspect: &Aspect, units: &SignalUnits) -> Heading {
    let edges = aspect.parts.iter().flat_map(|part| [part.from, part.to]);
    let largest = edges.flatten().filter(|edge| edge.is_finite());
    let largest = largest.fold(0.0, |largest: f64, edge| largest.max(edge.abs()));
    let (title, factor, unit): (String, f64, &str) = match aspect.aspect.as_str() {
        "time_since_onset_s" if largest >= LONG_S => {
            ("Time since the pulse began".into(), 1.0, "s")
        }
        "time_since_onset_s" => ("Time since the pulse began".into(), 1000.0, "ms"),
        "phase" => ("Phase of the pulse".into(), 1.0, ""),
        "frequency_hz" => ("Frequency".into(), 1.0, "Hz"),
        "amplitude_rad" if largest >= FAR => ("Displacement".into(), 1.0, &units.output),
        "amplitude_rad" => ("Displacement".into(), 1000.0, &format!("m{}", units.output)),
        "participant" => ("Participant".into(), 1.0, ""),
        "strategy" => ("Strategy".into(), 1.0, ""),
        "joint" => ("Joint".into(), 1.0, ""),
        "pace_per_min" => ("Pace [1/min]".into(), 1.0, ""),
        "target_torque_nm" => (format!("Target torque [{}]", units.input), 1.0, ""),
        other => (other.replace('_', " "), 1.0, ""),
    };
    Heading {
        title,
        factor,
        unit: unit.to_owned(),
    }
}

fn picture(aspect: &Aspect, units: &SignalUnits) -> Markup {
    let largest = largest(aspect);
    let heading = heading(aspect, units);
    let ranged = aspect
        .parts
        .iter()
        .all(|part| part.from.is_some() && part.to.is_some());
    let drawing = if ranged && aspect.parts.len() > MOST_ROWS {
        along(aspect, largest, &heading)
    } else {
        in_rows(aspect, largest, &heading)
    };
    captioned(&heading.title, drawing, None)
}

/// A part's name, its edges in the aspect's unit.
fn part_name(part: &Share, heading: &Heading) -> String {
    let Heading { factor, unit, .. } = heading;
    let edge = |value: f64| short(factor * value);
    match (part.from, part.to) {
        (Some(from), Some(to)) if to.is_finite() => format!("{}–{} {unit}", edge(from), edge(to))
            .trim_end()
            .into(),
        (Some(from), _) => format!("from {} {unit}", edge(from)).trim_end().into(),
        (None, Some(to)) => format!("to {} {unit}", edge(to)).trim_end().into(),
        (None, None) => part.part.replace('_', " "),
    }
}

fn spoken(name: &str, part: &Share) -> String {
    format!(
        "{name}: {} times the noise, {} of the excess",
        significant(part.error_over_noise, 3),
        percent(part.share_of_excess)
    )
}

fn in_rows(aspect: &Aspect, largest: f64, heading: &Heading) -> Markup {
    let names: Vec<String> = aspect
        .parts
        .iter()
        .map(|part| part_name(part, heading))
        .collect();
    let rows: Vec<(String, bool)> = aspect
        .parts
        .iter()
        .zip(&names)
        .map(|(part, name)| {
            // Adding zero takes the sign off a negative one.
            let share = (100.0 * part.share_of_excess).round() + 0.0;
            let share = if share.is_finite() {
                format!(" · {share:.0} %")
            } else {
                String::new()
            };
            (name.clone() + &share.replace('-', "−"), false)
        })
        .collect();
    let count = rows.len();
    let at = |row: usize| -(row as f64);
    let whiskers = aspect.parts.iter().enumerate().filter_map(|(row, part)| {
        let interval = part.interval?;
        Some(Segment {
            x: (interval.low, interval.high),
            y: (at(row), at(row)),
        })
    });
    let dots = aspect.parts.iter().enumerate().map(|(row, part)| Dot {
        x: part.error_over_noise,
        y: at(row),
        title: spoken(&names[row], part),
    });
    Figure {
        description: format!("Error over noise by {}", heading.in_a_sentence()),
        width: 300.0,
        height: 60.0 + 22.0 * count.max(3) as f64,
        x: Axis::logarithmic("error over noise [×]", 0.85, 1.08 * largest),
        y: Axis::rows(&rows),
        marks: marks(
            whiskers.collect(),
            dots.collect(),
            Mark::rule("c-floor", (1.0, 1.0), (0.5, 0.5 - count as f64)),
        ),
    }
    .svg()
}

fn along(aspect: &Aspect, largest: f64, heading: &Heading) -> Markup {
    let edges = |part: &Share| {
        let (from, to) = part
            .from
            .zip(part.to)
            .expect("only parts with edges are drawn along an axis");
        (heading.factor * from, heading.factor * to)
    };
    let (start, _) = edges(&aspect.parts[0]);
    let (_, end) = edges(&aspect.parts[aspect.parts.len() - 1]);
    let middle = |part: &Share| 0.5 * (edges(part).0 + edges(part).1);
    let whiskers = aspect.parts.iter().filter_map(|part| {
        let interval = part.interval?;
        Some(Segment {
            x: (middle(part), middle(part)),
            y: (interval.low, interval.high),
        })
    });
    let dots = aspect.parts.iter().map(|part| Dot {
        x: middle(part),
        y: part.error_over_noise,
        title: spoken(&part_name(part, heading), part),
    });
    let floor = Mark::rule("c-floor", (start, end), (1.0, 1.0));
    Figure {
        description: format!("Error over noise by {}", heading.in_a_sentence()),
        width: 300.0,
        height: 60.0 + 22.0 * 5.0,
        x: Axis::linear(
            format!("{} [{}]", heading.in_a_sentence(), heading.unit),
            start,
            end,
            5,
        ),
        y: Axis::logarithmic("error over noise [×]", 0.85, 1.08 * largest),
        marks: marks(whiskers.collect(), dots.collect(), floor),
    }
    .svg()
}

fn marks(whiskers: Vec<Segment>, dots: Vec<Dot>, floor: Mark) -> Vec<Mark> {
    vec![
        floor,
        Mark::Segments("c-rejected", whiskers),
        Mark::Dots("c-rejected", dots),
    ]
}

fn table(aspects: &[Aspect], units: &SignalUnits) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Where the model fails, in numbers" { table {
            (headings(&["part", "error over noise [×], 95 % interval", "share of the excess", "samples"]))
            @for aspect in aspects {
                @let heading = &heading(aspect, units);
                tbody {
                    tr.group { th colspan="4" scope="rowgroup" { (heading.title) } }
                    @for part in &aspect.parts { tr {
                        th scope="row" { (part_name(part, heading)) }
                        td { (measured(Some(part.error_over_noise), part.interval, "no sample falls there")) }
                        td { @if part.share_of_excess.is_finite() { (percent(part.share_of_excess)) } @else { (missing("no sample falls there")) } }
                        td { (part.samples) }
                    } }
                }
            }
        } }
    }
}
