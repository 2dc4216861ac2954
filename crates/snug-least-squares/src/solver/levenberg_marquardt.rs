//! Levenberg–Marquardt over a convex set, written as questions and answers.
//!
//! Whoever runs a fit evaluates its problem: one after the other ([`solve`](crate::solve)), or many fits side by side. So the
//! algorithm does not call the residual, it asks for what it needs ([`Query`]) and goes on when it is answered.

mod optimality;
mod stall;

use crate::conic::constraints::Constraints;
use crate::error::{EvaluationError, SolveError};
use crate::problem::linearization::Linearization;
use crate::solver::damping::Damping;
use crate::solver::fit::{ActiveConstraint, Fit, Status, Work};
use crate::solver::settings::Settings;
use crate::solver::step::{Stepper, project};
use crate::solver::thresholds::{
    FIRST_DAMPING, LONG_FIT, MOST_DAMPING, NO_DAMPING, RESOLUTION, SHORT_MEMORY, SUFFICIENT,
};
use crate::uncertainty::identifiability::analyse;
use stall::{StallCriteria, TO_CHANCE, TO_ROUNDING};

/// What a fit asks next.
pub enum Query<'s> {
    /// Cost, gradient and curvature; answered by [`LevenbergMarquardt::linearized`].
    Linearization {
        /// The parameters.
        at: &'s [f64],
        /// Gets them.
        into: &'s mut Linearization,
    },
    /// The cost alone; answered by [`LevenbergMarquardt::costed`].
    Cost {
        /// The parameters.
        at: &'s [f64],
    },
    /// Jᵀ r″ as [`LeastSquares::second_derivative`](crate::LeastSquares::second_derivative) defines it; answered by
    /// [`LevenbergMarquardt::second_derivative_known`].
    SecondDerivative {
        /// The parameters.
        at: &'s [f64],
        /// The direction v of r″ = d²r(p + t v)/dt².
        along: &'s [f64],
        /// Gets Jᵀ r″.
        into: &'s mut [f64],
    },
    /// Nothing: it has ended.
    Nothing,
}

/// Where a fit stands: what it waits for.
#[derive(Clone, Copy)]
enum Stage {
    /// The start, linearised.
    Start,
    /// The second derivative along the step.
    SecondDerivative,
    /// The cost at the trial point.
    Cost,
    /// The trial point, linearised.
    Trial,
    /// Nothing more.
    Ended(Status),
}

/// One fit from one start.
pub struct LevenbergMarquardt<'a> {
    stage: Stage,
    constraints: &'a Constraints,
    settings: &'a Settings,
    stall: StallCriteria,
    values: Vec<f64>,
    here: Linearization,
    there: Linearization,
    stepper: Stepper,
    damping: Damping,
    /// Decrease of the last trial over the decrease predicted.
    gain: f64,
    /// The last trial was rejected, so the next is first judged by its cost alone.
    is_cautious: bool,
    /// A trial was rejected some time: steps follow curved valleys, where that is worth it.
    is_hard: bool,
    is_accelerated: bool,
    second_derivative: Vec<f64>,
    /// Steps taken on trust, because the cost could not resolve them.
    trusted_steps: usize,
    last_decrement: f64,
    last_predicted: f64,
    /// Trials in a row that hardly lowered the cost.
    idle_trials: usize,
    work: Work,
}

