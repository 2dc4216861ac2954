//! Shows which tightenings rounding to 5 Nm may have put into the wrong torque group.

use super::{Render, Section, headings, nothing};
use crate::figure::{Axis, Bar, Dot, Figure, Mark, captioned, legend, linear_range};
use crate::words::number::{short, significant};
use maud::{Markup, html};
use snug_campaign::words::counted;
use snug_campaign::{CampaignResult, TighteningResult};

/// Actual peak torque against the torque it is rounded to.
pub const SECTION: Section = Section {
    anchor: "torque",
    short_title: "Torque",
    title: "Rounded and actual torque",
    render: Render::Always(render),
};

/// Width of a torque group \[Nm\].
const GROUP_NM: f64 = 5.0;
/// Closer than this to the next group's edge, a tightening may stand in the wrong group \[Nm\].
const BORDERLINE_NM: f64 = 0.5;
/// Tables of borderline tightenings stop here.
const LISTED: usize = 50;

fn render(result: &CampaignResult) -> Markup {
    if !result.units.input_is_torque() {
        return nothing(
            "The input of this rig is no torque, so there is no target to round it to.",
        );
    }
    let torques: Vec<&TighteningResult> = result
        .tightenings
        .iter()
        .filter(|tightening| {
            tightening.peak_torque_nm.is_finite() && tightening.target_torque_nm.is_finite()
        })
        .collect();
    if torques.is_empty() {
        return nothing("No tightening has a peak torque.");
    }
    let borderline: Vec<&TighteningResult> = torques
        .iter()
        .copied()
        .filter(|tightening| is_borderline(tightening))
        .collect();
    html! {
        p {
            "The peak torque, rounded to 5 Nm, stands for the target torque. A tool that overshoots by about 2 Nm runs close to \
            the edge of the next group (2.5 Nm); tightenings within 0.5 Nm of an edge may stand in the wrong group: "
            (counted(borderline.len(), "tightening")) " of " (torques.len()) "."
        }
        (legend(&[("c-selected", "selected"), ("c-rejected", "rejected"), ("c-caution", "within 0.5 Nm of an edge")]))
        (captioned("Actual minus rounded peak torque", drawing(&torques), None))
        @if !borderline.is_empty() {
            details {
                summary { "The " (counted(borderline.len(), "borderline tightening")) }
                div.scroll tabindex="0" role="region" aria-label="Rounded and actual torque" { table {
                    (headings(&["tightening", "peak torque [Nm]", "rounded [Nm]", "difference [Nm]"]))
                    tbody { @for tightening in borderline.iter().take(LISTED) { tr {
                        th scope="row" { (tightening.id) }
                        td { (significant(tightening.peak_torque_nm, 4)) }
                        td { (short(tightening.target_torque_nm)) }
                        td { (significant(difference(tightening), 3)) }
                    } } }
                } }
                @if borderline.len() > LISTED { p.note { "The first " (LISTED) " are shown." } }
            }
        }
    }
}

fn difference(tightening: &TighteningResult) -> f64 {
    tightening.peak_torque_nm - tightening.target_torque_nm
}

fn is_borderline(tightening: &TighteningResult) -> bool {
    difference(tightening).abs() > 0.5 * GROUP_NM - BORDERLINE_NM
}

fn drawing(torques: &[&TighteningResult]) -> Markup {
    let (low, high) = linear_range(torques.iter().map(|t| t.peak_torque_nm), 0.05);
    let edge = 0.5 * GROUP_NM;
    let reach = torques
        .iter()
        .map(|tightening| difference(tightening).abs())
        .fold(edge, f64::max)
        * 1.06;
    let x = Axis::linear("actual peak torque [Nm]", low, high, 8);
    let y = Axis::linear("actual − rounded [Nm]", -reach, reach, 6);
    let ends = x.range();
    let strip = |from: f64, to: f64| Bar {
        x: ends,
        y: (from, to),
        title: String::new(),
    };
    let dots = |wanted: bool| -> Vec<Dot> {
        torques
            .iter()
            .filter(|tightening| tightening.selection.selected() == wanted)
            .map(|tightening| Dot {
                x: tightening.peak_torque_nm,
                y: difference(tightening),
                title: format!(
                    "{}: {} Nm, rounded {} Nm",
                    tightening.id,
                    significant(tightening.peak_torque_nm, 4),
                    short(tightening.target_torque_nm)
                ),
            })
            .collect()
    };
    let figure = Figure {
        description: "Peak torque of every tightening against its distance from the rounded torque"
            .into(),
        width: 1040.0,
        height: 260.0,
        x,
        y,
        marks: vec![
            Mark::Bars(
                "c-caution",
                vec![
                    strip(edge - BORDERLINE_NM, edge),
                    strip(-edge, BORDERLINE_NM - edge),
                ],
            ),
            Mark::rule("c-zero", ends, (0.0, 0.0)),
            Mark::Dots("c-rejected", dots(false)),
            Mark::Dots("c-selected", dots(true)),
        ],
    };
    figure.svg()
}
