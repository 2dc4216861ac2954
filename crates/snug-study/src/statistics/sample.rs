//! The values that a test compares.

use super::factor::Factor;
use super::quantity;
use snug_campaign::TighteningResult;
use std::collections::BTreeMap;

/// Values of one quantity by level of one factor, with the participant of every value.
pub struct Sample {
    /// Values by level, in the quantity's unit.
    pub groups: Vec<Vec<f64>>,
    /// The level of every value.
    pub levels: Vec<usize>,
    /// The participant of every value.
    pub participants: Vec<usize>,
    /// Every value, level after level, in the quantity's unit.
    pub values: Vec<f64>,
}

impl Sample {
    /// The values of quantity `name` that tightenings with a level have.
    pub fn of(tightenings: &[&TighteningResult], name: &str, factor: Factor) -> Self {
        let mut participants: BTreeMap<String, usize> = BTreeMap::new();
        let mut sample = Self {
            groups: Vec::new(),
            levels: Vec::new(),
            participants: Vec::new(),
            values: Vec::new(),
        };
        for (level, (_, group)) in factor.groups(tightenings).iter().enumerate() {
            let mut values = Vec::new();
            for tightening in group {
                let Some(value) = quantity::value(tightening, name) else {
                    continue;
                };
                // Files that name no participant are taken as one participant each.
                let who = Factor::Participant
                    .level(tightening)
                    .unwrap_or_else(|| tightening.id.file.clone());
                let next = participants.len();
                values.push(value);
                sample.levels.push(level);
                sample
                    .participants
                    .push(*participants.entry(who).or_insert(next));
                sample.values.push(value);
            }
            sample.groups.push(values);
        }
        sample
    }
}
