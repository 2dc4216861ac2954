//! The page's sections. A new one is a new file and one line in [`SECTIONS`] or [`DIAGNOSIS`].

mod before_after;
mod comparison;
mod conditions;
mod corrections;
mod detectability;
mod deviations;
mod distributions;
mod effort;
mod findings;
mod glossary;
mod identifiability;
mod ladder;
mod location;
mod overview;
mod p_values;
mod ranking;
mod selection;
mod study;
mod tightening_figures;
mod tightening_table;
mod torque;
mod verdict;

use maud::{Markup, html};
use snug_campaign::{CampaignResult, Diagnosis, Rejection, TighteningResult};

/// One part of the page.
pub struct Section {
    /// Stable name within the page's address.
    pub anchor: &'static str,
    /// Short title for the list of sections.
    pub short_title: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Its content.
    pub render: fn(&CampaignResult) -> Markup,
}

/// One part of the page that is there only when the model was put to the question.
pub struct DiagnosisSection {
    /// Stable name within the page's address.
    pub anchor: &'static str,
    /// Short title for the list of sections.
    pub short_title: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Its content; `None` when there is nothing to show.
    pub render: fn(&Diagnosis, &CampaignResult) -> Option<Markup>,
}

/// What a diagnosis shows, right after the overview.
const DIAGNOSIS: &[DiagnosisSection] = &[
    verdict::SECTION,
    ladder::SECTION,
    before_after::SECTION,
    ranking::SECTION,
    location::SECTION,
    comparison::SECTION,
    detectability::SECTION,
    effort::SECTION,
];

/// A section with its content.
pub struct Rendered {
    /// Stable name within the page's address.
    pub anchor: &'static str,
    /// Short title for the list of sections.
    pub short_title: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Its content.
    pub content: Markup,
}

/// The sections that a result has something for, in reading order.
pub fn rendered(result: &CampaignResult) -> Vec<Rendered> {
    let mut sections: Vec<Rendered> = SECTIONS
        .iter()
        .map(|section| Rendered {
            anchor: section.anchor,
            short_title: section.short_title,
            title: section.title,
            content: (section.render)(result),
        })
        .collect();
    let found = result.diagnosis.iter().flat_map(|diagnosis| {
        DIAGNOSIS.iter().filter_map(|section| {
            Some(Rendered {
                anchor: section.anchor,
                short_title: section.short_title,
                title: section.title,
                content: (section.render)(diagnosis, result)?,
            })
        })
    });
    sections.splice(1..1, found);
    sections
}

/// Every section, from what a manager asks to what an engineer asks.
const SECTIONS: &[Section] = &[
    overview::SECTION,
    selection::SECTION,
    corrections::SECTION,
    tightening_figures::SECTION,
    distributions::SECTION,
    conditions::SECTION,
    p_values::SECTION,
    torque::SECTION,
    tightening_table::SECTION,
    identifiability::SECTION,
    findings::SECTION,
    deviations::SECTION,
    study::SECTION,
    glossary::SECTION,
];

/// Row index of every factor level: levels of one factor stand together, in the order in which they come.
fn factors(result: &CampaignResult) -> Vec<(&str, Vec<&snug_campaign::ConditionSummary>)> {
    let mut factors: Vec<(&str, Vec<_>)> = Vec::new();
    for summary in &result.conditions {
        match factors.iter_mut().find(|(name, _)| *name == summary.factor) {
            Some((_, levels)) => levels.push(summary),
            None => factors.push((&summary.factor, vec![summary])),
        }
    }
    factors
}

/// The tightenings that were fitted or should have been: all but those kept for validation.
fn fitted(result: &CampaignResult) -> impl Iterator<Item = &TighteningResult> {
    result.tightenings.iter().filter(|tightening| {
        !tightening
            .selection
            .rejections
            .contains(&Rejection::Validation)
    })
}

/// A plain sentence in place of a section's content.
fn nothing(sentence: &str) -> Markup {
    html! { p.nothing { (sentence) } }
}
