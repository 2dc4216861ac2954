//! Mass, damping and stiffness as every verb prints them: of few recordings each, of many what is typical.

use snug_campaign::words::number::{rounded, significant};
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{CampaignResult, Estimate, Interval, Rejection, TighteningResult};
use std::fmt::Write as _;

/// Recordings of which each is told.
const FEW: usize = 4;

/// What is estimated of every rig: column, what it is called, unit.
const BASE: [(&str, &str, &str); 3] = [
    ("mass_kg", "mass", "kg"),
    ("damping_kg_per_s", "damping", "kg/s"),
    ("stiffness_n_per_m", "stiffness", "N/m"),
];

/// One of them, as it is told of this rig.
struct Told {
    column: &'static str,
    called: &'static str,
    unit: String,
    factor: f64,
}

/// The paragraph; empty where nothing was estimated.
pub fn of(result: &CampaignResult) -> String {
    let is_fitted = |one: &&TighteningResult| {
        one.estimate.is_some() && !one.selection.rejections.contains(&Rejection::Validation)
    };
    let fitted: Vec<&TighteningResult> = result.tightenings.iter().filter(is_fitted).collect();
    let told = BASE.map(|(column, called, unit)| told(column, called, unit, result));
    let text = match fitted.len() {
        0 => return String::new(),
        1..=FEW => each(&fitted, &told),
        _ => typical(&fitted, &told),
    };
    result.vocabulary.says(&text)
}

fn told(column: &'static str, called: &'static str, unit: &str, result: &CampaignResult) -> Told {
    let plain = (1.0, unit.to_owned());
    let (factor, unit) = match (result.units.base_parameter(column), result.vocabulary) {
        (Some(declared), _) => (1.0, declared),
        (None, Vocabulary::Machine(Some(axis))) => axis.about(unit),
        (None, _) => plain,
    };
    Told {
        column,
        called: if unit == "kg m^2" { "inertia" } else { called },
        unit,
        factor,
    }
}

/// A line per tightening and parameter.
fn each(fitted: &[&TighteningResult], told: &[Told; 3]) -> String {
    let mut text = format!("\n{} [95 % interval]\n", heading(told));
    for one in fitted {
        let Some(estimate) = &one.estimate else {
            continue;
        };
        let sizes: Vec<String> = (told.iter())
            .filter_map(|told| size(estimate, told))
            .collect();
        line(&mut text, &format!("  {}: {}", one.id, sizes.join("; ")));
    }
    text
}

/// Value, unit and interval, or why there is none.
fn size(estimate: &Estimate, told: &Told) -> Option<String> {
    let parameter = estimate.parameter(told.column)?;
    let interval = parameter.interval.map(|range| Interval {
        low: range.low * told.factor,
        high: range.high * told.factor,
    });
    let shown = rounded(parameter.value * told.factor, interval);
    let behind = match shown.interval {
        _ if parameter.fixed => " (held)".to_owned(),
        Some(interval) => format!(" {interval}"),
        None if is_on_bound(estimate, told.column) => " (on its bound)".to_owned(),
        None => " (not determined)".to_owned(),
    };
    Some(format!(
        "{} {} {}{behind}",
        told.called, shown.value, told.unit
    ))
}

/// Whether a limit chose the value, and not the data.
fn is_on_bound(estimate: &Estimate, column: &str) -> bool {
    let free = |name: &str| {
        let parameter = estimate.parameter(name);
        parameter.is_some_and(|one| !one.fixed && one.interval.is_none())
    };
    free(column) && !estimate.active_constraints.is_empty()
}

/// Median, middle half, the median half width of an interval, and how many lie on a bound.
fn typical(fitted: &[&TighteningResult], told: &[Told; 3]) -> String {
    let selected: Vec<&TighteningResult> = (fitted.iter().copied())
        .filter(|one| one.selection.selected())
        .collect();
    let (which, of) = match selected.is_empty() {
        true => ("fitted, none selected", fitted),
        false => ("selected", selected.as_slice()),
    };
    let mut text = format!(
        "\n{} of {} tightenings ({which})\n  {:<24} {:>11} {:>25} {:>14}\n",
        heading(told),
        of.len(),
        "",
        "median",
        "middle half",
        "± 95 % of one"
    );
    let estimates = || of.iter().filter_map(|one| one.estimate.as_ref());
    for told in told {
        let known = || estimates().filter_map(|one| one.parameter(told.column));
        let values = sorted(known().map(|one| one.value * told.factor));
        let halves = known().filter_map(|one| one.interval);
        let halves = sorted(halves.map(|range| 0.5 * (range.high - range.low) * told.factor));
        let on_bound = estimates().filter(|one| is_on_bound(one, told.column));
        let bound = match on_bound.count() {
            0 => String::new(),
            some => format!("  on its bound in {some}"),
        };
        let number = |all: &[f64], share: f64| {
            quantile(all, share).map_or_else(|| "–".to_owned(), |value| significant(value, 4))
        };
        let middle = format!("{} to {}", number(&values, 0.25), number(&values, 0.75));
        line(
            &mut text,
            &format!(
                "  {:<24} {:>11} {middle:>25} {:>14}{bound}",
                format!("{} [{}]", told.called, told.unit),
                number(&values, 0.5),
                quantile(&halves, 0.5)
                    .map_or_else(|| "–".to_owned(), |value| significant(value, 2)),
            ),
        );
    }
    text
}

fn heading(told: &[Told; 3]) -> String {
    snug_campaign::words::capitalised(&format!("{}, damping and stiffness", told[0].called))
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Of sorted values, between order statistics by linear interpolation; `None` of nothing.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let position = share * sorted.len().checked_sub(1)? as f64;
    let below = position.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    Some(sorted[below] + (position - below as f64) * (sorted[above] - sorted[below]))
}

fn line(text: &mut String, line: &str) {
    let line = line.replace('\u{a0}', " ");
    writeln!(text, "{}", line.trim_end()).expect("a string takes every write");
}
