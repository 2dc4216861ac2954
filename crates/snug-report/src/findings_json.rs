//! `findings.json`: what was left out, repaired or is worth knowing.

use crate::outcome::severity_name;
use serde::Serialize;
use snug_campaign::{CampaignResult, Finding};
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Findings<'a> {
    format: u32,
    counts: Counts<'a>,
    findings: &'a [Finding],
}

#[derive(Serialize)]
struct Counts<'a> {
    by_severity: BTreeMap<&'static str, usize>,
    by_code: BTreeMap<&'a str, usize>,
}

/// Every finding in campaign order, with counts by severity and by code. `format` is 1.
pub fn findings_json(result: &CampaignResult) -> String {
    let mut counts = Counts {
        by_severity: BTreeMap::from([("note", 0), ("repaired", 0), ("left_out", 0)]),
        by_code: BTreeMap::new(),
    };
    for finding in &result.findings {
        *counts
            .by_severity
            .entry(severity_name(finding.severity))
            .or_default() += 1;
        *counts.by_code.entry(&finding.code).or_default() += 1;
    }
    let findings = Findings {
        format: 1,
        counts,
        findings: &result.findings,
    };
    let mut text =
        serde_json::to_string_pretty(&findings).expect("plain structs with text keys serialise");
    text.push('\n');
    text
}
