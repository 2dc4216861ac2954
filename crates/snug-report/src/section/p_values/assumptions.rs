//! How what the tests presume stands: one quiet line below every factor, and what it means.

use super::freedom;
use crate::grouping::first_seen;
use crate::section::BEYOND_CHANCE;
use crate::words::number::{fixed, missing, p_value, plain};
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::{AssumptionCheck, CampaignResult, TestRow};
use std::collections::BTreeSet;

/// Every check of the tests of one quantity against one factor, each once.
pub fn checks<'a>(rows: &[&'a TestRow]) -> Vec<&'a AssumptionCheck> {
    let mut checks: Vec<&AssumptionCheck> = Vec::new();
    for check in rows.iter().flat_map(|row| &row.assumptions) {
        if !checks
            .iter()
            .any(|known| known.assumption == check.assumption)
        {
            checks.push(check);
        }
    }
    checks
}

/// `46 residuals: W = 0.981, p = 0.213; variances of 2 groups: F(1, 44) = 1.20, p = 0.330`, and which test is to be read
/// where one of them fails.
pub fn line(rows: &[&TestRow]) -> Markup {
    let checks = checks(rows);
    let doubted: Vec<&str> = checks
        .iter()
        .filter(|check| is_doubted(check))
        .map(|check| check.assumption.as_str())
        .collect();
    html! {
        @for (place, check) in checks.iter().enumerate() {
            @if place > 0 { "; " }
            (subject(check)) ": " (found(check))
        }
        @if !doubted.is_empty() { ". " span.advice { (advice(rows, &doubted)) } }
    }
}

/// What is checked and how to read it; empty where nothing was checked.
pub fn explanation(result: &CampaignResult) -> Markup {
    let presuming = |assumption: &str| {
        let presumes = |check: &AssumptionCheck| check.assumption == assumption;
        let rows = result.tests.iter();
        let presuming = rows.filter(|row| row.assumptions.iter().any(presumes));
        first_seen(presuming.map(|row| quantity::words(&row.method))).join(", ")
    };
    let rows: Vec<&TestRow> = result.tests.iter().collect();
    let checks = checks(&rows);
    html! { @if !checks.is_empty() {
        p.note {
            "The line below a factor checks what tests beside presume: "
            @for (place, check) in checks.iter().enumerate() {
                @if place > 0 { "; " }
                (meaning(check)) " (" (presuming(&check.assumption)) ")"
            }
            ". Below p = 0.05 it names a test that does without. Nothing is replaced, and the methods marked per participant \
            stay the ones to trust: residuals hold the differences between participants, too. Unequal variances make residuals \
            look less normal; many tightenings show deviations too small to matter, few hide large ones."
        }
        p.reading { (reading(result, &checks)) }
    } }
}

fn reading(result: &CampaignResult, checks: &[&AssumptionCheck]) -> String {
    let counts: Vec<String> = checks
        .iter()
        .map(|check| {
            let mut made = BTreeSet::new();
            let mut doubted = BTreeSet::new();
            for row in &result.tests {
                let comparison = (&row.quantity, &row.factor);
                let of_row = row.assumptions.iter();
                for found in of_row.filter(|c| c.assumption == check.assumption && c.p.is_some()) {
                    made.insert(comparison);
                    if is_doubted(found) {
                        doubted.insert(comparison);
                    }
                }
            }
            let doubt = doubt(&check.assumption);
            format!("{doubt} in {} of {} comparisons", doubted.len(), made.len())
        })
        .collect();
    format!("Found at p < 0.05: {}.", counts.join(", "))
}

fn is_doubted(check: &AssumptionCheck) -> bool {
    check.p.is_some_and(|p| p < BEYOND_CHANCE)
}

fn subject(check: &AssumptionCheck) -> String {
    match check.assumption.as_str() {
        "normal_residuals" if check.tied > 0 => {
            format!("{} residuals ({} tied)", check.values, check.tied)
        }
        "normal_residuals" => format!("{} residuals", check.values),
        "equal_variances" => format!("variances of {} groups", check.groups),
        other => quantity::words(other),
    }
}

fn found(check: &AssumptionCheck) -> Markup {
    let why = check
        .note
        .as_deref()
        .unwrap_or("the check could not be made");
    if check.p.is_none() {
        return missing(why);
    }
    let p = p_value(check.p);
    html! {
        (check.statistic_name)
        @if !check.degrees_of_freedom.is_empty() { "(" (freedom(&check.degrees_of_freedom)) ")" }
        " = " (statistic(check.statistic, why)) ", p "
        // Beyond its ends a p value brings its own sign.
        @if !p.starts_with(['<', '>']) { "= " } (p)
    }
}

/// Three decimals below 1, where W lies; three digits above.
fn statistic(value: Option<f64>, why: &str) -> Markup {
    match value.filter(|value| value.abs() < 1.0) {
        Some(value) => html! { (fixed(value, 3)) },
        None => plain(value, 3, why),
    }
}

fn meaning(check: &AssumptionCheck) -> String {
    let method = quantity::words(&check.method);
    match check.assumption.as_str() {
        "normal_residuals" => {
            format!("near-normal residuals, a value minus its group's mean, by {method}")
        }
        "equal_variances" => {
            format!("equal variances by {method}, Levene's test about the medians")
        }
        other => format!("{} by {method}", quantity::words(other)),
    }
}

fn doubt(assumption: &str) -> String {
    match assumption {
        "normal_residuals" => "residuals not near normal".into(),
        "equal_variances" => "unequal variances".into(),
        other => format!("{} in doubt", quantity::words(other)),
    }
}

/// The first test beside that presumes none of what is in doubt.
fn advice(rows: &[&TestRow], doubted: &[&str]) -> String {
    let doubts: Vec<String> = doubted.iter().map(|assumption| doubt(assumption)).collect();
    let doubts = quantity::capitalised(&doubts.join(", "));
    let does_without = |row: &&&TestRow| {
        let presumed = row.assumptions.iter();
        row.p.is_some()
            && !row.respects_participants
            && !presumed
                .map(|check| check.assumption.as_str())
                .any(|assumption| doubted.contains(&assumption))
    };
    match rows.iter().find(does_without) {
        Some(row) => format!("{doubts}: read {}.", quantity::words(&row.method)),
        None => format!("{doubts}: no test beside presumes less."),
    }
}
