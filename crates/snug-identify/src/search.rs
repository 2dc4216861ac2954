mod patience;

use crate::fit::{ActiveConstraint, Fit, Status, Work};
use crate::identifiability::analyse;
use crate::step::{NO_DAMPING, Stepper, project};
use crate::{Constraints, EvaluationError, IdentifyError, Linearization, Settings};
use patience::{Patience, SHORT, THOROUGH};

/// A decrease below this share of the cost drowns in the cost's rounding.
const RESOLUTION: f64 = 1e-13;
/// Damping at which no parameter moves any more.
const MOST_DAMPING: f64 = 1e30;
/// Below this much damping a step is as good as undamped for the optimality tests.
const LITTLE_DAMPING: f64 = 1e-9;
/// Steps taken on trust, because the cost cannot resolve them, before the fit rests.
const TRUSTED_STEPS: usize = 20;
/// Steps after which the scale of the parameters no longer remembers the start: the way to the optimum may lead through a
/// valley where they matter a thousand times less than there.
const LONG_FIT: usize = 400;
/// Share of its scale that a parameter keeps per step then.
const SHORT_MEMORY: f64 = 0.5;
/// A search crawls when a step leaves more than this share of what the one before had left; near a smooth optimum steps leave
/// far less.
const CRAWL: f64 = 0.1;
/// Relative change of the parameters accepted when rounding forbids a smaller one.
const ROUGH_TOLERANCE: f64 = 1e-5;

/// What a search needs to know before it can go on.
pub(crate) enum Ask<'s> {
    /// Cost, gradient and curvature at these values; answered by [`Search::linearized`].
    Linearization {
        at: &'s [f64],
        into: &'s mut Linearization,
    },
    /// The cost alone; answered by [`Search::costed`].
    Cost { at: &'s [f64] },
    /// As [`LeastSquares::bending`](crate::LeastSquares::bending); answered by [`Search::bent`].
    Bending {
        at: &'s [f64],
        along: &'s [f64],
        into: &'s mut [f64],
    },
    /// It has ended.
    Nothing,
}

/// Where a search stands: what it waits for.
#[derive(Clone, Copy)]
enum Stage {
    /// The start, linearized.
    Start,
    /// How the path bends along the step.
    Bending,
    /// The cost at the trial point.
    Cost,
    /// The trial point, linearized.
    Trial,
    /// Nothing more.
    Ended(Status),
}

/// One fit, which asks for what it needs to know and takes the answer, so that whoever runs it decides how problems are
/// evaluated: one after the other, or many side by side.
pub(crate) struct Search<'a> {
    stage: Stage,
    constraints: &'a Constraints,
    settings: &'a Settings,
    patience: Patience,
    values: Vec<f64>,
    here: Linearization,
    there: Linearization,
    stepper: Stepper,
    damping: f64,
    /// Factor of the next increase of the damping.
    growth: f64,
    /// Decrease of the last trial over the decrease promised.
    gain: f64,
    /// The last trial was rejected, so the next is first judged by its cost alone.
    is_cautious: bool,
    /// A trial was rejected some time: steps are bent along curved valleys, where that is worth it.
    is_hard: bool,
    bends: bool,
    bending: Vec<f64>,
    trusted_steps: usize,
    last_decrement: f64,
    last_promise: f64,
    /// Idle trials since one gave hope.
    idle_trials: usize,
    work: Work,
}

