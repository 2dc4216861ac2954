//! The page's sections. A new one is a new file and one line in [`SECTIONS`].

mod conditions;
mod corrections;
mod deviations;
mod distributions;
mod findings;
mod glossary;
mod identifiability;
mod overview;
mod p_values;
mod selection;
mod study;
mod tightening_figures;
mod tightening_table;
mod torque;

use maud::{Markup, html};
use snug_campaign::CampaignResult;

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

/// Every section, from what a manager asks to what an engineer asks.
pub const SECTIONS: &[Section] = &[
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

/// A plain sentence in place of a section's content.
fn nothing(sentence: &str) -> Markup {
    html! { p.nothing { (sentence) } }
}

/// "1 file", "2 files".
fn counted(count: usize, one: &str) -> String {
    if count == 1 {
        format!("1 {one}")
    } else {
        format!("{count} {one}s")
    }
}
