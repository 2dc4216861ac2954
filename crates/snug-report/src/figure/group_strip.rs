//! Whose effect it is: the size of every group with its interval, one row a group.

use crate::figure::{Axis, Dot, Figure, Mark, Segment, captioned, legend, linear_range};
use crate::words::number::significant;
use maud::{Markup, html};
use snug_campaign::words::effect_name::unit_text;
use snug_campaign::{EffectParameter, GroupSize, GroupSizes};

/// Groups that a strip draws; of more those with most of the effect. Chosen.
const DRAWN: usize = 40;

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
    let ends = drawn.iter().flat_map(|one| {
        let low = one.low.unwrap_or(one.value);
        match one.is_without_end() {
            true => [low, low, 0.0],
            false => [low, one.high.unwrap_or(one.value), 0.0],
        }
    });
    let (low, high) = linear_range(ends, 0.05);
    let bottom = 0.5 - drawn.len() as f64;
    let mut marks = vec![Mark::rule("c-zero", (0.0, 0.0), (0.5, bottom))];
    marks.extend(rows_of("c-quiet", &drawn, false, &unit, high));
    marks.extend(rows_of("c-selected", &drawn, true, &unit, high));
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
    let note = (drawn.len() < sizes.groups.len()).then(|| {
        format!(
            "The {DRAWN} of {} with most of it are drawn.",
            sizes.groups.len()
        )
    });
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

/// Whiskers and dots of the groups that have it, or of those that have not; of what may be without end a whisker to the axis' end.
fn rows_of(
    class: &'static str,
    drawn: &[&GroupSize],
    present: bool,
    unit: &str,
    end: f64,
) -> [Mark; 2] {
    let chosen = || {
        let rows = drawn.iter().enumerate();
        rows.filter(move |(_, one)| one.present == present)
            .map(|(row, one)| (-(row as f64), one))
    };
    let segments = chosen().filter_map(|(y, one)| {
        let high = if one.is_without_end() { end } else { one.high? };
        Some(Segment {
            x: (one.low?, high),
            y: (y, y),
        })
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
