//! What changes along the recordings: inertia, damping, stiffness or the size of an effect that goes from one value at the beginning of
//! all or some of them to another at their end, evenly or at once.
//!
//! ```text
//! T = I α + C ω + K θ − Σ s_e g_e,   one of I, C, K, s_e being p + p' h(τ),   τ from −1 at the beginning of a recording to 1 at its end,
//! h(τ) = τ, or −1 before τ₀ and 1 after;   where only some recordings change, p + d + p' h(τ) in these and p in the others
//! ```

use super::{MotionEquation, Term};
use crate::equation_error::record::AveragedRecord;
use crate::equation_error::regression::{Column, Regression};
use crate::task::FitTask;
use snug_campaign::{Quantity, Rig};
use snug_least_squares::matrix::dot;
use snug_model::BASE_PARAMETERS;

/// Place of the stiffness among what makes the torque.
const STIFFNESS: usize = 2;
/// Half of a recording over the other that its torque may be, root mean square, and the rate of its torque, for a change between them to
/// be one of the rig and not of how it was driven \[–\]. Chosen: under a sweep or steps that grow, what only depends on frequency or size
/// changes with the time, too.
const DRIVEN_ALIKE: f64 = 1.5;
/// Where in the recordings a change at once is looked for: so many places between beginning and end. Chosen.
const PLACES: usize = 15;
/// Parts of the way from one of these to the next in which the best is looked for more closely. Chosen.
const PARTS: u32 = 6;
/// Recordings, those that change most, of which some are said to change and the others not. Chosen.
const MOST_OF_SOME: usize = 6;
/// Squares that a change at once, or in some recordings only, must leave over those of an even one in all to be the likelier story, and over
/// those of recordings that only differ \[–\]. Chosen.
const PLAINLY_LESS: f64 = 0.5;
/// Share of a value by which means of it differ all the same \[–\]. Chosen: of some thousands of samples.
const ROUNDING: f64 = 1e-9;

/// What changes along the recordings.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Which: 0 the mass, 1 the damping, 2 the stiffness, then the terms.
    pub index: usize,
    /// What it is at the beginning of each recording that changes \[kg, kg/s or N/m; of a term how many times it acts\].
    pub from: f64,
    /// What it is at the end of each, in the same unit.
    pub to: f64,
    /// Share \[–\] of the squares left without the change that it takes: of what the numbers leave that leave least, or the fitted model. Those of a
    /// regression by instruments that tell little may leave far more.
    pub taken: f64,
    /// Where in these recordings it changes at once, from −1 at the beginning to 1 at the end \[–\]; `None` where it does so evenly.
    pub at: Option<f64>,
    /// The recordings that change, in their order.
    pub recordings: Vec<usize>,
}

