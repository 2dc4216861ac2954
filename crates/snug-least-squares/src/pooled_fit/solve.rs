//! The pooled fit: every step eliminates the members' own parameters, steps the shared ones, and substitutes back.

use super::member::{Member, reduce};
use super::problem::{PooledFit, PooledResidual, PooledSettings, PooledStep, Trial};
use crate::conic::constraints::Constraints;
use crate::error::SolveError;
use crate::pooled_fit::thresholds::{
    INITIAL_DAMPING, LEAST_DAMPING, MOST_IDLE_STEPS, MOST_PASSES, POOLED_FIRST_DAMPING,
    POOLED_MOST_DAMPING, TOGETHER,
};
use crate::solver::damping::Damping;
use crate::solver::fit::Work;
use crate::solver::step::{Stepper, project};
use crate::solver::thresholds::{RESOLUTION, SUFFICIENT};
use std::ops::ControlFlow;

/// Fits all members together from one start.
///
/// `own_starts` and `own_sets` hold one entry per member; starts outside their set are projected into it.
///
/// # Errors
/// [`SolveError::NoStart`] without a member, and where the residual is not finite at the start.
pub fn solve_pooled(
    residual: &mut dyn PooledResidual,
    own_starts: &[Vec<f64>],
    own_sets: &[Constraints],
    shared_start: &[f64],
    shared_set: &Constraints,
    settings: &PooledSettings,
) -> Result<PooledFit, SolveError> {
    let on = &mut |_| ControlFlow::Continue(());
    solve_pooled_followed(
        residual,
        own_starts,
        own_sets,
        shared_start,
        shared_set,
        settings,
        on,
    )
}

/// The same, followed step by step: `follow` hears of the start and of every step that was tried, and may end the fit, which is
/// then not converged and stands where it stood.
///
/// # Errors
/// As [`solve_pooled`].
pub fn solve_pooled_followed(
    residual: &mut dyn PooledResidual,
    own_starts: &[Vec<f64>],
    own_sets: &[Constraints],
    shared_start: &[f64],
    shared_set: &Constraints,
    settings: &PooledSettings,
    follow: &mut dyn FnMut(PooledStep) -> ControlFlow<()>,
) -> Result<PooledFit, SolveError> {
    let mut fit = PooledSolver::start(residual, own_starts, own_sets, shared_start, shared_set)?;
    if follow(fit.step(true)).is_break() {
        return Ok(fit.finish(false));
    }
    let mut converged = false;
    let mut idle_steps = 0;
    while fit.work.iterations < settings.max_iterations && !converged {
        fit.work.iterations += 1;
        let predicted = fit.find_step();
        let cost = fit.cost;
        let little = settings.cost_tolerance.max(RESOLUTION) * cost;
        if (-RESOLUTION * cost..=little).contains(&predicted) && fit.damping.value < 1.0 {
            converged = true;
        }
        let moved = predicted > 0.0 && fit.try_step(predicted);
        if moved {
            fit.accept();
            let is_idle = cost - fit.cost <= settings.cost_tolerance * cost;
            idle_steps = if is_idle { idle_steps + 1 } else { 0 };
            converged |= idle_steps >= MOST_IDLE_STEPS;
        } else if !converged && !fit.damp_more() {
            break;
        }
        if follow(fit.step(moved)).is_break() {
            return Ok(fit.finish(false));
        }
    }
    Ok(fit.finish(converged))
}

struct PooledSolver<'a> {
    residual: &'a mut dyn PooledResidual,
    own_sets: &'a [Constraints],
    shared_set: &'a Constraints,
    shared: Vec<f64>,
    shared_stepper: Stepper,
    members: Vec<Member>,
    cost: f64,
    cost_there: f64,
    gain: f64,
    damping: Damping,
    work: Work,
}

