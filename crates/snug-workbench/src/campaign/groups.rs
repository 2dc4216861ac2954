//! Tightenings by their conditions: each group can be looked at alone.

use snug_campaign::Factor;
use snug_diagnose::LiveCases;

/// Tightenings that have a condition in common.
pub(crate) struct Group {
    /// As addresses have it: `participant:TP2`.
    pub key: String,
    /// As people say it: `participant TP2`.
    pub name: String,
    /// Which tightenings.
    pub members: Vec<usize>,
}

/// Groups of one condition beyond which it is not offered: a list of hundreds helps nobody. Chosen.
const MOST_LEVELS: usize = 40;

/// Every group of every condition that has more than one.
pub(crate) fn groups(live: &LiveCases) -> Vec<Group> {
    Factor::ALL
        .iter()
        .flat_map(|factor| of(live, factor))
        .collect()
}

fn of(live: &LiveCases, factor: &Factor) -> Vec<Group> {
    let mut found: Vec<(snug_campaign::Level, Vec<usize>)> = Vec::new();
    for (member, task) in live.tasks().iter().enumerate() {
        let Some(level) = factor.level(&task.tightening) else {
            continue;
        };
        match found.iter_mut().find(|(known, _)| *known == level) {
            Some((_, members)) => members.push(member),
            None => found.push((level, vec![member])),
        }
    }
    found.sort_by(|(a, _), (b, _)| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    if !(2..=MOST_LEVELS).contains(&found.len()) {
        return Vec::new();
    }
    let group = |(level, members): (snug_campaign::Level, Vec<usize>)| Group {
        key: format!("{factor}:{}", level.name),
        name: format!("{factor} {}", level.name),
        members,
    };
    found.into_iter().map(group).collect()
}
