//! Whose effect it is: the size of every group with its interval, one row a group.

use crate::figure::{Axis, Dot, Figure, Mark, Segment, captioned, legend, linear_range};
use crate::words::number::significant;
use maud::{Markup, html};
use snug_campaign::words::effect_name::unit_text;
use snug_campaign::{EffectParameter, GroupSize, GroupSizes};

/// Groups that a strip draws; of more those with most of the effect. Chosen.
const DRAWN: usize = 40;
/// Share of the axis that a whisker takes at its end which begins beyond it \[–\]. Chosen.
const STUB: f64 = 0.06;

/// A strip for each of the sizes that differ between groups; nothing where none does.
pub fn group_strips(parameters: &[EffectParameter]) -> Markup {
    html! {
        @for parameter in parameters {
            @if let Some(sizes) = &parameter.by_group { (strip(parameter, sizes)) }
        }
    }
}

fn strip(parameter: &EffectParameter, sizes: &GroupSizes) -> Markup {
    let mut drawn: Vec<&GroupSize> = sizes.groups.iter().collect();
    // Who has it stands on top, most of it first; paces, targets and times keep their order.
    if drawn.len() > DRAWN || sizes.factor.is_sample() {
        drawn.sort_by(|a, b| {
            let by_size = b.value.abs().total_cmp(&a.value.abs());
            b.present.cmp(&a.present).then(by_size)
        });
        drawn.truncate(DRAWN);
    }
    let unit = unit_text(&parameter.unit);
    let vanishes_without_end = drawn.iter().any(|one| one.is_without_end());
    let ended = drawn.iter().filter(|one| !one.is_without_end());
    let ends = ended.flat_map(|one| [one.low.unwrap_or(one.value), one.high.unwrap_or(one.value)]);
    let nothing = (!vanishes_without_end).then_some(0.0);
    let (low, high) = linear_range(ends.chain(nothing), 0.05);
    let bottom = 0.5 - drawn.len() as f64;
    let mut marks = Vec::new();
    if nothing.is_some() {
        marks.push(Mark::rule("c-zero", (0.0, 0.0), (0.5, bottom)));
    }
    let beyond = (high - STUB * (high - low), high);
    marks.extend(rows_of("c-quiet", &drawn, false, &unit, beyond));
    marks.extend(rows_of("c-selected", &drawn, true, &unit, beyond));
    let name = parameter.size().name;
    let rows: Vec<(String, bool)> = drawn.iter().map(|one| (one.group.clone(), false)).collect();
    let label = match unit.as_str() {
        "" => name.clone(),
        unit => format!("{name} [{unit}]"),
    };
    let figure = Figure {
        description: format!("{name} of every {} with its 95 % interval", sizes.factor),
        width: 440.0,
        height: 56.0 + 17.0 * rows.len() as f64,
        x: Axis::linear(label, low, high, 5),
        y: Axis::rows(&rows),
        marks,
    };
    let mut notes = Vec::new();
    if drawn.len() < sizes.groups.len() {
        let all = sizes.groups.len();
        notes.push(format!("The {DRAWN} of {all} with most of it are drawn."));
    }
    if vanishes_without_end {
        notes.push(format!(
            "The larger the {name}, the less there is of it; a line at the right end is beyond, and may be without end."
        ));
    }
    let note = (!notes.is_empty()).then(|| notes.join(" "));
    captioned(
        &format!(
            "{} by {}: {}",
            crate::words::quantity::capitalised(&name),
            sizes.factor,
            who(sizes)
        ),
        html! {
            (figure.svg())
            (legend(&[("c-selected", "has it"), ("c-quiet", "not told from nothing")]))
        },
        note.as_deref(),
    )
}

/// How many have it.
fn who(sizes: &GroupSizes) -> String {
    let all = sizes.groups.len();
    match sizes.groups.iter().filter(|one| one.present).count() {
        0 => format!("none of {all} plainly has it"),
        with if with == all => format!("all {all} have it"),
        with => format!("{with} of {all} have it"),
    }
}

/// Whiskers and dots of the groups that have it, or of those that have not; of what may be without end a whisker to
/// the axis' end, no shorter than `beyond`, which ends there.
fn rows_of(
    class: &'static str,
    drawn: &[&GroupSize],
    present: bool,
    unit: &str,
    beyond: (f64, f64),
) -> [Mark; 2] {
    let chosen = || {
        let rows = drawn.iter().enumerate();
        rows.filter(move |(_, one)| one.present == present)
            .map(|(row, one)| (-(row as f64), one))
    };
    let segments = chosen().filter_map(|(y, one)| {
        let x = match one.is_without_end() {
            true => (one.low?.min(beyond.0), beyond.1),
            false => (one.low?, one.high?),
        };
        Some(Segment { x, y: (y, y) })
    });
    let ended = chosen().filter(|(_, one)| !one.is_without_end());
    let dots = ended.map(|(y, one)| Dot {
        x: one.value,
        y,
        title: format!(
            "{}: {} {unit} in {} tightenings",
            one.group,
            significant(one.value, 3),
            one.tightenings
        ),
    });
    [
        Mark::Segments(class, segments.collect()),
        Mark::Dots(class, dots.collect()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::Factor;

    /// A second mass of 1.5 kg that one of two people has; of the other it would be heavier than 900 kg, at most without end.
    #[test]
    fn a_mass_that_may_be_without_end_does_not_stretch_the_axis_to_its_limit() {
        let group = |name: &str, value: f64, low: f64, high: Option<f64>| GroupSize {
            group: name.to_owned(),
            tightenings: 8,
            value,
            standard_error: None,
            shrunk: value,
            low: Some(low),
            high,
            present: high.is_some(),
        };
        let sizes = GroupSizes {
            factor: Factor::Participant,
            groups: vec![
                group("TP1", 1e6, 905.0, None),
                group("TP2", 1.5, 1.4, Some(1.6)),
            ],
            change: None,
        };
        let parameter = EffectParameter {
            name: "m2_kg".to_owned(),
            meaning: "second mass".to_owned(),
            unit: "kg".to_owned(),
            value: 1.5,
            low: Some(1.4),
            high: Some(1.6),
            standard_error: None,
            per_tightening: false,
            spread: None,
            minimum: 0.2,
            maximum: 20.0,
            by_group: Some(sizes),
        };
        let drawn = group_strips(&[parameter]).into_string();
        assert!(
            drawn.contains("1 of 2 have it") && drawn.contains("may be without end"),
            "{drawn}"
        );
        assert!(
            !drawn.contains("c-zero"),
            "nothing of it is not at 0: {drawn}"
        );
        assert!(
            drawn.contains("TP2: 1.50 kg") && !drawn.contains("TP1: "),
            "{drawn}"
        );
    }
}
