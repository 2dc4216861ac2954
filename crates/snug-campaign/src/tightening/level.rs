//! Which group of a factor a tightening is in.

use crate::tightening::factor::Factor;
use crate::tightening::prepared::Tightening;

/// Which group of a factor; groups of numbers come in their order, others in that of their names.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
pub struct Level {
    number: f64,
    /// As people write it.
    pub name: String,
}

impl Level {
    fn of_number(number: f64, name: String) -> Self {
        Self { number, name }
    }
}

impl Factor {
    /// The group of one tightening, or the two between which it stands, with the share of each, which add up to 1; `None` where
    /// nothing says it.
    pub fn shares(&self, tightening: &Tightening) -> Option<Vec<(Level, f64)>> {
        let Self::Course { first, last } = *self else {
            return Some(vec![(self.level(tightening)?, 1.0)]);
        };
        let number = f64::from(tightening.id.number.clamp(first, last.max(first)));
        let way = (number - f64::from(first)) / f64::from(last.saturating_sub(first).max(1));
        let end = |number: u32| Level::of_number(f64::from(number), format!("at number {number}"));
        Some(vec![(end(first), 1.0 - way), (end(last), way)])
    }

    /// The group of one tightening, the nearer where it stands between two; `None` where nothing says it.
    pub fn level(&self, tightening: &Tightening) -> Option<Level> {
        let conditions = &tightening.conditions;
        let named = |name: &Option<String>| Some(Level::of_number(0.0, name.clone()?));
        let part = |is_later: bool, before: String, from: String| {
            let (number, name) = if is_later { (1.0, from) } else { (0.0, before) };
            Some(Level::of_number(number, name))
        };
        match self {
            Self::Participant => named(&conditions.participant),
            Self::Strategy => named(&conditions.strategy),
            Self::Joint => named(&conditions.joint),
            Self::Pace => (conditions.pace_per_min)
                .map(|pace| Level::of_number(pace, format!("{pace} per min"))),
            Self::TargetTorque => {
                let target = tightening.target_torque_nm;
                (target.is_finite() && target != 0.0)
                    .then(|| Level::of_number(target, format!("{target} Nm")))
            }
            Self::File => {
                let file = &tightening.id.file;
                (!file.is_empty()).then(|| Level::of_number(0.0, file.clone()))
            }
            Self::FromNumber(from) => part(
                tightening.id.number >= *from,
                format!("up to number {}", from.saturating_sub(1)),
                format!("from number {from} on"),
            ),
            Self::Since(id) => part(
                tightening.id >= *id,
                format!("before {id}"),
                format!("from {id} on"),
            ),
            Self::Course { .. } => {
                let shares = self.shares(tightening)?.into_iter();
                let nearer = shares.max_by(|(_, a), (_, b)| a.total_cmp(b));
                nearer.map(|(level, _)| level)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::rig::Rig;
    use crate::tightening::id::TighteningId;

    fn tightening(file: &str, number: u32) -> Tightening {
        let rig = Rig {
            lever_arm_m: 0.33,
            known_inertia_kg_m2: 0.15,
        };
        let mut one = Tightening::from_torque(rig, 1e-3, vec![0.0; 3]);
        one.id = TighteningId {
            file: file.to_owned(),
            number,
        };
        one
    }

    fn named(factor: &Factor, file: &str, number: u32) -> String {
        let level = factor.level(&tightening(file, number));
        level.expect("every tightening has a number").name
    }

    #[test]
    fn a_change_parts_what_is_before_from_what_comes_after() {
        let number = Factor::FromNumber(3);
        assert_eq!(named(&number, "b.mat", 2), "up to number 2");
        assert_eq!(named(&number, "a.mat", 3), "from number 3 on");
        let place = Factor::Since(tightening("b.mat", 3).id);
        assert_eq!(named(&place, "a.mat", 9), "before b.mat #3");
        assert_eq!(named(&place, "b.mat", 2), "before b.mat #3");
        assert_eq!(named(&place, "b.mat", 3), "from b.mat #3 on");
        assert_eq!(named(&place, "c.mat", 1), "from b.mat #3 on");
    }

    /// Number 2 of 1 to 5 has come a quarter of the way; what lies beyond an end is at it.
    #[test]
    fn on_a_course_a_tightening_has_its_share_of_both_ends() {
        let course = Factor::Course { first: 1, last: 5 };
        for (number, way) in [(1, 0.0), (2, 0.25), (5, 1.0), (9, 1.0)] {
            let shares = course.shares(&tightening("a.mat", number)).expect("known");
            let of_ends: Vec<f64> = shares.iter().map(|(_, share)| *share).collect();
            assert_eq!(of_ends, [1.0 - way, way]);
        }
        assert_eq!(named(&course, "a.mat", 2), "at number 1");
        assert_eq!(named(&course, "a.mat", 4), "at number 5");
    }
}