impl<'a> Search<'a> {
    /// From `start`, over `n` parameters.
    pub fn new(
        n: usize,
        start: &[f64],
        constraints: &'a Constraints,
        settings: &'a Settings,
    ) -> Result<Self, IdentifyError> {
        settings.check()?;
        constraints.check(n)?;
        if start.len() != n {
            return Err(IdentifyError::Dimension {
                what: "the start",
                expected: n,
                found: start.len(),
            });
        }
        if let Some(parameter) = start.iter().position(|value| !value.is_finite()) {
            let value = start[parameter];
            return Err(IdentifyError::Start { parameter, value });
        }
        let mut work = Work::default();
        let values = match constraints.contains(start) {
            true => start.to_vec(),
            false => project(start, constraints, &mut work).ok_or_else(|| {
                let faces = 0..constraints.face_count();
                let names = faces.filter(|&face| constraints.is_finite(face));
                IdentifyError::NoFeasiblePoint {
                    names: names.map(|face| constraints.face_name(face)).collect(),
                }
            })?,
        };
        Ok(Self {
            stage: Stage::Start,
            constraints,
            settings,
            patience: THOROUGH,
            values,
            here: Linearization::new(n),
            there: Linearization::new(n),
            stepper: Stepper::new(n),
            damping: settings.initial_damping,
            growth: 2.0,
            gain: 1.0,
            is_cautious: false,
            is_hard: false,
            bends: true,
            bending: vec![0.0; n],
            trusted_steps: 0,
            last_decrement: f64::INFINITY,
            last_promise: f64::INFINITY,
            idle_trials: 0,
            work,
        })
    }

    /// Rests where a rugged cost leaves nothing to gain but what cannot be told from chance.
    pub fn of_measurement(self) -> Self {
        Self {
            patience: SHORT,
            ..self
        }
    }

    /// Never asks how the residual bends along a step.
    pub fn straight(self) -> Self {
        Self {
            bends: false,
            ..self
        }
    }

