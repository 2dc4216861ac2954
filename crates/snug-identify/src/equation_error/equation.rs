//! The equation of motion of some recordings of one rig, and what a regression of it says.
//!
//! ```text
//! α = (T − C ω − K θ + Σ s_e g_e) / I        I = I_n + m l²,  C = c l²,  K = k l²
//! ```
//!
//! averaged all along the recordings; g_e is what an effect adds along the measured motion, by its own definition through the
//! model. The left-hand side holds most of the noise; what of it is in ω and θ is looked after by instruments. The normal
//! equations of the recordings are added up.

pub mod over_time;

use crate::constraint_kind::ConstraintKind;
use crate::equation_error::record::AveragedRecord;
use crate::equation_error::regression::{Column, Regression};
use crate::equation_error::thresholds::{
    AVERAGES_PER_UNKNOWN, LEAST_BY_TORQUE, LEAST_HALF_WIDTH, LEAST_SHARE, MOST_PASSED_OVER,
    MOST_PLACES, ROUNDING,
};
use crate::task::FitTask;
use snug_campaign::Parameter;
use snug_least_squares::matrix::dot;
use snug_model::{BASE_PARAMETERS, Effect, Law};

const BASE: usize = BASE_PARAMETERS.len();

/// The equation of motion of some recordings of one rig, averaged alike.
#[derive(Debug, Clone)]
pub struct MotionEquation<'a> {
    tasks: &'a [FitTask<'a>],
    records: Vec<AveragedRecord>,
    /// Samples to either side of every average.
    pub half_width: usize,
}

/// What a regression of the equation of motion says.
#[derive(Debug, Clone, PartialEq)]
pub struct EquationFit {
    /// m, c, k \[kg, kg/s, N/m\]; those that are fixed as they are.
    pub base: [f64; BASE],
    /// How many times each term acts \[–\].
    pub times: Vec<f64>,
    /// Share of the averaged acceleration's power that it explains \[–\].
    pub explained: f64,
    /// Part of that share that is lost without the torque \[–\].
    pub by_torque: f64,
}

/// What acts along the measured motion \[Nm\], record by record.
#[derive(Debug, Clone)]
pub struct Acting(Vec<Vec<f64>>);

/// What an effect adds to that.
#[derive(Debug, Clone)]
pub struct Term {
    acting: Vec<Vec<f64>>,
    is_one_sided: bool,
}

impl Term {
    /// What `effect` adds, with which `after` acts and without which `before`; `None` where that is nothing.
    pub fn between(after: &Acting, before: &Acting, effect: Effect) -> Option<Self> {
        let added = |(after, before): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
            let pairs = after.iter().zip(before);
            pairs.map(|(after, before)| after - before).collect()
        };
        let acting: Vec<Vec<f64>> = after.0.iter().zip(&before.0).map(added).collect();
        let is_there = acting.iter().flatten().any(|value| *value != 0.0);
        is_there.then(|| Self {
            acting,
            is_one_sided: effect.description().parameters[0].minimum >= 0.0,
        })
    }

    /// Whether it is twice `other`, as what is linear in its size is at twice the size.
    pub fn is_twice(&self, other: &Self) -> bool {
        let pairs = || {
            self.acting
                .iter()
                .flatten()
                .zip(other.acting.iter().flatten())
        };
        let off: f64 = pairs()
            .map(|(twice, once)| (twice - 2.0 * once).powi(2))
            .sum();
        let size: f64 = pairs().map(|(_, once)| once * once).sum();
        off < ROUNDING * size
    }
}

impl EquationFit {
    /// Whether it says anything of how the torque moves the rig.
    pub fn is_driven(&self) -> bool {
        self.by_torque >= LEAST_BY_TORQUE
    }
}

