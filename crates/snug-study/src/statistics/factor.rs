//! The factors that tables and tests compare, and the groups of tightenings that each of them makes.

use snug_campaign::{SignalUnits, TighteningResult};
use std::collections::BTreeMap;

/// A condition by which tightenings are grouped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factor {
    Strategy,
    Joint,
    Pace,
    Participant,
    TargetTorque,
}

impl Factor {
    /// In the order of the thesis' tables; a rig whose input is no torque has no target torque.
    pub fn of(units: &SignalUnits) -> impl Iterator<Item = Self> + use<> {
        let torque = units.input_is_torque();
        [
            Self::Strategy,
            Self::Joint,
            Self::Pace,
            Self::Participant,
            Self::TargetTorque,
        ]
        .into_iter()
        .filter(move |factor| torque || *factor != Self::TargetTorque)
    }

    /// Name as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Strategy => "strategy",
            Self::Joint => "joint",
            Self::Pace => "pace_per_min",
            Self::Participant => "participant",
            Self::TargetTorque => "target_torque_nm",
        }
    }

    /// The level a tightening belongs to; `None` when the file does not say.
    pub fn level(self, tightening: &TighteningResult) -> Option<String> {
        let conditions = &tightening.conditions;
        match self {
            Self::Strategy => conditions.strategy.clone(),
            Self::Joint => conditions.joint.clone(),
            Self::Pace => conditions.pace_per_min.map(|pace| pace.to_string()),
            Self::Participant => conditions.participant.clone(),
            // Without a pulse there is no target: its torque rounds to zero, or is unknown.
            Self::TargetTorque => {
                (tightening.target_torque_nm > 0.0).then(|| tightening.target_torque_nm.to_string())
            }
        }
    }

    /// Tightenings by level, numbers in numeric order.
    pub fn groups<'a>(
        self,
        tightenings: &[&'a TighteningResult],
    ) -> Vec<(String, Vec<&'a TighteningResult>)> {
        let mut groups: BTreeMap<String, Vec<&TighteningResult>> = BTreeMap::new();
        for &tightening in tightenings {
            if let Some(level) = self.level(tightening) {
                groups.entry(level).or_default().push(tightening);
            }
        }
        let mut groups: Vec<_> = groups.into_iter().collect();
        if matches!(self, Self::Pace | Self::TargetTorque) {
            let number = |level: &str| level.parse::<f64>().unwrap_or(f64::INFINITY);
            groups.sort_by(|(a, _), (b, _)| number(a).total_cmp(&number(b)));
        }
        groups
    }
}