/// The algorithm: linearise, test for optimality, find a step, try it, accept or reject it.
impl LevenbergMarquardt<'_> {
    /// What is to be evaluated next.
    pub fn query(&mut self) -> Query<'_> {
        let trial = &self.stepper.step.target;
        match self.stage {
            Stage::Start => Query::Linearization {
                at: &self.values,
                into: &mut self.here,
            },
            Stage::SecondDerivative => Query::SecondDerivative {
                at: &self.values,
                along: self.stepper.displacement(),
                into: &mut self.second_derivative,
            },
            Stage::Cost => Query::Cost { at: trial },
            Stage::Trial => Query::Linearization {
                at: trial,
                into: &mut self.there,
            },
            Stage::Ended(_) => Query::Nothing,
        }
    }

    /// Goes on after a linearisation.
    pub fn linearized(&mut self, outcome: Result<(), EvaluationError>) {
        self.work.linearizations += 1;
        match (self.stage, outcome) {
            (Stage::Start, Ok(())) => self.propose(),
            (Stage::Start, Err(error)) => {
                tracing::debug!(%error, "no finite residual at the start");
                self.here.cost = f64::NAN;
                self.stage = Stage::Ended(Status::Failed);
            }
            (_, Ok(())) if self.is_better(self.there.cost) => self.accept(),
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

    /// Goes on after the second derivative, `Ok(false)` where it is not known; a step that cannot be trusted is rejected.
    pub fn second_derivative_known(&mut self, outcome: Result<bool, EvaluationError>) {
        self.work.evaluations += usize::from(outcome != Ok(false));
        let is_trusted = match outcome {
            Ok(true) => (self.stepper).accelerate(&self.second_derivative, self.constraints),
            Ok(false) => true,
            Err(_) => false,
        };
        match is_trusted {
            true => self.try_target(),
            false => self.reject(),
        }
    }

    /// From one point to the next trial, or to the end.
    fn propose(&mut self) {
        loop {
            if self.work.iterations == self.settings.max_iterations {
                return self.stage = Stage::Ended(Status::IterationLimit);
            }
            if self.idle_trials >= self.stall.trials {
                return self.stage = Stage::Ended(self.end_of_decrease());
            }
            if self.find_step() {
                if let Some(status) = self.optimality() {
                    return self.stage = Stage::Ended(status);
                }
                self.work.iterations += 1;
                if self.deserves_trial() {
                    return self.begin_trial();
                }
            }
            if !self.damp_more() {
                return self.stage = Stage::Ended(self.end_of_decrease());
            }
        }
    }

    /// The minimiser of the damped local model over the set; false when none was found.
    fn find_step(&mut self) -> bool {
        let is_late = self.work.iterations >= LONG_FIT;
        let memory = if is_late { SHORT_MEMORY } else { 1.0 };
        self.stepper.rescale(&self.here, memory);
        self.stepper.find(
            &self.values,
            &self.here,
            self.damping.value,
            self.constraints,
            &mut self.work,
        )
    }

    /// A free step follows the valley's curve first, where the fit is a hard one.
    fn begin_trial(&mut self) {
        let is_free = !self.is_unresolved() && !self.stepper.step.is_conic;
        match self.is_accelerated && self.is_hard && is_free {
            true => self.stage = Stage::SecondDerivative,
            false => self.try_target(),
        }
    }

    fn try_target(&mut self) {
        self.stage = match self.is_cautious {
            true => Stage::Cost,
            false => Stage::Trial,
        };
    }

    /// Moves to the trial point and adapts the damping to how well the model predicted it.
    fn accept(&mut self) {
        self.gain = (self.here.cost - self.there.cost) / self.stepper.step.predicted;
        self.note_trial(self.gain);
        if self.is_unresolved() {
            self.trusted_steps += 1;
            self.last_decrement = self.stepper.step.decrement;
            self.gain = 1.0;
        }
        self.tell("accepted", self.there.cost);
        self.damping.relax(self.gain);
        self.values.copy_from_slice(&self.stepper.step.target);
        std::mem::swap(&mut self.here, &mut self.there);
        self.is_cautious = false;
        self.propose();
    }

    fn reject(&mut self) {
        self.note_trial(0.0);
        self.tell("rejected", self.here.cost);
        match self.damp_more() {
            true => self.propose(),
            false => self.stage = Stage::Ended(self.end_of_decrease()),
        }
    }

    /// After a rejected step; false when no damping is left that would change anything.
    fn damp_more(&mut self) -> bool {
        self.is_cautious = true;
        self.is_hard = true;
        self.damping.raise();
        let moves = self.stepper.step.relative_change > f64::EPSILON;
        !self.is_unresolved() && moves && self.damping.value < MOST_DAMPING
    }

    /// Whether the trial point is at least as good as predicted in part, or indistinguishable.
    fn is_better(&self, cost: f64) -> bool {
        match self.is_unresolved() {
            true => cost <= self.here.cost * (1.0 + 10.0 * RESOLUTION),
            false => self.here.cost - cost > SUFFICIENT * self.stepper.step.predicted,
        }
    }

    /// The predicted decrease is too small for the cost to show it.
    fn is_unresolved(&self) -> bool {
        self.stepper.step.predicted < RESOLUTION * self.here.cost
    }

    /// A line of the iteration table, for whoever listens at the level `trace`.
    fn tell(&self, what: &str, cost: f64) {
        let (step, work) = (&self.stepper.step, &self.work);
        tracing::trace!(
            "iteration {:>4}  cost {cost:<13.7e}  predicted decrease {:<9.2e}  damping {:<8.1e}  largest relative change \
             {:<8.1e}  active {}  {what}",
            work.iterations,
            step.predicted,
            self.damping.value,
            step.relative_change,
            step.active.len(),
        );
    }
}

/// How a fit begins, what it tells, and how it ends.
impl<'a> LevenbergMarquardt<'a> {
    /// From `start`, over `n` parameters; a start outside the constraints is projected onto them.
    ///
    /// # Errors
    /// As [`solve`](crate::solve).
    pub fn new(
        n: usize,
        start: &[f64],
        constraints: &'a Constraints,
        settings: &'a Settings,
    ) -> Result<Self, SolveError> {
        settings.check()?;
        constraints.check(n)?;
        if start.len() != n {
            return Err(SolveError::Dimension {
                what: "the start",
                expected: n,
                found: start.len(),
            });
        }
        if let Some(parameter) = start.iter().position(|value| !value.is_finite()) {
            let value = start[parameter];
            return Err(SolveError::Start { parameter, value });
        }
        let mut work = Work::default();
        let values = match constraints.contains(start) {
            true => start.to_vec(),
            false => project(start, constraints, &mut work).ok_or_else(|| {
                let all = 0..constraints.inequality_count();
                let names = all.filter(|&index| constraints.is_finite(index));
                SolveError::NoFeasiblePoint {
                    names: names
                        .map(|index| constraints.inequality_name(index))
                        .collect(),
                }
            })?,
        };
        Ok(Self {
            stage: Stage::Start,
            constraints,
            settings,
            stall: TO_ROUNDING,
            values,
            here: Linearization::new(n),
            there: Linearization::new(n),
            stepper: Stepper::new(n),
            damping: Damping::new(settings.initial_damping, NO_DAMPING, FIRST_DAMPING),
            gain: 1.0,
            is_cautious: false,
            is_hard: false,
            is_accelerated: true,
            second_derivative: vec![0.0; n],
            trusted_steps: 0,
            last_decrement: f64::INFINITY,
            last_predicted: f64::INFINITY,
            idle_trials: 0,
            work,
        })
    }

    /// Ends where a rugged cost leaves nothing to gain but what cannot be told from chance, as in a fit of a measurement.
    pub fn to_chance(self) -> Self {
        Self {
            stall: TO_CHANCE,
            ..self
        }
    }

    /// Never asks for the second derivative along a step.
    pub fn without_acceleration(self) -> Self {
        Self {
            is_accelerated: false,
            ..self
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
    pub fn predicted_cost(&self, values: &[f64]) -> f64 {
        let step: Vec<f64> = (values.iter().zip(&self.values))
            .map(|(to, from)| to - from)
            .collect();
        self.here.cost + self.here.rise(&step)
    }

    /// Decrease of the cost that is left by its derivatives, as far as the last step found shows.
    pub fn predicted_decrease(&self) -> f64 {
        0.5 * self.stepper.step.decrement.powi(2)
    }

    /// Whether it asks for nothing more.
    pub fn has_ended(&self) -> bool {
        matches!(self.stage, Stage::Ended(_))
    }

    /// The work so far.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// The outcome of a fit that has ended, over `residual_count` residuals.
    ///
    /// # Panics
    /// When it has not ended.
    pub fn finish(self, residual_count: usize) -> Fit {
        let Stage::Ended(status) = self.stage else {
            unreachable!("a fit is finished when it asks for nothing more");
        };
        let n = self.values.len();
        let cost = self.here.cost;
        let (factor, rank_tolerance) = match status {
            Status::Failed => (vec![0.0; n * n], f64::INFINITY),
            _ => (self.here.factor, self.here.rank_tolerance),
        };
        let active: Vec<_> = match status {
            Status::Converged | Status::Failed => Vec::new(),
            _ => self.stepper.step.active.clone(),
        };
        let normals: Vec<Vec<f64>> = (active.iter())
            .map(|entry| (self.constraints).inequality_normal(entry.inequality, &self.values))
            .collect();
        let analysis = analyse(&factor, &normals, rank_tolerance);
        let identifiability = analysis.identifiability;
        let status = match status {
            Status::Failed => Status::Failed,
            _ if identifiability.rank < identifiability.free => Status::NotIdentifiable,
            status => status,
        };
        let active = active.iter().map(|entry| ActiveConstraint {
            name: self.constraints.inequality_name(entry.inequality),
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
