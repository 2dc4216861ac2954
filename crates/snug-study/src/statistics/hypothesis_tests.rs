//! The table of p values: every quantity against every factor by every method.

use super::assumptions::{self, Assumption};
use super::factor::Factor;
use super::methods::{METHODS, Method, Outcome};
use super::quantity;
use super::sample::Sample;
use super::stated::Stated;
use snug_campaign::{AssumptionCheck, SignalUnits, TestRow, TighteningResult};
use snug_statistics::multiplicity;

/// Every test of every quantity against every factor over the selected tightenings; p adjusted per method.
pub fn rows(tightenings: &[&TighteningResult], units: &SignalUnits, seed: u64) -> Vec<TestRow> {
    let selected: Vec<&TighteningResult> = tightenings
        .iter()
        .copied()
        .filter(|t| t.selection.selected())
        .collect();
    let mut rows = Vec::new();
    for name in quantity::names(&selected) {
        for factor in Factor::of(units) {
            let sample = Sample::of(&selected, &name, factor);
            if sample.groups.len() < 2 {
                continue;
            }
            let checks = assumptions::checks(&sample.groups);
            for method in METHODS {
                let itself = factor == Factor::Participant && method.respects_participants;
                if (method.compares)(sample.groups.len()) && !itself {
                    let outcome = (method.test)(&sample, seed);
                    let checks = presumed(method, &checks);
                    rows.push(row(&name, factor, method, checks, outcome));
                }
            }
        }
    }
    adjust(&mut rows);
    rows
}

/// The checks of what a method presumes.
fn presumed(method: &Method, checks: &[(Assumption, AssumptionCheck)]) -> Vec<AssumptionCheck> {
    checks
        .iter()
        .filter(|(assumption, _)| method.presumes.contains(assumption))
        .map(|(_, check)| check.clone())
        .collect()
}

fn row(
    quantity: &str,
    factor: Factor,
    method: &Method,
    assumptions: Vec<AssumptionCheck>,
    outcome: Outcome,
) -> TestRow {
    let (outcome, effect_size) = match outcome {
        Ok((test, size)) => (Ok(test), size),
        Err(error) => (Err(error), None),
    };
    let stated = Stated::from(outcome);
    TestRow {
        quantity: quantity.to_owned(),
        factor: factor.name().to_owned(),
        method: method.name.to_owned(),
        respects_participants: method.respects_participants,
        statistic_name: stated.statistic_name,
        statistic: stated.statistic,
        degrees_of_freedom: stated.degrees_of_freedom,
        p: stated.p,
        p_adjusted: None,
        effect_size,
        assumptions,
        note: stated.note,
    }
}

/// Benjamini–Hochberg over all rows of one method.
fn adjust(rows: &mut [TestRow]) {
    for method in METHODS {
        let members: Vec<usize> = (0..rows.len())
            .filter(|&index| rows[index].method == method.name && rows[index].p.is_some())
            .collect();
        let p: Vec<f64> = members.iter().filter_map(|&index| rows[index].p).collect();
        if let Ok(adjusted) = multiplicity::benjamini_hochberg(&p) {
            for (index, adjusted) in members.into_iter().zip(adjusted) {
                rows[index].p_adjusted = Some(adjusted);
            }
        }
    }
}