impl<'a> MotionEquation<'a> {
    /// Averaged over as many samples as let a regression with `effects`, each of size 1, explain most; `None` where nothing was
    /// measured, the recordings are too short, or the torque has no part in it.
    pub fn of(tasks: &'a [FitTask<'a>], effects: &[Effect]) -> Option<Self> {
        let widths =
            std::iter::successors(Some(LEAST_HALF_WIDTH), |half_width| Some(2 * half_width));
        let mut best: Option<(f64, Self)> = None;
        for half_width in widths {
            let Some(equation) = Self::averaged(tasks, half_width) else {
                break;
            };
            if !equation.has_enough(effects.len()) {
                break;
            }
            let terms: Option<Vec<Term>> = effects
                .iter()
                .map(|&one| equation.term(one, &[1.0]))
                .collect();
            let Some(fit) = terms
                .and_then(|terms| equation.fit(&terms))
                .filter(EquationFit::is_driven)
            else {
                continue;
            };
            if best
                .as_ref()
                .is_none_or(|(known, _)| fit.explained > *known)
            {
                best = Some((fit.explained, equation));
            }
        }
        best.map(|(_, equation)| equation)
    }

    /// Averaged over `half_width` samples to either side; `None` where too many are too short for that, or rest.
    pub fn averaged(tasks: &'a [FitTask<'a>], half_width: usize) -> Option<Self> {
        let most = MOST_PLACES / tasks.len().max(1);
        let records = tasks
            .iter()
            .map(|task| AveragedRecord::of(task, half_width, most));
        let records: Vec<AveragedRecord> = records.collect();
        let all: usize = tasks.iter().map(|task| task.measured().len()).sum();
        let passed_over = tasks.iter().zip(&records);
        let passed_over = passed_over.filter(|(_, record)| record.is_empty());
        let passed_over: usize = passed_over.map(|(task, _)| task.measured().len()).sum();
        let is_enough = all > 0 && passed_over as f64 <= MOST_PASSED_OVER * all as f64;
        is_enough.then_some(Self {
            tasks,
            records,
            half_width,
        })
    }

    /// The same averaged over twice as many samples: less of the noise is left in it, and less of what is fast. `None` where the recordings
    /// are too short for that and so many terms.
    pub fn wider(&self, terms: usize) -> Option<Self> {
        Self::averaged(self.tasks, 2 * self.half_width).filter(|wider| wider.has_enough(terms))
    }

    /// Whether averages that share no sample are many enough for the base model and so many terms.
    fn has_enough(&self, terms: usize) -> bool {
        let independent: usize = self.records.iter().map(|one| one.independent).sum();
        independent >= AVERAGES_PER_UNKNOWN * (BASE + terms)
    }

    /// That of each recording by itself.
    pub fn apart(&self) -> Vec<Self> {
        let records = self.tasks.chunks(1).zip(&self.records);
        let alone = records.map(|(tasks, record)| Self {
            tasks,
            records: vec![record.clone()],
            half_width: self.half_width,
        });
        alone.collect()
    }

    /// What acts along the measured motion beside the base model's torque with these effects and, recording by recording, these
    /// values of all parameters; `None` where that is not finite, or what is measured is another motion than what is driven.
    /// Values of further effects may follow.
    pub fn acting(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<Acting> {
        if effects.iter().any(Effect::changes_what_is_measured) {
            return None;
        }
        let of_record = |((record, task), values): ((&AveragedRecord, &FitTask<'_>), &Vec<f64>)| {
            let model = task.model.with_effects(effects).ok()?;
            record.acting(task, &model, values.get(..model.parameters().len())?)
        };
        let records = self.records.iter().zip(self.tasks).zip(at);
        records.map(of_record).collect::<Option<_>>().map(Acting)
    }

    /// What each of `effects` adds there; `None` in place of one that adds nothing. Together they add what the model adds.
    pub fn terms(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<Vec<Option<Term>>> {
        let mut before = self.acting(&[], at)?;
        let mut terms = Vec::new();
        for (index, &effect) in effects.iter().enumerate() {
            let after = self.acting(&effects[..=index], at)?;
            terms.push(Term::between(&after, &before, effect));
            before = after;
        }
        Some(terms)
    }

    /// What one effect adds to the base model's motion with these values of its own parameters.
    pub fn term(&self, effect: Effect, own: &[f64]) -> Option<Term> {
        let base = |task: &FitTask<'_>| -> Vec<f64> {
            let base = task.model.parameters()[..BASE].iter();
            base.map(|parameter| parameter.value)
                .chain(own.iter().copied())
                .collect()
        };
        let at: Vec<Vec<f64>> = self.tasks.iter().map(base).collect();
        self.terms(&[effect], &at)?.pop()?
    }

    /// The regression with these terms beside torque, velocity and angle; `None` where it has no physical answer.
    pub fn fit(&self, terms: &[Term]) -> Option<EquationFit> {
        let first = self.tasks.first()?;
        let (rig, parameters) = (first.model.rig(), &first.model.parameters()[..BASE]);
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let [mass, damping, stiffness] = [0, 1, 2].map(|index| Known::of(&parameters[index]));
        let driven = |record: &AveragedRecord| -> Vec<f64> {
            let rows = record
                .torque
                .iter()
                .zip(record.velocity.iter().zip(&record.angle));
            rows.map(|(torque, (velocity, angle))| {
                torque - square * (damping.value * velocity + stiffness.value * angle)
            })
            .collect()
        };
        let driven: Vec<Vec<f64>> = self.records.iter().map(driven).collect();
        let known_inertia =
            (mass.is_fixed).then_some(rig.known_inertia_kg_m2 + mass.value * square);
        let left = self.left(&driven, known_inertia)?;
        let columns = self.columns(driven, known_inertia.is_none(), [damping, stiffness], terms);
        let power = self.power();
        let (sizes, left_over) = self.regressed(&left, &columns)?;
        let torque_free = |columns: &[Column]| -> f64 {
            let all: Vec<Vec<f64>> = self
                .records
                .iter()
                .map(|one| one.acceleration.clone())
                .collect();
            self.regressed(&all, columns)
                .map_or(power, |(_, left_over)| left_over)
        };
        let skipped = usize::from(known_inertia.is_none());
        let by_torque = (torque_free(&columns[skipped..]) - left_over) / power;
        let mut sizes = sizes.into_iter();
        let inverse = match known_inertia {
            Some(inertia) => 1.0 / inertia,
            None => sizes.next()?,
        };
        let mut next = |known: Known| match known.is_fixed {
            true => Some(known.value),
            false => Some(sizes.next()? / (inverse * square)),
        };
        let (c, k) = (next(damping)?, next(stiffness)?);
        let times: Vec<f64> = sizes.map(|size| size / inverse).collect();
        let m = (1.0 / inverse - rig.known_inertia_kg_m2) / square;
        let found = EquationFit {
            base: self.positive([mass, damping, stiffness], [m, c, k]),
            times,
            explained: 1.0 - left_over / power,
            by_torque,
        };
        let is_finite = found
            .base
            .iter()
            .chain(&found.times)
            .all(|value| value.is_finite());
        (inverse > 0.0 && is_finite && found.explained.is_finite()).then_some(found)
    }

    /// The left-hand side: the acceleration, without what is known of it where the inertia is.
    fn left(&self, driven: &[Vec<f64>], known_inertia: Option<f64>) -> Option<Vec<Vec<f64>>> {
        let inverse = known_inertia.map_or(0.0, |inertia| 1.0 / inertia);
        let of_record = |(record, driven): (&AveragedRecord, &Vec<f64>)| -> Vec<f64> {
            let rows = record.acceleration.iter().zip(driven);
            rows.map(|(acceleration, driven)| acceleration - inverse * driven)
                .collect()
        };
        inverse
            .is_finite()
            .then(|| self.records.iter().zip(driven).map(of_record).collect())
    }

    /// What is unknown: 1/I, C/I, K/I as far as they are, then the terms.
    fn columns(
        &self,
        driven: Vec<Vec<f64>>,
        is_inertia_unknown: bool,
        [damping, stiffness]: [Known; 2],
        terms: &[Term],
    ) -> Vec<Column> {
        let constraints = &self.tasks[0].settings.constraints;
        let is_positive = constraints.contains(&ConstraintKind::Positive)
            || constraints.contains(&ConstraintKind::Stable);
        let minus = |signal: fn(&AveragedRecord) -> &Vec<f64>| -> Vec<Vec<f64>> {
            let of_record = |one| signal(one).iter().map(|value| -value).collect();
            self.records.iter().map(of_record).collect()
        };
        let is_exact = damping.value == 0.0 && stiffness.value == 0.0;
        let inertia = is_inertia_unknown.then_some(Column {
            of_records: driven,
            is_exact,
            is_one_sided: true,
        });
        let of_motion = [
            (damping, minus(|record| &record.velocity)),
            (stiffness, minus(|record| &record.angle)),
        ];
        let of_motion = of_motion.into_iter().filter(|(known, _)| !known.is_fixed);
        let of_motion = of_motion.map(|(known, of_records)| Column {
            of_records,
            is_exact: false,
            is_one_sided: is_positive || known.is_one_sided,
        });
        let of_terms = terms.iter().map(|term| Column {
            of_records: term.acting.clone(),
            is_exact: false,
            is_one_sided: term.is_one_sided,
        });
        inertia
            .into_iter()
            .chain(of_motion)
            .chain(of_terms)
            .collect()
    }

    /// Sizes by instruments, or without where the recordings are too short for them, and the squares that are left.
    fn regressed(&self, left: &[Vec<f64>], columns: &[Column]) -> Option<(Vec<f64>, f64)> {
        let apart: Vec<usize> = self.records.iter().map(|record| record.apart).collect();
        regressed(left, columns, &apart).or_else(|| self.nearest(left, columns))
    }

    /// The sizes that leave the fewest squares, though noise in the columns makes them too small, and these.
    fn nearest(&self, left: &[Vec<f64>], columns: &[Column]) -> Option<(Vec<f64>, f64)> {
        regressed(left, columns, &vec![0; self.records.len()])
    }

    /// m, c, k that a simulation can begin with: above 0 where they are free.
    fn positive(&self, known: [Known; BASE], found: [f64; BASE]) -> [f64; BASE] {
        let rms = |signal: fn(&AveragedRecord) -> &Vec<f64>| -> f64 {
            let records = self
                .records
                .iter()
                .map(|record| dot(signal(record), signal(record)));
            records.sum::<f64>().sqrt()
        };
        let sizes = [
            rms(|record| &record.acceleration),
            rms(|record| &record.velocity),
            rms(|record| &record.angle),
        ];
        let acting = found
            .iter()
            .zip(sizes)
            .map(|(value, size)| value.abs() * size);
        let least = LEAST_SHARE * acting.fold(0.0, f64::max);
        std::array::from_fn(|index| match known[index].is_fixed {
            true => known[index].value,
            false if known[index].is_one_sided || found[index] >= 0.0 => {
                found[index].max(least / sizes[index])
            }
            false => found[index],
        })
    }

    /// Σ α² \[rad²/s⁴\]: of what a share is meant.
    pub fn power(&self) -> f64 {
        self.records
            .iter()
            .map(|record| dot(&record.acceleration, &record.acceleration))
            .sum()
    }

    /// Share of the averaged acceleration's power that a model with these effects explains, where recordings have these values of
    /// all parameters; `None` where what is measured is another motion than what is driven.
    pub fn explained_by(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<f64> {
        let left = self.torque_left(effects, at)?;
        let left_over: f64 = (left.iter().zip(at))
            .map(|(left, values)| dot(left, left) / self.inertia(values[0]).powi(2))
            .sum();
        Some(1.0 - left_over / self.power()).filter(|share| !share.is_nan())
    }

    /// Squares of the torque \[Nm²\] that it leaves, likewise.
    pub fn squares_left(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<f64> {
        let left = self.torque_left(effects, at)?;
        Some(left.iter().map(|left| dot(left, left)).sum())
    }

    /// Torque that it leaves \[Nm\], record by record, likewise: T − I α − C ω − K θ + Σ g.
    fn torque_left(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let terms = self.terms(effects, at)?;
        let arm_m = self.tasks.first()?.model.rig().lever_arm_m;
        let of_record = |(index, (record, values)): (usize, (&AveragedRecord, &Vec<f64>))| {
            let inertia = self.inertia(values[0]);
            let [c, k] = [1, 2].map(|base| values[base] * arm_m * arm_m);
            let left = |place: usize| {
                let acting = terms.iter().flatten().map(|term| term.acting[index][place]);
                record.torque[place] + acting.sum::<f64>()
                    - inertia * record.acceleration[place]
                    - c * record.velocity[place]
                    - k * record.angle[place]
            };
            (0..record.len()).map(left).collect()
        };
        Some(
            (self.records.iter().zip(at))
                .enumerate()
                .map(of_record)
                .collect(),
        )
    }

    /// Inertia of the rig with this mass \[kg m²\].
    fn inertia(&self, mass_kg: f64) -> f64 {
        let rig = self.tasks[0].model.rig();
        rig.known_inertia_kg_m2 + mass_kg * rig.lever_arm_m * rig.lever_arm_m
    }
}

/// A parameter of the base model as the study says it: its value where that is fixed, else 0.
#[derive(Debug, Clone, Copy)]
struct Known {
    is_fixed: bool,
    is_one_sided: bool,
    value: f64,
}

impl Known {
    fn of(parameter: &Parameter) -> Self {
        Self {
            is_fixed: parameter.fixed,
            is_one_sided: parameter.minimum >= 0.0,
            value: if parameter.fixed {
                parameter.value
            } else {
                0.0
            },
        }
    }
}

/// Sizes by instruments so many places apart in each record, or without where that is 0, and the squares that are left.
fn regressed(left: &[Vec<f64>], columns: &[Column], apart: &[usize]) -> Option<(Vec<f64>, f64)> {
    let regression = Regression {
        left,
        columns,
        apart,
    };
    let sizes = regression.sizes()?;
    let left_over = regression.left_over(&sizes);
    Some((sizes, left_over))
}

#[cfg(test)]
mod tests;
