//! Why tightenings were rejected, under both presets side by side, and on which of them the presets differ.

use super::{Render, Section, nothing};
use crate::words::number::{percent, share};
use crate::words::outcome::{REJECTIONS, outcome_words, rejection_meaning, rejection_words};
use maud::{Markup, html};
use snug_campaign::{CampaignResult, PresetSummary, Rejection, TighteningId};
use std::collections::{HashMap, HashSet};

/// What was selected and why, under both presets.
pub const SECTION: Section = Section {
    anchor: "selection",
    short_title: "Selection",
    title: "What was selected, and why not the rest",
    render: Render::Always(render),
};

/// Up to this many tightenings the outcomes stand open; beyond, they unfold.
const OPEN_UP_TO: usize = 120;
/// A list of differences longer than this helps nobody.
const DIFFERENCES_SHOWN: usize = 100;

fn render(result: &CampaignResult) -> Markup {
    if result.presets.iter().all(|preset| preset.tightenings == 0) {
        return nothing("No tightening was found, so none was selected.");
    }
    html! {
        p {
            "A preset is a way to turn recordings into tightenings. " strong { "snug" } " measures bias and noise in the quiet \
            part before the pulse and zeroes the velocity there; " strong { "thesis" } " repeats the original program step by \
            step. This report's results are those of the preset " strong { (result.preset) } "."
        }
        (counts(&result.presets))
        @if let [first, second] = result.presets.as_slice() { (agreement(first, second)) }
        (outcomes(&result.presets))
    }
}

fn counts(presets: &[PresetSummary]) -> Markup {
    let reasons: Vec<Rejection> = REJECTIONS
        .into_iter()
        .filter(|reason| presets.iter().any(|preset| count(preset, *reason) > 0))
        .collect();
    html! {
        div.scroll tabindex="0" role="region" aria-label="Selected tightenings per preset" {
            table.counts {
                caption { "Tightenings per outcome; one tightening may have several reasons" }
                thead { tr {
                    th scope="col" { "outcome" }
                    @for preset in presets { th scope="col" { "preset " (preset.preset) } }
                    th scope="col" { "meaning" }
                } }
                tbody {
                    tr {
                        th scope="row" { "selected" }
                        @for preset in presets { td { (bar(preset.selected, preset.tightenings, "c-selected")) } }
                        td.words { "Nothing speaks against it; it takes part in the statistics." }
                    }
                    @for reason in reasons {
                        tr {
                            th scope="row" { (rejection_words(reason)) }
                            @for preset in presets { td { (bar(count(preset, reason), preset.tightenings, "c-rejected")) } }
                            td.words { (rejection_meaning(reason)) }
                        }
                    }
                }
            }
        }
    }
}

fn count(preset: &PresetSummary, reason: Rejection) -> usize {
    preset
        .rejections
        .iter()
        .find(|row| row.rejection == reason)
        .map_or(0, |row| row.tightenings)
}

fn bar(part: usize, whole: usize, class: &str) -> Markup {
    let share = share(part, whole).unwrap_or(0.0);
    html! {
        span.amount { (part) " of " (whole) " (" (percent(share)) ")" }
        span.track aria-hidden="true" { span.fill.(class) style=(format!("width:{:.1}%", 100.0 * share)) {} }
    }
}

/// How the two presets agree, and where they do not.
fn agreement(first: &PresetSummary, second: &PresetSummary) -> Markup {
    let other: HashMap<&TighteningId, &[Rejection]> = second
        .outcomes
        .iter()
        .map(|(id, reasons)| (id, reasons.as_slice()))
        .collect();
    let pairs: Vec<(&TighteningId, &[Rejection], &[Rejection])> = first
        .outcomes
        .iter()
        .filter_map(|(id, reasons)| Some((id, reasons.as_slice(), *other.get(id)?)))
        .collect();
    let number = |in_first: bool, in_second: bool| {
        pairs
            .iter()
            .filter(|(_, a, b)| a.is_empty() == in_first && b.is_empty() == in_second)
            .count()
    };
    let differing: Vec<_> = pairs
        .iter()
        .filter(|(_, a, b)| a.is_empty() != b.is_empty())
        .collect();
    html! {
        p {
            "Both presets select " (number(true, true)) " tightenings and both reject " (number(false, false)) "; only "
            (first.preset) " selects " (number(true, false)) ", only " (second.preset) " selects " (number(false, true)) "."
        }
        @if !differing.is_empty() {
            details {
                summary { "The " (differing.len()) " tightenings on which the presets differ" }
                div.scroll tabindex="0" role="region" aria-label="Tightenings on which the presets differ" { table {
                    thead { tr {
                        th scope="col" { "tightening" }
                        th.words scope="col" { (first.preset) }
                        th.words scope="col" { (second.preset) }
                    } }
                    tbody {
                        @for (id, a, b) in differing.iter().take(DIFFERENCES_SHOWN) {
                            tr { th scope="row" { (id) } td.words { (outcome_words(a)) } td.words { (outcome_words(b)) } }
                        }
                    }
                } }
                @if differing.len() > DIFFERENCES_SHOWN {
                    p.note { "The first " (DIFFERENCES_SHOWN) " are shown; statistics.json lists all." }
                }
            }
        }
    }
}

/// Every tightening's outcome under every preset, one row per file.
fn outcomes(presets: &[PresetSummary]) -> Markup {
    let tightenings = presets.iter().map(|preset| preset.tightenings).max();
    let mut files: Vec<&str> = Vec::new();
    let mut seen = HashSet::new();
    for (id, _) in presets.iter().flat_map(|preset| &preset.outcomes) {
        if seen.insert(id.file.as_str()) {
            files.push(&id.file);
        }
    }
    let columns: Vec<HashMap<&str, Vec<Markup>>> = presets.iter().map(by_file).collect();
    html! {
        details open[tightenings <= Some(OPEN_UP_TO)] {
            summary { "Outcome of every tightening" }
            p.legend {
                span.key { span.outcome.yes { "1" } " selected" }
                span.key { span.outcome.no { "1" } " rejected (point at it for the reason)" }
            }
            div.scroll tabindex="0" role="region" aria-label="Outcome of every tightening" { table.outcomes {
                thead { tr {
                    th scope="col" { "file" }
                    @for preset in presets { th scope="col" { "preset " (preset.preset) } }
                } }
                tbody {
                    @for file in &files { tr {
                        th scope="row" { (file) }
                        @for column in &columns {
                            td { @for outcome in column.get(file).into_iter().flatten() { (outcome) } }
                        }
                    } }
                }
            } }
        }
    }
}

/// A preset's outcomes file by file, each a numbered square.
fn by_file(preset: &PresetSummary) -> HashMap<&str, Vec<Markup>> {
    let mut files: HashMap<&str, Vec<Markup>> = HashMap::new();
    for (id, reasons) in &preset.outcomes {
        files
            .entry(&id.file)
            .or_default()
            .push(outcome(id.number, reasons));
    }
    files
}

fn outcome(number: u32, reasons: &[Rejection]) -> Markup {
    let words = format!("#{number} {}", outcome_words(reasons));
    html! {
        span.outcome.yes[reasons.is_empty()].no[!reasons.is_empty()] title=(words) aria-label=(words) role="img" { (number) }
    }
}
