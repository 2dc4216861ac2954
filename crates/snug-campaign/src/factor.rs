//! The factors by which tightenings form groups.

use crate::Tightening;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A factor by which tightenings form groups that may differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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
}

/// Which group of a factor; groups of numbers come in their order, others in that of their names.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
pub struct Level {
    number: f64,
    /// As people write it.
    pub name: String,
}

impl Factor {
    /// All of them, in the order in which an explanation is looked for: of two that say the same the first is named.
    pub const ALL: [Self; 6] = [
        Self::Participant,
        Self::Joint,
        Self::Strategy,
        Self::Pace,
        Self::TargetTorque,
        Self::File,
    ];

    /// Stable snake-case name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Participant => "participant",
            Self::Strategy => "strategy",
            Self::Joint => "joint",
            Self::Pace => "pace_per_min",
            Self::TargetTorque => "target_torque_nm",
            Self::File => "file",
        }
    }

    /// The group of one tightening; `None` where nothing says it.
    pub fn level(self, tightening: &Tightening) -> Option<Level> {
        let conditions = &tightening.conditions;
        let named = |name: &Option<String>| {
            Some(Level {
                number: 0.0,
                name: name.clone()?,
            })
        };
        match self {
            Self::Participant => named(&conditions.participant),
            Self::Strategy => named(&conditions.strategy),
            Self::Joint => named(&conditions.joint),
            Self::Pace => conditions.pace_per_min.map(|pace| Level {
                number: pace,
                name: format!("{pace} per min"),
            }),
            Self::TargetTorque => {
                let target = tightening.target_torque_nm;
                (target.is_finite() && target != 0.0).then(|| Level {
                    number: target,
                    name: format!("{target} Nm"),
                })
            }
            Self::File => {
                let file = &tightening.id.file;
                (!file.is_empty()).then(|| Level {
                    number: 0.0,
                    name: file.clone(),
                })
            }
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
        })
    }
}
