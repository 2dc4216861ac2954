//! `findings.json`: what was left out, repaired or is worth knowing.

use crate::tables::json;
use serde::Serialize;
use snug_campaign::{CampaignResult, Finding, Severity};
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Findings<'a> {
    format: u32,
    counts: Counts<'a>,
    findings: &'a [Finding],
}

#[derive(Serialize)]
struct Counts<'a> {
    by_severity: BTreeMap<String, usize>,
    by_code: BTreeMap<&'a str, usize>,
}

/// Every finding in campaign order, with counts by severity and by code. `format` is 1.
pub fn findings_json(result: &CampaignResult) -> String {
    let mut counts = Counts {
        by_severity: [Severity::Note, Severity::Repaired, Severity::LeftOut]
            .map(|severity| (json::name(severity), 0))
            .into(),
        by_code: BTreeMap::new(),
    };
    for finding in &result.findings {
        *counts
            .by_severity
            .entry(json::name(finding.severity))
            .or_default() += 1;
        *counts.by_code.entry(&finding.code).or_default() += 1;
    }
    let findings = Findings {
        format: 1,
        counts,
        findings: &result.findings,
    };
    json::text(&findings)
}
