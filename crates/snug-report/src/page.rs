//! `report.html`: the page around the sections.

use crate::section::{Rendered, rendered};
use crate::viewer::{SCRIPT, document};
use crate::words::as_shown::as_shown;
use crate::words::machine_words;
use maud::{Markup, PreEscaped, html as markup};
use snug_campaign::CampaignResult;
use snug_campaign::words::vocabulary::Vocabulary;

/// What the report's script has beside the viewer.
const OWN_SCRIPT: &str = concat!(
    include_str!("assets/contents.js"),
    include_str!("assets/table.js")
);

/// The whole report as one page that asks for nothing from outside.
///
/// Text from the campaign is escaped; the page works without JavaScript, which only adds stepping, zoom, values under
/// the cursor, sorting, filtering and where one is in the list of chapters.
///
/// It is told in the units of the rig's signals, and of a machine in a machine's words.
pub fn html(result: &CampaignResult) -> String {
    let page = page(&as_shown(result));
    match result.vocabulary {
        Vocabulary::Hand => page,
        machine => machine_words::markup(&page, machine),
    }
}

fn page(result: &CampaignResult) -> String {
    let chapters = rendered(result);
    let body = markup! {
        a.skip href="#result" { "Skip to the results" }
        (contents(&chapters))
        main {
            header.top {
                p.kind { "Snug report" }
                h1 { (result.title) }
            }
            @for chapter in &chapters { (chapter_markup(chapter)) }
        }
        script { (PreEscaped(SCRIPT)) (PreEscaped(OWN_SCRIPT)) }
    };
    document(&format!("{} – Snug report", result.title), "", &body).into_string()
}

fn contents(chapters: &[Rendered]) -> Markup {
    markup! {
        nav.contents aria-label="Chapters" {
            ol { @for Rendered { chapter, .. } in chapters { li { a href=(format!("#{}", chapter.anchor)) { (chapter.title) } } } }
        }
    }
}

/// A chapter: its name, what it holds where that is more than one section, and the sections.
fn chapter_markup(Rendered { chapter, sections }: &Rendered) -> Markup {
    markup! {
        div.chapter id=(chapter.anchor) {
            p.kind {
                (chapter.title)
                @if sections.len() > 1 {
                    span.parts { @for (section, _) in sections { a href=(format!("#{}", section.anchor)) { (section.short_title) } } }
                }
            }
            @for (section, content) in sections {
                section id=(section.anchor) aria-labelledby=(format!("{}-title", section.anchor)) {
                    h2 id=(format!("{}-title", section.anchor)) { (section.title) }
                    (content)
                }
            }
        }
    }
}
