//! Where the model at first leaves more than elsewhere: which tools, from which day to which.
//!
//! A day's mean squared residual of a tool is compared with that of all tools' days, its scatter taken from these (median absolute
//! deviation, growing with the root of the rows), and added up over days less an allowance (cumulative sums: Page 1954). What it finds
//! decides of which rows how many are in the sample, and whose sizes may differ; whether an effect is there the ranking says.

use super::thresholds::{ALLOWANCE_SD, CLIPPED_SD, DECISION_SD};
use crate::functions::question::{State, States, Totals};
use crate::storage::partition::Partition;
use snug_statistics::descriptive::{MAD_OF_NORMAL, median};
use std::collections::BTreeMap;

/// The states of tools that leave more than others on some days.
pub fn where_it_shows(said: &BTreeMap<Partition, Totals>) -> States {
    let days: Vec<(&str, i32, f64, f64)> = (said.iter())
        .filter_map(|(part, totals)| {
            let scale = 2.0 * totals.cost / (totals.residuals - totals.own).max(1.0);
            (totals.members > 0.0).then_some((
                part.tool.as_str(),
                part.days()?,
                scale,
                totals.members,
            ))
        })
        .collect();
    let scales: Vec<f64> = days.iter().map(|(.., scale, _)| *scale).collect();
    let Ok(usual) = median(&scales) else {
        return States::default();
    };
    let far = |(.., scale, rows): &(&str, i32, f64, f64)| (scale - usual) * rows.sqrt();
    let apart: Vec<f64> = days.iter().map(|day| far(day).abs()).collect();
    let spread = median(&apart).unwrap_or(0.0) / MAD_OF_NORMAL;
    if spread <= 0.0 {
        return States::default();
    }
    let last = days.iter().map(|(_, day, ..)| *day).max();
    let mut of_tool: BTreeMap<&str, Vec<(i32, f64)>> = BTreeMap::new();
    for day in &days {
        let own = of_tool.entry(day.0).or_default();
        own.push((day.1, (far(day) / spread).min(CLIPPED_SD) - ALLOWANCE_SD));
    }
    let mut states = BTreeMap::new();
    for (tool, mut days) in of_tool {
        days.sort_by_key(|(day, _)| *day);
        let own_end = days.last().map(|one| one.0);
        let Some((first, end)) = largest_sum(&days) else {
            continue;
        };
        let goes_on = Some(end) == own_end || Some(end) == last;
        let last = (!goes_on).then_some(end);
        states.insert(tool.to_owned(), State { first, last });
    }
    States(states)
}

/// First and last day of the run with the largest sum, if that is beyond chance.
fn largest_sum(days: &[(i32, f64)]) -> Option<(i32, i32)> {
    let (mut sum, mut first) = (0.0, 0);
    let mut best: Option<(f64, i32, i32)> = None;
    for (index, (day, more)) in days.iter().enumerate() {
        if sum <= 0.0 {
            (sum, first) = (0.0, index);
        }
        sum += more;
        if sum >= DECISION_SD && best.is_none_or(|(known, ..)| sum > known) {
            best = Some((sum, days[first].0, *day));
        }
    }
    best.map(|(_, first, last)| (first, last))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Twelve tools over twenty days of 20 rows with 500 residuals each, which leave `left` times the noise's variance, a little more or
    /// less from day to day.
    fn plant(left: impl Fn(usize, usize) -> f64) -> BTreeMap<Partition, Totals> {
        let mut said = BTreeMap::new();
        for (tool, day) in (1..=12).flat_map(|tool| (1..=20).map(move |day| (tool, day))) {
            let name = format!("T{tool:02}");
            let part = Partition::new(&format!("2026-03-{day:02}"), &name).unwrap();
            let scatter = 1.0 + 0.01 * f64::sin((37 * tool + 101 * day) as f64);
            let totals = Totals {
                members: 20.0,
                residuals: 10_060.0,
                own: 60.0,
                cost: 0.5 * 10_000.0 * left(tool, day) * scatter,
                ..Totals::zero(0)
            };
            said.insert(part, totals);
        }
        said
    }

    #[test]
    fn a_change_is_found_with_its_days() {
        let states = where_it_shows(&plant(|tool, day| match (tool, day) {
            (3, 11..) => 1.05,
            (7, 5..=9) => 1.3,
            (9, _) => 1.1,
            _ => 1.0,
        }));
        let named = |tool: &str, day: i32| states.name(tool, Some(20_512 + day));
        assert_eq!(states.0.len(), 3);
        assert_eq!(named("T03", 10), "T03");
        assert_eq!(named("T03", 11), "T03 since 2026-03-11");
        assert_eq!(named("T07", 9), "T07 2026-03-05/2026-03-09");
        assert_eq!(named("T07", 10), "T07");
        assert_eq!(named("T09", 1), "T09 since 2026-03-01");
        assert_eq!(named("T01", 20), "T01");
    }

    #[test]
    fn one_bad_day_is_no_state_and_where_nothing_happens_there_is_none() {
        let one_day = plant(|tool, day| if (tool, day) == (3, 11) { 9.0 } else { 1.0 });
        assert_eq!(where_it_shows(&one_day), States::default());
        assert_eq!(where_it_shows(&plant(|_, _| 1.0)), States::default());
        assert_eq!(where_it_shows(&BTreeMap::new()), States::default());
    }
}
