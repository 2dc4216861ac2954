//! Work counters instead of times: they are the same on every run, so that a slower diagnosis shows as a change.

use super::{Render, Section};
use maud::{Markup, html};
use snug_campaign::{CampaignResult, Diagnosis, WorkDone};

/// How much work the diagnosis was, where that was counted.
pub const SECTION: Section = Section {
    anchor: "effort",
    short_title: "Work done",
    title: "How much work this was",
    render: Render::Diagnosed(render),
};

fn render(diagnosis: &Diagnosis, _result: &CampaignResult) -> Option<Markup> {
    let work = &diagnosis.work;
    if *work == WorkDone::default() {
        return None;
    }
    let rows = [
        ("rankings of all candidates", work.rankings),
        (
            "simulations for how a candidate would show",
            work.signatures,
        ),
        ("fits of tightenings together", work.pooled_fits),
        ("steps tried in them", work.steps),
        (
            "simulations with sensitivities in them",
            work.linearizations,
        ),
        ("conic programs solved in them", work.conic_solves),
    ];
    Some(html! {
        p { "Counts, not times: the same data and study give the same counts on every run and for any number of threads. \
            More of them after an update means that something has become slower." }
        div.scroll tabindex="0" role="region" aria-label="Counts of work" { table {
            tbody { @for (what, count) in rows { tr { th scope="row" { (what) } td { (count) } } } }
        } }
    })
}