impl<'a> PooledSolver<'a> {
    fn start(
        residual: &'a mut dyn PooledResidual,
        own_starts: &[Vec<f64>],
        own_sets: &'a [Constraints],
        shared_start: &[f64],
        shared_set: &'a Constraints,
    ) -> Result<Self, SolveError> {
        if own_starts.is_empty() {
            return Err(SolveError::NoStart);
        }
        let mut work = Work::default();
        let mut shared = shared_start.to_vec();
        shared_set.clamp(&mut shared);
        let mut members = Vec::with_capacity(own_starts.len());
        for (index, (start, set)) in own_starts.iter().zip(own_sets).enumerate() {
            let own = if set.contains(start) {
                start.clone()
            } else {
                project(start, set, &mut work).unwrap_or_else(|| start.clone())
            };
            members.push(Member::new(own, residual.shared_of(index)));
        }
        let mut solver = Self {
            residual,
            own_sets,
            shared_set,
            shared,
            shared_stepper: Stepper::new(shared_start.len()),
            members,
            cost: 0.0,
            cost_there: 0.0,
            gain: 1.0,
            damping: Damping::new(INITIAL_DAMPING, LEAST_DAMPING, POOLED_FIRST_DAMPING),
            work,
        };
        let shared = &solver.shared;
        let mut trials: Vec<Trial<'_>> = (solver.members.iter_mut().enumerate())
            .map(|(index, member)| Trial {
                member: index,
                parameters: member.parameters(&member.own, shared),
                linearization: &mut member.here,
            })
            .collect();
        for together in trials.chunks_mut(TOGETHER) {
            (solver.residual.linearize(together)).map_err(|_| SolveError::NoStart)?;
        }
        solver.cost = solver.members.iter().map(|member| member.here.cost).sum();
        solver.work.linearizations += solver.members.len();
        Ok(solver)
    }

    /// Where it stands.
    fn step(&self, moved: bool) -> PooledStep {
        PooledStep {
            iterations: self.work.iterations,
            cost: self.cost,
            moved,
        }
    }

    /// Computes the damped step of α and of every β_i; returns the decrease it predicts.
    fn find_step(&mut self) -> f64 {
        let mut shift = vec![0.0; self.shared.len()];
        for pass in 0..=MOST_PASSES {
            let mut has_changed = false;
            for (member, set) in self.members.iter_mut().zip(self.own_sets) {
                has_changed |= member.follow(&shift, self.damping.value, set, &mut self.work);
            }
            let is_settled = pass > 0 && !has_changed;
            if is_settled || shift.is_empty() || pass == MOST_PASSES {
                break;
            }
            if !self.find_shift(&mut shift) {
                return 0.0;
            }
        }
        let predicted = self
            .members
            .iter()
            .map(|member| member.predicted_decrease(&shift));
        predicted.sum()
    }

    /// The damped step of α, every β_i following along the inequalities that it presses on; false when none was found.
    fn find_shift(&mut self, shift: &mut [f64]) -> bool {
        for (member, set) in self.members.iter_mut().zip(self.own_sets) {
            member.eliminate(self.damping.value, set);
        }
        let reduced = reduce(&self.members, shift.len());
        self.shared_stepper.rescale(&reduced, 0.0);
        let found = self.shared_stepper.find(
            &self.shared,
            &reduced,
            self.damping.value,
            self.shared_set,
            &mut self.work,
        );
        shift.copy_from_slice(self.shared_stepper.displacement());
        found
    }

    /// Evaluates the trial point; true when the cost falls by a part of what was predicted.
    fn try_step(&mut self, predicted: f64) -> bool {
        let target = &self.shared_stepper.step.target;
        let mut cost = 0.0;
        let mut trials: Vec<Trial<'_>> = (self.members.iter_mut().enumerate())
            .map(|(index, member)| Trial {
                member: index,
                parameters: member.parameters(&member.stepper.step.target, target),
                linearization: &mut member.there,
            })
            .collect();
        for together in trials.chunks_mut(TOGETHER) {
            self.work.linearizations += together.len();
            if self.residual.linearize(together).is_err() {
                return false;
            }
            for trial in together {
                cost += trial.linearization.cost;
            }
            // Members' costs only add up: no need to see the rest of a step that is already worse.
            if cost > self.cost {
                return false;
            }
        }
        self.cost_there = cost;
        self.gain = (self.cost - cost) / predicted;
        self.cost - cost > SUFFICIENT * predicted
    }

    fn accept(&mut self) {
        self.shared
            .copy_from_slice(&self.shared_stepper.step.target);
        for member in &mut self.members {
            member.own.copy_from_slice(&member.stepper.step.target);
            std::mem::swap(&mut member.here, &mut member.there);
        }
        self.cost = self.cost_there;
        self.damping.relax(self.gain);
    }

    /// After a rejected step; false when no damping is left that would change anything.
    fn damp_more(&mut self) -> bool {
        self.damping.raise();
        self.damping.value < POOLED_MOST_DAMPING
    }

    fn finish(mut self, converged: bool) -> PooledFit {
        let work = &mut self.work;
        let profiles = (self.members.iter_mut().zip(self.own_sets))
            .map(|(member, set)| member.profile(set, work))
            .collect();
        PooledFit {
            profiles,
            own: self.members.iter().map(|m| m.own.clone()).collect(),
            shared: self.shared,
            converged,
            work: self.work,
        }
    }
}
