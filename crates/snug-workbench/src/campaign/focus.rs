//! A closer look at some of the tightenings, a stretch of time or a cell of the map of the missing force: what a page asks for, and
//! what that means here.

use crate::campaign::Campaign;
use crate::error::WorkbenchError;
use serde::Deserialize;
use snug_campaign::words::number::significant;
use snug_diagnose::{Counted, Focus};
use std::ops::RangeInclusive;

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
    /// A cell of the map of the missing force: lower and upper edge of displacement \[m\] and velocity \[m/s\] of the grip, with commas
    /// between them; empty for all of it.
    #[serde(default)]
    pub cell: String,
}

/// Where a grip is, and how fast it moves.
struct Cell {
    x_m: RangeInclusive<f64>,
    v_m_per_s: RangeInclusive<f64>,
}

impl Closer {
    /// Whether it is a look at everything.
    pub fn is_all(&self) -> bool {
        *self == Self::default()
    }

    /// Whether it is a look at a part of every window.
    pub fn is_of_a_part(&self) -> bool {
        self.from_s.is_some() || !self.cell.is_empty()
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
        let counted = match (self.from_s, self.to_s, self.cell()?) {
            (None, None, None) => Counted::All,
            (None, None, Some(Cell { x_m, v_m_per_s })) => Counted::Cell { x_m, v_m_per_s },
            (Some(from_s), Some(to_s), None) if from_s < to_s => {
                Counted::Stretch(sample(from_s)..sample(to_s) + 1)
            }
            (from_s, to_s, None) => return Err(WorkbenchError::NoStretch { from_s, to_s }),
            (_, _, Some(_)) => return Err(WorkbenchError::StretchAndCell),
        };
        Ok(Focus { members, counted })
    }

    fn cell(&self) -> Result<Option<Cell>, WorkbenchError> {
        if self.cell.is_empty() {
            return Ok(None);
        }
        let wrong = || WorkbenchError::NoCell {
            given: self.cell.chars().take(120).collect(),
        };
        let edges: Result<Vec<f64>, _> = self.cell.split(',').map(str::parse).collect();
        let edges = edges.map_err(|_| wrong())?;
        let are_finite = edges.iter().all(|edge| edge.is_finite());
        match edges.as_slice() {
            &[left, right, slow, fast] if are_finite && left < right && slow < fast => {
                Ok(Some(Cell {
                    x_m: left..=right,
                    v_m_per_s: slow..=fast,
                }))
            }
            _ => Err(wrong()),
        }
    }

    /// What is looked at, in words: `participant TP2, from 0.0200 to 0.0800 s`.
    pub fn says(&self, campaign: &Campaign) -> Result<String, WorkbenchError> {
        let who = match self.group.as_str() {
            "" => campaign.says("all tightenings"),
            key => campaign.group(key)?.name.clone(),
        };
        let number = |value: f64| significant(value, 3);
        Ok(match (self.from_s, self.to_s, self.cell()?) {
            (Some(from_s), Some(to_s), _) => {
                format!("{who}, from {} to {} s", number(from_s), number(to_s))
            }
            (_, _, Some(Cell { x_m, v_m_per_s })) => format!(
                "{who}, where the grip is at {} to {} mm and moves at {} to {} m/s",
                number(1e3 * x_m.start()),
                number(1e3 * x_m.end()),
                number(*v_m_per_s.start()),
                number(*v_m_per_s.end())
            ),
            _ => who,
        })
    }
}
