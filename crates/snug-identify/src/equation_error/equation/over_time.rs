//! What changes along the recordings: inertia, damping, stiffness or the size of an effect that goes from one value at the beginning of
//! each to another at its end.
//!
//! ```text
//! T = I α + C ω + K θ − Σ s_e g_e,   one of I, C, K, s_e being p + p' τ,   τ from −1 at the beginning of a recording to 1 at its end
//! ```

use super::{MotionEquation, Term};
use crate::equation_error::record::AveragedRecord;
use crate::equation_error::regression::Column;
use snug_least_squares::matrix::dot;

/// Half of a recording over the other that its torque may be, root mean square, and the rate of its torque, for a change between them to
/// be one of the rig and not of how it was driven \[–\]. Chosen: under a sweep or steps that grow, what only depends on frequency or size
/// changes with the time, too.
const DRIVEN_ALIKE: f64 = 1.5;

/// What changes along the recordings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Which: 0 the mass, 1 the damping, 2 the stiffness, then the terms.
    pub index: usize,
    /// What it is at the beginning of each recording \[kg, kg/s or N/m; of a term how many times it acts\].
    pub from: f64,
    /// What it is at the end of each, in the same unit.
    pub to: f64,
    /// Share \[–\] of the squares left without the change that it takes.
    pub taken: f64,
}

impl MotionEquation<'_> {
    /// The change that takes most; `None` where the recordings are not driven alike from beginning to end, or tell nothing.
    pub fn change(&self, terms: &[Term]) -> Option<Change> {
        if !self.records.iter().all(is_driven_alike) {
            return None;
        }
        let left: Vec<Vec<f64>> = self.records.iter().map(|one| one.torque.clone()).collect();
        let constant = self.of_torque(terms);
        let (_, before) = self.regressed(&left, &constant)?;
        let with_change = |index: usize| {
            let mut columns = constant.clone();
            columns.push(self.over_time(&constant[index]));
            let (sizes, after) = self.regressed(&left, &columns)?;
            let (middle, slope) = (sizes[index], *sizes.last()?);
            Some((index, middle - slope, middle + slope, 1.0 - after / before))
        };
        let changes = (0..constant.len()).filter_map(with_change);
        let (index, from, to, taken) = changes.max_by(|a, b| a.3.total_cmp(&b.3))?;
        let rig = self.tasks.first()?.model.rig();
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let told = |value: f64| match index {
            0 => (value - rig.known_inertia_kg_m2) / square,
            1 | 2 => value / square,
            _ => value,
        };
        let change = Change {
            index,
            from: told(from),
            to: told(to),
            taken,
        };
        [change.from, change.to, change.taken]
            .iter()
            .all(|value| value.is_finite())
            .then_some(change)
    }

    /// What makes the torque: α, ω, θ, and what effects take off it.
    fn of_torque(&self, terms: &[Term]) -> Vec<Column> {
        let of_motion = |signal: fn(&AveragedRecord) -> &Vec<f64>| Column {
            of_records: self.records.iter().map(|one| signal(one).clone()).collect(),
            is_exact: false,
            is_one_sided: false,
        };
        let of_terms = terms.iter().map(|term| Column {
            of_records: (term.acting.iter())
                .map(|acting| acting.iter().map(|value| -value).collect())
                .collect(),
            is_exact: false,
            is_one_sided: false,
        });
        let of_base = [
            of_motion(|record| &record.acceleration),
            of_motion(|record| &record.velocity),
            of_motion(|record| &record.angle),
        ];
        of_base.into_iter().chain(of_terms).collect()
    }

    /// A column times τ.
    fn over_time(&self, column: &Column) -> Column {
        let of_record = |(record, values): (&AveragedRecord, &Vec<f64>)| -> Vec<f64> {
            let times = record.times().zip(values);
            times.map(|(time, value)| time * value).collect()
        };
        let records = self.records.iter().zip(&column.of_records);
        Column {
            of_records: records.map(of_record).collect(),
            ..*column
        }
    }
}

fn is_driven_alike(record: &AveragedRecord) -> bool {
    let (first, second) = record.torque.split_at(record.torque.len() / 2);
    let size = |part: &[f64]| (dot(part, part) / part.len().max(1) as f64).sqrt();
    let rate = |part: &[f64]| -> f64 {
        let steps: Vec<f64> = part.windows(2).map(|two| two[1] - two[0]).collect();
        size(&steps)
    };
    let alike = |a: f64, b: f64| a <= DRIVEN_ALIKE * b && b <= DRIVEN_ALIKE * a;
    alike(size(first), size(second)) && alike(rate(first), rate(second))
}
