//! The table of means and spreads per condition, selected and rejected tightenings apart.

use super::factor::Factor;
use super::quantity;
use snug_campaign::{
    ConditionSummary, Interval, Moments, QuantitySummary, SignalUnits, TighteningResult,
};
use snug_statistics::{descriptive, proportion};

/// Count, mean and spread of every quantity: over all, then per level of every factor.
pub fn summaries(tightenings: &[&TighteningResult], units: &SignalUnits) -> Vec<ConditionSummary> {
    let names = quantity::names(tightenings);
    let mut summaries = vec![summary("all", "all".to_owned(), tightenings, &names)];
    for factor in Factor::of(units) {
        for (level, group) in factor.groups(tightenings) {
            summaries.push(summary(factor.name(), level, &group, &names));
        }
    }
    summaries
}

fn summary(
    factor: &str,
    level: String,
    tightenings: &[&TighteningResult],
    names: &[String],
) -> ConditionSummary {
    let selected = tightenings
        .iter()
        .filter(|t| t.selection.selected())
        .count();
    let share = proportion::wilson(selected, tightenings.len(), 0.95).ok();
    ConditionSummary {
        factor: factor.to_owned(),
        level,
        tightenings: tightenings.len(),
        selected,
        selected_share_interval: share.map(|share| interval(share.interval)),
        quantities: names
            .iter()
            .map(|name| QuantitySummary {
                quantity: name.clone(),
                selected: moments(&values(tightenings, name, true)),
                rejected: moments(&values(tightenings, name, false)),
            })
            .collect(),
    }
}

fn values(tightenings: &[&TighteningResult], name: &str, selected: bool) -> Vec<f64> {
    tightenings
        .iter()
        .filter(|t| t.selection.selected() == selected)
        .filter_map(|t| quantity::value(t, name))
        .collect()
}

/// `None` for no values; spread and interval only where two or more values define them.
fn moments(values: &[f64]) -> Option<Moments> {
    let mean = descriptive::mean(values).ok()?;
    Some(Moments {
        count: values.len(),
        mean,
        standard_deviation: descriptive::standard_deviation(values).ok(),
        mean_interval: descriptive::one_sample_t(values, 0.0, 0.95)
            .ok()
            .map(|t| interval(t.interval)),
        median: descriptive::median(values).ok()?,
    })
}

pub(super) fn interval(interval: snug_statistics::Interval) -> Interval {
    Interval {
        low: interval.low,
        high: interval.high,
    }
}
