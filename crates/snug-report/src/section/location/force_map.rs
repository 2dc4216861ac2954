//! Heat map of the missing force; a cell whose 95 % band holds zero is grey, so that noise is not read as a law.

use crate::figure::{Axis, Bar, Cell, Figure, Mark, captioned, legend};
use crate::grouping::grouped;
use crate::words::number::significant;
use maud::{Markup, html};
use snug_campaign::ForceMap;

/// Steps of colour either side of zero, weak to strong.
const PUSHES: [&str; 4] = ["heat push-1", "heat push-2", "heat push-3", "heat push-4"];
const PULLS: [&str; 4] = ["heat pull-1", "heat pull-2", "heat pull-3", "heat pull-4"];
const UNSURE: &str = "heat unsure";

/// Whether any cell has a force.
pub fn holds(map: &ForceMap) -> bool {
    map.x_m.len() > 1
        && map.v_m_per_s.len() > 1
        && map.force_n.len() == map.x_m.len() * map.v_m_per_s.len()
        && map.force_n.iter().flatten().any(|force| force.is_finite())
}

/// A cell's colour: none without a sample, grey where its band holds zero.
fn class(force: f64, half_width: Option<f64>, step: f64) -> &'static str {
    if half_width.is_none_or(|half| half.is_nan() || half >= force.abs()) {
        return UNSURE;
    }
    let strength = ((force.abs() / step).ceil() as usize).clamp(1, 4) - 1;
    if force >= 0.0 {
        PUSHES[strength]
    } else {
        PULLS[strength]
    }
}

/// The missing force over displacement and velocity as a map of coloured cells; where they can be chosen, each with its edges in SI units.
pub fn figure(map: &ForceMap, can_be_chosen: bool) -> Markup {
    let (width_mm, height) = (1000.0 * spacing(&map.x_m), spacing(&map.v_m_per_s));
    let sure = map
        .force_n
        .iter()
        .zip(&map.half_width_n)
        .filter_map(|(force, half)| {
            force.filter(|force| force.is_finite() && half.is_some_and(|half| half < force.abs()))
        });
    let largest = sure.fold(0.0_f64, |largest, force| largest.max(force.abs()));
    let step = if largest > 0.0 { largest / 4.0 } else { 1.0 };
    let mut cells = Vec::new();
    let columns = map.v_m_per_s.len();
    for (cell, force) in map.force_n.iter().enumerate() {
        let Some(force) = force.filter(|force| force.is_finite()) else {
            continue;
        };
        let half = map.half_width_n.get(cell).copied().flatten();
        let (x_mm, v) = (
            1000.0 * map.x_m[cell / columns],
            map.v_m_per_s[cell % columns],
        );
        let class = class(force, half, step);
        let (x_m, half_m) = (1e-3 * x_mm, 5e-4 * width_mm);
        let edges = [
            x_m - half_m,
            x_m + half_m,
            v - 0.5 * height,
            v + 0.5 * height,
        ];
        let bar = Bar {
            x: (x_mm - 0.5 * width_mm, x_mm + 0.5 * width_mm),
            y: (v - 0.5 * height, v + 0.5 * height),
            title: spoken(x_mm, v, force, half),
        };
        let key = edges.map(|edge| format!("{edge:e}")).join(",");
        cells.push((class, Cell { bar, key }));
    }
    let layers = grouped(cells);
    let used: Vec<&str> = layers.iter().map(|(class, _)| *class).collect();
    let ends = |values: &[f64], factor: f64, room: f64| {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (factor * low - 0.5 * room, factor * high + 0.5 * room)
    };
    let (left, right) = ends(&map.x_m, 1000.0, width_mm);
    let (bottom, top) = ends(&map.v_m_per_s, 1.0, height);
    let drawing = Figure {
        description: "Missing force over displacement and velocity of the grip".into(),
        width: 520.0,
        height: 320.0,
        x: Axis::linear("displacement of the grip x [mm]", left, right, 6),
        y: Axis::linear("velocity of the grip v [m/s]", bottom, top, 6),
        marks: layers
            .into_iter()
            .map(|(class, cells)| match can_be_chosen {
                true => Mark::Cells(class, cells),
                false => Mark::Bars(class, cells.into_iter().map(|cell| cell.bar).collect()),
            })
            .collect(),
    };
    captioned(
        "Missing force over displacement and velocity",
        html! { (drawing.svg()) (key(step, &used)) },
        Some(
            "Grey: the 95 % band is wider than the force, so nothing is proven there. Empty: no sample.",
        ),
    )
}

fn spoken(x_mm: f64, v: f64, force: f64, half: Option<f64>) -> String {
    let band = half
        .filter(|half| half.is_finite())
        .map_or_else(String::new, |half| format!(" ± {} N", significant(half, 2)));
    format!(
        "x = {} mm, v = {} m/s: {} N{band}",
        significant(x_mm, 3),
        significant(v, 3),
        significant(force, 3)
    )
}

/// Distance of neighbouring bin centres.
fn spacing(centres: &[f64]) -> f64 {
    match centres {
        [first, .., last] => (last - first).abs() / (centres.len() - 1) as f64,
        _ => 1.0,
    }
}

/// What the colours mean, of those that are used.
fn key(step: f64, used: &[&str]) -> Markup {
    let edge = |strength: usize| match strength {
        0 => "0".to_owned(),
        _ => significant(step * strength as f64, 2),
    };
    let pulls = (0..4).rev().map(|strength| {
        let near = if strength == 0 {
            "0".into()
        } else {
            format!("−{}", edge(strength))
        };
        (
            PULLS[strength],
            format!("−{} to {near} N", edge(strength + 1)),
        )
    });
    let pushes = (0..4).map(|strength| {
        let text = format!("{} to {} N", edge(strength), edge(strength + 1));
        (PUSHES[strength], text)
    });
    let entries: Vec<(&str, String)> = pulls
        .chain([(UNSURE, "not sure".to_owned())])
        .chain(pushes)
        .filter(|(class, _)| used.contains(class))
        .collect();
    let entries: Vec<(&str, &str)> = entries
        .iter()
        .map(|(class, text)| (*class, text.as_str()))
        .collect();
    legend(&entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_whose_band_holds_zero_is_grey() {
        assert_eq!(class(3.0, Some(3.1), 1.0), UNSURE);
        assert_eq!(class(3.0, None, 1.0), UNSURE);
        assert_eq!(class(3.0, Some(f64::NAN), 1.0), UNSURE);
        assert_eq!(class(3.0, Some(1.0), 1.0), "heat push-3");
        assert_eq!(class(-4.0, Some(1.0), 1.0), "heat pull-4");
        assert_eq!(class(0.1, Some(0.05), 1.0), "heat push-1");
    }
}