    /// What is to be evaluated next.
    pub fn ask(&mut self) -> Ask<'_> {
        match self.stage {
            Stage::Start => Ask::Linearization {
                at: &self.values,
                into: &mut self.here,
            },
            Stage::Bending => Ask::Bending {
                at: &self.values,
                along: self.stepper.displacement(),
                into: &mut self.bending,
            },
            Stage::Cost => Ask::Cost {
                at: &self.stepper.step.target,
            },
            Stage::Trial => Ask::Linearization {
                at: &self.stepper.step.target,
                into: &mut self.there,
            },
            Stage::Ended(_) => Ask::Nothing,
        }
    }

    /// The best values so far.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Lowest cost so far; not a number where there is none.
    pub fn cost(&self) -> f64 {
        self.here.cost
    }

    /// The cost at `values` by the derivatives here: ½‖r + J (values − here)‖².
    pub fn foretold(&self, values: &[f64]) -> f64 {
        let step: Vec<f64> = values
            .iter()
            .zip(&self.values)
            .map(|(to, from)| to - from)
            .collect();
        self.here.cost + self.here.rise(&step)
    }

    /// Decrease of the cost that is left by its derivatives, as far as the last step found shows.
    pub fn promise(&self) -> f64 {
        0.5 * self.stepper.step.decrement.powi(2)
    }

    /// Whether it asks for nothing more.
    pub fn has_ended(&self) -> bool {
        matches!(self.stage, Stage::Ended(_))
    }

    /// Steps tried so far.
    pub fn steps(&self) -> usize {
        self.work.iterations
    }

    /// The work so far.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// Goes on after a linearization.
    pub fn linearized(&mut self, outcome: Result<(), EvaluationError>) {
        self.work.linearizations += 1;
        match (self.stage, outcome) {
            (Stage::Start, Ok(())) => self.propose(),
            (Stage::Start, Err(error)) => {
                tracing::debug!(%error, "no finite residual at the start");
                self.here.cost = f64::NAN;
                self.stage = Stage::Ended(Status::Failed);
            }
            (_, Ok(())) if self.is_better(self.there.cost) => {
                self.gain = (self.here.cost - self.there.cost) / self.stepper.step.predicted;
                self.note_trial(self.gain);
                self.accept();
                self.propose();
            }
            _ => self.reject(),
        }
    }

    /// Goes on after an evaluation of the cost.
    pub fn costed(&mut self, outcome: Result<f64, EvaluationError>) {
        self.work.evaluations += 1;
        match outcome {
            Ok(cost) if self.is_better(cost) => self.stage = Stage::Trial,
            _ => self.reject(),
        }
    }

    /// Goes on after an evaluation of the bending; a step that cannot be trusted is rejected.
    pub fn bent(&mut self, outcome: Result<bool, EvaluationError>) {
        let is_known = outcome != Ok(false);
        self.work.evaluations += usize::from(is_known);
        let is_trusted = match outcome {
            Ok(true) => self.stepper.bend(&self.bending, self.constraints),
            Ok(false) => true,
            Err(_) => false,
        };
        if is_trusted {
            self.try_target();
        } else {
            self.reject();
        }
    }

    /// From one point to the next trial, or to the end.
    fn propose(&mut self) {
        loop {
            if self.work.iterations == self.settings.max_iterations {
                return self.stage = Stage::Ended(Status::IterationLimit);
            }
            if self.idle_trials >= self.patience.trials {
                return self.stage = Stage::Ended(self.end_of_decrease());
            }
            if self.find_step() {
                if let Some(status) = self.optimality() {
                    return self.stage = Stage::Ended(status);
                }
                self.work.iterations += 1;
                if self.is_promising() {
                    return self.try_step();
                }
            }
            if !self.damp_more() {
                return self.stage = Stage::Ended(self.end_of_decrease());
            }
        }
    }

    /// Bends a free step with the residual's second derivative along it first, where the fit is a hard one.
    fn try_step(&mut self) {
        if self.bends && self.is_hard && !self.is_unresolved() && !self.stepper.step.is_conic {
            self.stage = Stage::Bending;
        } else {
            self.try_target();
        }
    }

    fn try_target(&mut self) {
        self.stage = if self.is_cautious {
            Stage::Cost
        } else {
            Stage::Trial
        };
    }

    fn reject(&mut self) {
        self.note_trial(0.0);
        if self.damp_more() {
            self.propose();
        } else {
            self.stage = Stage::Ended(self.end_of_decrease());
        }
    }

    fn find_step(&mut self) -> bool {
        let is_late = self.work.iterations >= LONG_FIT;
        let memory = if is_late { SHORT_MEMORY } else { 1.0 };
        self.stepper.rescale(&self.here, memory);
        self.stepper.find(
            &self.values,
            &self.here,
            self.damping,
            self.constraints,
            &mut self.work,
        )
    }

    /// Whether the step just found shows that there is nothing left to gain.
    fn optimality(&mut self) -> Option<Status> {
        let length = (2.0 * self.here.cost).sqrt();
        let is_small = self.stepper.step.decrement <= self.settings.gradient_tolerance * length;
        if is_small && self.stepper.step.is_conic && self.damping > NO_DAMPING {
            // Damping may hide what is left; look again without.
            let damping = std::mem::replace(&mut self.damping, NO_DAMPING);
            let found = self.find_step();
            let undamped = self.stepper.step.decrement;
            if !found || undamped > self.settings.gradient_tolerance * length {
                self.damping = damping * 1e-3;
                return (!self.find_step()).then_some(Status::Stalled);
            }
        }
        let is_still = self.damping <= LITTLE_DAMPING
            && self.stepper.step.relative_change <= self.settings.step_tolerance;
        (is_small || is_still || self.crawls()).then(|| self.converged())
    }

    /// Whether derivatives that the cost did not follow before promise little, and hardly less than at the step before.
    fn crawls(&mut self) -> bool {
        let promise = self.promise();
        let before = std::mem::replace(&mut self.last_promise, promise);
        self.is_hard
            && !self.stepper.step.is_conic
            && promise > CRAWL * before
            && promise <= self.patience.crawling * self.here.cost
    }

    /// Converged on the faces that press; where the gradient vanishes none does.
    fn converged(&self) -> Status {
        let length = (2.0 * self.here.cost).sqrt();
        let gradient = crate::dense::norm(&self.here.reachable);
        let presses = gradient > self.settings.gradient_tolerance * length;
        if presses && !self.stepper.step.active.is_empty() {
            Status::ConvergedAtConstraint
        } else {
            Status::Converged
        }
    }

    /// Whether the step just found deserves a trial.
    fn is_promising(&self) -> bool {
        let is_trustworthy =
            self.trusted_steps < TRUSTED_STEPS && self.stepper.step.decrement < self.last_decrement;
        self.stepper.step.predicted > 0.0 && (!self.is_unresolved() || is_trustworthy)
    }

    /// The promised decrease is too small for the cost to show it.
    fn is_unresolved(&self) -> bool {
        self.stepper.step.predicted < RESOLUTION * self.here.cost
    }

    /// Whether the trial point is at least as good as promised in part, or indistinguishable.
    fn is_better(&self, cost: f64) -> bool {
        if self.is_unresolved() {
            cost <= self.here.cost * (1.0 + 10.0 * RESOLUTION)
        } else {
            self.here.cost - cost > 1e-4 * self.stepper.step.predicted
        }
    }

    /// Counts a trial with this gain if it was idle; one that the cost cannot resolve says nothing either way.
    fn note_trial(&mut self, gain: f64) {
        let promises_little = self.stepper.step.predicted < self.patience.promise * self.here.cost;
        if !promises_little || gain >= self.patience.hope {
            self.idle_trials = 0;
        } else if gain < self.patience.gain && !self.is_unresolved() {
            self.idle_trials += 1;
        }
    }

    /// Moves to the trial point and adapts the damping to how well the model foretold it.
    fn accept(&mut self) {
        if self.is_unresolved() {
            self.trusted_steps += 1;
            self.last_decrement = self.stepper.step.decrement;
            self.gain = 1.0;
        }
        self.damping = (self.damping * relief(self.gain)).max(NO_DAMPING);
        self.values.copy_from_slice(&self.stepper.step.target);
        std::mem::swap(&mut self.here, &mut self.there);
        self.is_cautious = false;
        self.growth = 2.0;
    }

    /// After a rejected step; false when no damping is left that would change anything.
    fn damp_more(&mut self) -> bool {
        self.is_cautious = true;
        self.is_hard = true;
        self.damping = self.damping.max(1e-12) * self.growth;
        self.growth *= 2.0;
        let moves = self.stepper.step.relative_change > f64::EPSILON;
        !self.is_unresolved() && moves && self.damping < MOST_DAMPING
    }

    /// No step decreases the cost: at the optimum as far as rounding or a rugged cost allows, or stuck.
    fn end_of_decrease(&mut self) -> Status {
        self.damping = NO_DAMPING;
        if !self.find_step() {
            return Status::Stalled;
        }
        let promises_little = self.promise() <= self.patience.optimum * self.here.cost;
        if promises_little || self.stepper.step.relative_change <= ROUGH_TOLERANCE {
            self.converged()
        } else {
            Status::Stalled
        }
    }

    /// The outcome of a search that has ended, over `residual_count` residuals.
    pub fn finish(self, residual_count: usize) -> Fit {
        let Stage::Ended(status) = self.stage else {
            unreachable!("a search is finished when it asks for nothing more");
        };
        let n = self.values.len();
        let cost = self.here.cost;
        let (factor, rank_tolerance) = match status {
            Status::Failed => (vec![0.0; n * n], f64::INFINITY),
            _ => (self.here.factor, self.here.rank_tolerance),
        };
        let pressing: Vec<_> = match status {
            Status::Converged | Status::Failed => Vec::new(),
            _ => self.stepper.step.active.clone(),
        };
        let normals: Vec<Vec<f64>> = (pressing.iter())
            .map(|entry| self.constraints.face_normal(entry.face, &self.values))
            .collect();
        let analysis = analyse(&factor, &normals, rank_tolerance);
        let identifiability = analysis.identifiability;
        let status = match status {
            Status::Failed => Status::Failed,
            _ if identifiability.rank < identifiability.free => Status::NotIdentifiable,
            status => status,
        };
        let active = pressing.iter().map(|entry| ActiveConstraint {
            name: self.constraints.face_name(entry.face),
            multiplier: entry.multiplier.max(0.0),
        });
        tracing::debug!(?status, cost, work = ?self.work, "fit ended");
        Fit {
            active: active.collect(),
            values: self.values,
            cost,
            residual_count,
            status,
            identifiability,
            work: self.work,
            covariance_root: analysis.covariance_root,
            determined: analysis.determined,
        }
    }
}

/// Factor on the damping after an accepted step with this gain (Nielsen 1999), smaller where the model is good.
fn relief(gain: f64) -> f64 {
    let surprise = (2.0 * gain - 1.0).clamp(-1.0, 1.0);
    if gain > 0.9 {
        0.05
    } else {
        (1.0 - surprise.powi(3)).max(0.2)
    }
}
