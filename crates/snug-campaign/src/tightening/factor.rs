//! The factors by which tightenings form groups.

use crate::tightening::id::TighteningId;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A factor by which tightenings form groups that may differ.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Factor {
    /// Who held the tool.
    Participant,
    /// Tightening strategy.
    Strategy,
    /// Joint stiffness.
    Joint,
    /// Tightenings per minute.
    Pace,
    /// Peak torque, rounded.
    TargetTorque,
    /// The file: one set of tightenings, or one tool.
    File,
    /// The number within a file: those before this one, and those from it on.
    FromNumber(u32),
    /// The place in the campaign, files in the order of their names: those before this tightening, and those from it on.
    Since(TighteningId),
    /// The number within a file, evenly: from what is at this number to what is at that.
    Course {
        /// The first number.
        first: u32,
        /// The last.
        last: u32,
    },
}

impl Factor {
    /// Those of conditions and files, in the order in which an explanation is looked for: of two that say the same the first is named.
    pub const ALL: [Self; 6] = [
        Self::Participant,
        Self::Joint,
        Self::Strategy,
        Self::Pace,
        Self::TargetTorque,
        Self::File,
    ];

    /// Whether its groups are a sample of many more: people and tools are, conditions are all there are.
    pub fn is_sample(&self) -> bool {
        matches!(self, Self::Participant | Self::File)
    }

    /// Whether its groups are parts of the time that a campaign took.
    pub fn is_of_time(&self) -> bool {
        matches!(
            self,
            Self::FromNumber(_) | Self::Since(_) | Self::Course { .. }
        )
    }

    /// Several of its groups, as people call them.
    pub fn plural(&self) -> &'static str {
        match self {
            Self::Participant => "participants",
            Self::Strategy => "strategies",
            Self::Joint => "joints",
            Self::Pace => "paces",
            Self::TargetTorque => "target torques",
            Self::File => "files",
            Self::FromNumber(_) | Self::Since(_) | Self::Course { .. } => "tightenings",
        }
    }

    /// How tightenings share a size by it: `per participant`, `before and from number 13 on`.
    pub fn sharing(&self) -> String {
        match self {
            Self::FromNumber(from) => format!("before and from number {from} on"),
            Self::Since(id) => format!("before and from {id} on"),
            Self::Course { first, last } => format!("evenly from number {first} to {last}"),
            other => format!("per {other}"),
        }
    }
}

impl fmt::Display for Factor {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Participant => "participant",
            Self::Strategy => "strategy",
            Self::Joint => "joint",
            Self::Pace => "pace",
            Self::TargetTorque => "target torque",
            Self::File => "file",
            Self::FromNumber(_) | Self::Course { .. } => "number in the file",
            Self::Since(_) => "place in the campaign",
        })
    }
}
