//! `report.html`: the page around the sections.

use crate::machine_words;
use crate::section::{Section, rendered};
use crate::viewer::{SCRIPT, document};
use maud::{Markup, PreEscaped, html as markup};
use snug_campaign::CampaignResult;
use snug_campaign::words::vocabulary::Vocabulary;

/// What the report's script has beside the viewer.
const TABLES: &str = include_str!("assets/table.js");

/// The whole report as one page that asks for nothing from outside.
///
/// Text from the campaign is escaped; the page works without JavaScript, which only adds stepping, zoom, values under
/// the cursor, sorting and filtering.
///
/// Of a machine it is told in a machine's words.
pub fn html(result: &CampaignResult) -> String {
    if result.vocabulary == Vocabulary::Hand {
        return page(result);
    }
    let told = CampaignResult {
        diagnosis: (result.diagnosis.as_ref()).map(|one| result.vocabulary.told(one)),
        ..result.clone()
    };
    machine_words::markup(&page(&told), result.vocabulary)
}

fn page(result: &CampaignResult) -> String {
    let sections = rendered(result);
    let body = markup! {
        a.skip href="#overview" { "Skip to the results" }
        (contents(&sections))
        main {
            header.top {
                p.kind { "Snug report" }
                h1 { (result.title) }
            }
            @for (section, content) in &sections {
                section id=(section.anchor) aria-labelledby=(format!("{}-title", section.anchor)) {
                    h2 id=(format!("{}-title", section.anchor)) { (section.title) }
                    (content)
                }
            }
        }
        script { (PreEscaped(SCRIPT)) (PreEscaped(TABLES)) }
    };
    document(&format!("{} – Snug report", result.title), "", &body).into_string()
}

fn contents(sections: &[(&Section, Markup)]) -> Markup {
    markup! {
        nav.contents aria-label="Sections" {
            ol { @for (section, _) in sections { li { a href=(format!("#{}", section.anchor)) { (section.short_title) } } } }
        }
    }
}
