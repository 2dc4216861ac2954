//! Findings by kind, the gravest first, so that a frequent remark does not hide a rare loss of data.

use super::{Render, Section, findings_of, nothing};
use crate::grouping::grouped;
use crate::tables::json;
use crate::words::number::missing;
use maud::{Markup, html};
use snug_campaign::words::counted;
use snug_campaign::{CampaignResult, Finding, Severity};
use std::cmp::Reverse;

/// What was left out, repaired or is worth knowing.
pub const SECTION: Section = Section {
    anchor: "findings",
    short_title: "Findings",
    title: "Findings about the data",
    render: Render::Always(render),
};

/// Findings of one kind listed on the page; the file holds all.
const LISTED: usize = 200;

fn render(result: &CampaignResult) -> Markup {
    if result.findings.is_empty() {
        return nothing("Nothing was left out, repaired or remarked on.");
    }
    let count = |severity| counted(findings_of(result, severity), "finding");
    html! {
        p {
            (count(Severity::LeftOut)) " left data out, " (count(Severity::Repaired))
            " repaired or corrected data, " (count(Severity::Note)) " worth knowing changed nothing. findings.json lists all."
        }
        @for (index, ((severity, code), findings)) in kinds(result).into_iter().enumerate() {
            details open[index < 3 && findings.len() <= 10] {
                summary {
                    @let severity = json::name(severity);
                    span class=(format!("severity {severity}")) { (severity.replace('_', " ")) }
                    " " strong { (code.replace('_', " ")) } " – " (counted(findings.len(), "finding"))
                }
                (listing(&findings))
            }
        }
    }
}

/// Findings by severity and code, the gravest first, then the most frequent.
fn kinds(result: &CampaignResult) -> Vec<((Severity, &str), Vec<&Finding>)> {
    let findings = result.findings.iter();
    let mut kinds = grouped(findings.map(|one| ((one.severity, one.code.as_str()), one)));
    kinds.sort_by_key(|((severity, _), findings)| Reverse((*severity, findings.len())));
    kinds
}

fn listing(findings: &[&Finding]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label=(findings.first().map_or("Findings", |one| one.code.as_str())) { table {
            thead { tr {
                th scope="col" { "file" } th scope="col" { "tightening" } th.words scope="col" { "channel" } th.words scope="col" { "what was found and done" }
            } }
            tbody { @for finding in findings.iter().take(LISTED) { tr {
                th scope="row" { (finding.file) }
                td { @if let Some(number) = finding.tightening { "#" (number) } @else { (missing("concerns the whole file")) } }
                td.words { @if let Some(channel) = &finding.channel { (channel) } @else { (missing("concerns no single channel")) } }
                td.words.long { (finding.message) }
            } } }
        } }
        @if findings.len() > LISTED { p.note { "The first " (LISTED) " of " (findings.len()) " are shown." } }
    }
}