impl MotionEquation<'_> {
    /// The change that takes most; `None` where the recordings are not driven alike from beginning to end, or tell nothing. `fitted` are the
    /// [squares](Self::squares_left) that a model leaves whose numbers stay, infinitely many where none was fitted.
    pub fn change(&self, terms: &[Term], fitted: f64) -> Option<Change> {
        if !self.records.iter().all(is_driven_alike) {
            return None;
        }
        let left: Vec<Vec<f64>> = self.records.iter().map(|one| one.torque.clone()).collect();
        let constant = self.of_torque(terms);
        let (sizes, _) = self.regressed(&left, &constant)?;
        let before = self.nearest(&left, &constant)?.1.min(fitted);
        let rest = rest(&left, &constant, &sizes);
        let with_change = |index: usize, at: Option<f64>, recordings: &[usize]| {
            let mut columns = constant.clone();
            let changing =
                |course: &dyn Fn(f64) -> f64| self.over_time(&constant[index], course, recordings);
            let are_some = recordings.len() < self.records.len();
            if are_some {
                columns.push(changing(&|_| 1.0));
            }
            // Of recordings that are others from beginning to end nothing changes.
            let without = match are_some {
                true => self.regressed(&left, &columns)?.1,
                false => f64::INFINITY,
            };
            columns.push(changing(&|time| course(time, at)));
            let (sizes, after) = self.regressed(&left, &columns)?;
            if after > PLAINLY_LESS * without {
                return None;
            }
            let (slope, apart) = (*sizes.last()?, &sizes[constant.len()..sizes.len() - 1]);
            let middle = sizes[index] + apart.iter().sum::<f64>();
            let change = Change {
                index,
                from: middle - slope,
                to: middle + slope,
                taken: 1.0 - after / before,
                at,
                recordings: recordings.to_vec(),
            };
            (self.may_change(&change, &constant[index], &sizes)).then_some(change)
        };
        let all: Vec<usize> = (0..self.records.len()).collect();
        let evenly = most((0..constant.len()).filter_map(|index| with_change(index, None, &all)))?;
        let others = (0..constant.len()).filter_map(|index| {
            let some = self.some(&rest, &constant[index]);
            let some = some.iter().chain([&all]);
            let evenly = most(some.filter_map(|group| with_change(index, None, group)))?;
            let at_once = [&all, &evenly.recordings]
                .into_iter()
                .flat_map(|group| places().filter_map(|at| with_change(index, Some(at), group)));
            let best = most(at_once.chain([evenly.clone()]))?;
            let nearer = best.at.into_iter().flat_map(beside);
            let nearer = nearer.filter_map(|at| with_change(index, Some(at), &best.recordings));
            most(nearer.chain([best.clone()]))
        });
        let is_plainly_more =
            |other: &Change| 1.0 - other.taken < PLAINLY_LESS * (1.0 - evenly.taken);
        let change = most(others).filter(is_plainly_more).unwrap_or(evenly);
        let told = change.on_arm(self.tasks.first()?.model.rig());
        Some(told).filter(Change::is_finite)
    }

    /// Whether a rig's number may change so: mass, damping and stiffness keep their sign, and a spring brings back, beside the inertia and
    /// damping of these `sizes`, what moves while it is recorded. One that takes longer is what little a regression finds of an angle that
    /// runs on, which is a load as well. Against a spring that does bring back, an angle that is the sum of a measured velocity drifts with
    /// what that reads too much, and so does the load that is found.
    fn may_change(&self, change: &Change, column: &Column, sizes: &[f64]) -> bool {
        if !change.is_finite() {
            return false;
        }
        if change.index >= BASE_PARAMETERS.len() {
            let is_summed = |task: &FitTask<'_>| task.quantity() == Quantity::Velocity;
            let may_drift = self.tasks.iter().any(is_summed) && is_load(column);
            return !(may_drift && self.brings_back(sizes[STIFFNESS], change, sizes));
        }
        let stiffest = f64::max(change.from.abs(), change.to.abs());
        let keeps_sign = change.from * change.to >= 0.0;
        keeps_sign && (change.index != STIFFNESS || self.brings_back(stiffest, change, sizes))
    }

    /// Whether a spring so stiff \[Nm/rad\] brings the rig back, beside the inertia and damping of these `sizes`, while the recordings of a
    /// `change` last.
    fn brings_back(&self, stiffness: f64, change: &Change, sizes: &[f64]) -> bool {
        let (inertia, damping) = (sizes[0].abs(), sizes[1].abs());
        let stiffness = stiffness.abs();
        let brings_back_s = f64::max((inertia / stiffness).sqrt(), damping / stiffness);
        let lasts_s = (change.recordings.iter())
            .map(|&one| &self.tasks[one])
            .map(|task| task.measured().len() as f64 * task.tightening.time_base.interval_s)
            .fold(0.0, f64::max);
        brings_back_s < lasts_s
    }

    /// The recordings by whose own even change of a `column` most of the `rest` is taken, then those and the next, and so on.
    fn some(&self, rest: &[Vec<f64>], column: &Column) -> Vec<Vec<usize>> {
        let all: Vec<usize> = (0..self.records.len()).collect();
        let evenly = self.over_time(column, &|time| time, &all).of_records;
        let taken = |&record: &usize| {
            let (rest, course) = (&rest[record], &evenly[record]);
            dot(rest, course).powi(2) / dot(course, course)
        };
        let mut order: Vec<usize> = all
            .into_iter()
            .filter(|&one| !rest[one].is_empty())
            .collect();
        order.sort_by(|a, b| taken(b).total_cmp(&taken(a)));
        let groups = 1..order.len().min(MOST_OF_SOME + 1);
        let sorted = groups.map(|many| {
            let mut group = order[..many].to_vec();
            group.sort_unstable();
            group
        });
        sorted.collect()
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

    /// A column times what goes with the time in these recordings; nothing in the others.
    fn over_time(
        &self,
        column: &Column,
        course: &dyn Fn(f64) -> f64,
        recordings: &[usize],
    ) -> Column {
        let records = self.records.iter().zip(&column.of_records).enumerate();
        let of_records = records.map(|(place, (record, values))| {
            let changes = f64::from(u8::from(recordings.contains(&place)));
            let times = record.times().zip(values);
            let times = times.map(|(time, value)| changes * course(time) * value);
            times.collect()
        });
        Column {
            of_records: of_records.collect(),
            ..*column
        }
    }
}

/// h(τ).
fn course(time: f64, at: Option<f64>) -> f64 {
    match at {
        Some(at) if time < at => -1.0,
        Some(_) => 1.0,
        None => time,
    }
}

impl Change {
    /// The same of what moves on the arm of this `rig`, where it was of what turns.
    fn on_arm(self, rig: &Rig) -> Self {
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let told = |value: f64| match self.index {
            0 => (value - rig.known_inertia_kg_m2) / square,
            1 | 2 => value / square,
            _ => value,
        };
        Self {
            from: told(self.from),
            to: told(self.to),
            ..self
        }
    }

    fn is_finite(&self) -> bool {
        [self.from, self.to, self.taken]
            .iter()
            .all(|value| value.is_finite())
    }
}

/// Whether a column is that of a load: the same all along each recording, but for rounding.
fn is_load(column: &Column) -> bool {
    let is_even = |values: &Vec<f64>| {
        let first = values.first().copied().unwrap_or_default();
        let apart = |value: &f64| (value - first).abs() > ROUNDING * first.abs();
        !values.iter().any(apart)
    };
    column.of_records.iter().all(is_even)
}

/// Places at which something may change at once.
fn places() -> impl Iterator<Item = f64> {
    let parts = (PLACES + 1) as f64;
    (1..=PLACES).map(move |place| 2.0 * place as f64 / parts - 1.0)
}

/// Places between one of these and the next to either side.
fn beside(place: f64) -> impl Iterator<Item = f64> {
    let apart = 2.0 / (PLACES + 1) as f64;
    let parts = (1..PARTS).map(|part| f64::from(part) / f64::from(PARTS));
    parts.flat_map(move |part| [place - part * apart, place + part * apart])
}

/// What columns of these sizes leave of the left-hand side, record by record.
fn rest(left: &[Vec<f64>], columns: &[Column], sizes: &[f64]) -> Vec<Vec<f64>> {
    let regression = Regression {
        left,
        columns,
        apart: &[],
    };
    let of_record = |record| regression.rest(sizes, record).collect();
    (0..left.len()).map(of_record).collect()
}

fn most(changes: impl Iterator<Item = Change>) -> Option<Change> {
    changes.max_by(|a, b| a.taken.total_cmp(&b.taken))
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
