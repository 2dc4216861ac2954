//! Prints the study into the report, so that a page alone says how to get its numbers again.

use super::{Render, Section, nothing};
use maud::{Markup, html};
use snug_campaign::CampaignResult;

/// The study as run.
pub const SECTION: Section = Section {
    anchor: "study",
    short_title: "Study",
    title: "The study as run",
    render: Render::Always(render),
};

fn render(result: &CampaignResult) -> Markup {
    if result.study_ron.trim().is_empty() {
        return nothing("The study was not recorded.");
    }
    html! {
        p { "Every setting with its default written out. With it, the same data give the same numbers." }
        details {
            summary { "Study (RON)" }
            pre tabindex="0" { code { (result.study_ron) } }
        }
    }
}
