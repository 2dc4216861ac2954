//! When there is nothing left to gain: the optimality test, and what takes its place where rounding or a rugged cost hides it.

use super::LevenbergMarquardt;
use crate::matrix::norm;
use crate::solver::fit::Status;
use crate::solver::thresholds::{
    CRAWL, LESS_DAMPING, LITTLE_DAMPING, NO_DAMPING, ROUGH_TOLERANCE, TRUSTED_STEPS,
};

impl LevenbergMarquardt<'_> {
    /// Whether the step just found shows that there is nothing left to gain.
    pub(super) fn optimality(&mut self) -> Option<Status> {
        let length = (2.0 * self.here.cost).sqrt();
        let is_small = self.stepper.step.decrement <= self.settings.gradient_tolerance * length;
        if is_small && self.stepper.step.is_conic && self.damping.value > NO_DAMPING {
            // Damping may hide what is left; look again without.
            let damping = std::mem::replace(&mut self.damping.value, NO_DAMPING);
            let found = self.find_step();
            let undamped = self.stepper.step.decrement;
            if !found || undamped > self.settings.gradient_tolerance * length {
                self.damping.value = damping * LESS_DAMPING;
                return (!self.find_step()).then_some(Status::Stalled);
            }
        }
        let is_still = self.damping.value <= LITTLE_DAMPING
            && self.stepper.step.relative_change <= self.settings.step_tolerance;
        (is_small || is_still || self.crawls()).then(|| self.converged())
    }

    /// Whether derivatives that the cost did not follow before predict little, and hardly less than at the step before.
    fn crawls(&mut self) -> bool {
        let predicted = self.predicted_decrease();
        let before = std::mem::replace(&mut self.last_predicted, predicted);
        self.is_hard
            && !self.stepper.step.is_conic
            && predicted > CRAWL * before
            && predicted <= self.stall.crawling * self.here.cost
    }

    /// Converged on the active set; where the gradient vanishes it is empty.
    fn converged(&self) -> Status {
        let length = (2.0 * self.here.cost).sqrt();
        let gradient = norm(&self.here.reachable);
        let presses = gradient > self.settings.gradient_tolerance * length;
        match presses && !self.stepper.step.active.is_empty() {
            true => Status::ConvergedAtConstraint,
            false => Status::Converged,
        }
    }

    /// Whether the step just found deserves a trial: it predicts a decrease that the cost can show, or each one hitherto that
    /// it could not show left less to gain.
    pub(super) fn deserves_trial(&self) -> bool {
        let is_trustworthy =
            self.trusted_steps < TRUSTED_STEPS && self.stepper.step.decrement < self.last_decrement;
        self.stepper.step.predicted > 0.0 && (!self.is_unresolved() || is_trustworthy)
    }

    /// Counts a trial with this gain if it was idle; one that the cost cannot resolve says nothing either way.
    pub(super) fn note_trial(&mut self, gain: f64) {
        let predicts_little = self.stepper.step.predicted < self.stall.predicted * self.here.cost;
        if !predicts_little || gain >= self.stall.recovery {
            self.idle_trials = 0;
        } else if gain < self.stall.gain && !self.is_unresolved() {
            self.idle_trials += 1;
        }
    }

    /// No step decreases the cost: at the optimum as far as rounding or a rugged cost allows, or stuck.
    pub(super) fn end_of_decrease(&mut self) -> Status {
        self.damping.value = NO_DAMPING;
        if !self.find_step() {
            return Status::Stalled;
        }
        let predicts_little = self.predicted_decrease() <= self.stall.optimum * self.here.cost;
        match predicts_little || self.stepper.step.relative_change <= ROUGH_TOLERANCE {
            true => self.converged(),
            false => Status::Stalled,
        }
    }
}
