//! Quirks of the original program that move results. The numbers named here are fixed text: no run computes them.

use super::{Render, Section, nothing};
use maud::{Markup, html};
use snug_campaign::CampaignResult;

/// Where the two presets part, and why.
pub const SECTION: Section = Section {
    anchor: "deviations",
    short_title: "Thesis preset",
    title: "What the thesis preset does differently",
    render: Render::Always(render),
};

/// Each quirk of the original program that moves results: what it does, what snug does.
const DEVIATIONS: [(&str, &str, &str); 11] = [
    (
        "Integration",
        "Integrates from the segment's start and never zeroes the velocity: 1.48 s of bias and noise enter as drift. A constant \
         bias of 0.1 rad/s² alone is enough to reject two thirds of perfect tightenings.",
        "Measures the bias in the quiet part, takes it out, and zeroes the velocity at the window's start.",
    ),
    (
        "Offset",
        "Sets zero at the displacement's first local minimum, or 27.4 ms into the window where there is none; on perfect data this \
         alone raises m by 6.3 % and k by 3.3 %.",
        "Sets zero from the quiet part.",
    ),
    (
        "Fitted output",
        "Fits the twice integrated displacement, whose noise is strongly coloured.",
        "Fits the measured acceleration unless the study asks for another output, weighted by the measured noise spectrum.",
    ),
    (
        "Input between samples",
        "Holds the torque constant between samples, which moves the mass by 0.25 to 0.55 %.",
        "Draws it straight from sample to sample.",
    ),
    (
        "Goes up (code 1)",
        "Is always overwritten by the check for code 2, so it never rejects.",
        "Makes no such check: what the model cannot follow shows in the fit.",
    ),
    (
        "Light damping (code 3)",
        "Checks it after the fit, with the tool's mass of 2.60 kg instead of its inertia (2.53 kg or 1.38 kg at the grip), which \
         lets some overdamped tightenings pass.",
        "Keeps every estimate lightly damped and positive, and says when such a limit decided.",
    ),
    (
        "Parameters",
        "Asks only that the motion is stable: c and k stay at zero or above, m may become negative and is rejected afterwards.",
        "Constrains them during the fit.",
    ),
    (
        "Names",
        "Takes every file for Quick Step without TT in its name and for a hard joint without Soft; Snug leaves what it cannot read open, \
         under both presets.",
        "Leaves what it cannot read open, and says so.",
    ),
    (
        "Grip force",
        "Takes a channel called F_op_J only; under its other name (Data1_F_op_J_FIR_Filter_OFFSET) it chooses the tool's inertia, \
         but is not reported.",
        "Reports it under either name.",
    ),
    (
        "90 % rule",
        "Takes a fit above 90 % for a good one. A sensor lag of 4 ms passes in 91 % of tightenings with a mass 31 % too high.",
        "Keeps the rule, and reports the error in multiples of the measured noise beside it.",
    ),
    (
        "Natural frequency",
        "Is that of the hand–arm alone, without the tool.",
        "Reports the same, and beside it the damped frequency of tool and hand–arm together.",
    ),
];

fn render(result: &CampaignResult) -> Markup {
    if !result
        .presets
        .iter()
        .any(|preset| preset.preset == "thesis")
    {
        return nothing(
            "The preset thesis is for nutrunner campaigns; it was not applied to this rig.",
        );
    }
    html! {
        p { "The preset " strong { "thesis" } " follows the original program even where it errs, so that old and new results can be compared." }
        div.scroll tabindex="0" role="region" aria-label="What the thesis preset does differently" { table.prose {
            thead { tr { th scope="col" { "step" } th.words scope="col" { "thesis" } th.words scope="col" { "snug" } } }
            tbody { @for (step, thesis, snug) in DEVIATIONS {
                tr { th scope="row" { (step) } td.words { (thesis) } td.words { (snug) } }
            } }
        } }
    }
}
