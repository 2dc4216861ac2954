//! A closer look at some of the tightenings, or at a stretch of time: what a page asks for, and what that means here.

use crate::campaign::Campaign;
use crate::error::WorkbenchError;
use serde::Deserialize;
use snug_campaign::Factor;
use snug_diagnose::{Focus, LiveCases};

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

/// What a page looks at more closely; as addresses have it.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Closer {
    /// The key of a group; empty for all tightenings.
    #[serde(default)]
    pub group: String,
    /// Where the stretch begins, since the window's start \[s\].
    pub from_s: Option<f64>,
    /// Where it ends \[s\].
    pub to_s: Option<f64>,
}

impl Closer {
    /// Whether it is a look at everything.
    pub fn is_all(&self) -> bool {
        *self == Self::default()
    }

    /// Whether it is a look at a part of the time.
    pub fn is_of_a_stretch(&self) -> bool {
        self.from_s.is_some()
    }

    /// Which tightenings and samples that are.
    pub fn focus(&self, campaign: &Campaign) -> Result<Focus, WorkbenchError> {
        let tasks = campaign.prepared.live.tasks();
        let members = match self.group.as_str() {
            "" => (0..tasks.len()).collect(),
            key => campaign.group(key)?.members.clone(),
        };
        let interval_s = tasks[0].tightening.time_base.interval_s;
        let sample = |time_s: f64| (time_s / interval_s).round().max(0.0) as usize;
        let samples = match (self.from_s, self.to_s) {
            (Some(from_s), Some(to_s)) if from_s < to_s => Some(sample(from_s)..sample(to_s) + 1),
            (None, None) => None,
            (from_s, to_s) => return Err(WorkbenchError::NoStretch { from_s, to_s }),
        };
        Ok(Focus { members, samples })
    }

    /// What is looked at, in words: `participant TP2, 20 to 80 ms`.
    pub fn says(&self, campaign: &Campaign) -> Result<String, WorkbenchError> {
        let who = match self.group.as_str() {
            "" => campaign.says("all tightenings"),
            key => campaign.group(key)?.name.clone(),
        };
        Ok(match (self.from_s, self.to_s) {
            (Some(from_s), Some(to_s)) => {
                let number = |time_s: f64| snug_campaign::words::number::significant(time_s, 3);
                format!("{who}, from {} to {} s", number(from_s), number(to_s))
            }
            _ => who,
        })
    }
}

impl Campaign {
    /// The group with this key.
    pub fn group(&self, key: &str) -> Result<&Group, WorkbenchError> {
        let found = self.groups.iter().find(|group| group.key == key);
        found.ok_or_else(|| WorkbenchError::NoGroup {
            key: key.to_owned(),
            keys: self.groups.iter().map(|group| group.key.clone()).collect(),
        })
    }
}
