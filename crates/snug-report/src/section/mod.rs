//! The page's sections. A new one is a new file and one line in [`chapters`].

mod before_after;
mod chapters;
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
pub(crate) mod location;
mod overview;
mod p_values;
mod ranking;
mod selection;
mod study;
mod tightening_figures;
mod tightening_table;
mod torque;
mod validation;
mod verdict;

use crate::grouping::grouped;
use chapters::CHAPTERS;
pub use chapters::Chapter;
use maud::{Markup, html};
use snug_campaign::{
    CampaignResult, ConditionSummary, Diagnosis, Rejection, Severity, TighteningResult,
};

/// Adjusted p below which a difference or a drift is beyond chance \[–\]: the customary level. Chosen.
const BEYOND_CHANCE: f64 = 0.05;

/// One part of the page.
pub struct Section {
    /// Stable name within the page's address.
    pub anchor: &'static str,
    /// Short title for the list at the head of its chapter.
    pub short_title: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Its content.
    pub render: Render,
}

/// How a section's content comes about.
pub enum Render {
    /// It is always there.
    Always(fn(&CampaignResult) -> Markup),
    /// It is there when there is something to show, else `None`.
    Sometimes(fn(&CampaignResult) -> Option<Markup>),
    /// It is there when the model was put to the question; `None` when there is nothing to show.
    Diagnosed(fn(&Diagnosis, &CampaignResult) -> Option<Markup>),
}

/// A chapter that a result has something for: its sections with their content, in reading order.
pub struct Rendered {
    /// Which one.
    pub chapter: &'static Chapter,
    /// What it shows.
    pub sections: Vec<(&'static Section, Markup)>,
}

/// The chapters that a result has something for.
pub fn rendered(result: &CampaignResult) -> Vec<Rendered> {
    let content = |section: &'static Section| {
        let content = match section.render {
            Render::Always(render) => render(result),
            Render::Sometimes(render) => render(result)?,
            Render::Diagnosed(render) => render(result.diagnosis.as_ref()?, result)?,
        };
        Some((section, content))
    };
    let chapters = CHAPTERS.iter().map(|chapter| Rendered {
        chapter,
        sections: chapter.sections.iter().filter_map(content).collect(),
    });
    chapters.filter(|one| !one.sections.is_empty()).collect()
}

/// The levels of every factor, factors and levels in the order in which they come.
fn factors(result: &CampaignResult) -> Vec<(&str, Vec<&ConditionSummary>)> {
    let summaries = result.conditions.iter();
    grouped(summaries.map(|summary| (summary.factor.as_str(), summary)))
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

/// How many findings of a severity there are.
fn findings_of(result: &CampaignResult, severity: Severity) -> usize {
    let findings = result.findings.iter();
    findings
        .filter(|finding| finding.severity == severity)
        .count()
}

/// A table's head without a word on any column but its heading.
fn headings(headings: &[&str]) -> Markup {
    html! { thead { tr { @for heading in headings { th scope="col" { (heading) } } } } }
}

/// A plain sentence in place of a section's content.
fn nothing(sentence: &str) -> Markup {
    html! { p.nothing { (sentence) } }
}
