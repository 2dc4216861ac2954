//! A pooled model as the solver asks it: what every tightening leaves, and how that depends on its own and the shared parameters.

use crate::data::simulation::{Asked, simulate};
use crate::pooled::between::once;
use crate::pooled::model::PooledModel;
use snug_identify::smooth;
use snug_least_squares::{EvaluationError, PooledResidual, Trial};

impl PooledResidual for PooledModel<'_> {
    fn member_count(&self) -> usize {
        self.cases.len()
    }

    fn own_count(&self) -> usize {
        self.own.len()
    }

    fn shared_count(&self) -> usize {
        self.shared.len()
    }

    fn shared_of(&self, member: usize) -> Vec<usize> {
        self.shared_of[member].clone()
    }

    fn linearize(&mut self, trials: &mut [Trial<'_>]) -> Result<(), EvaluationError> {
        let order = self.order();
        let mut room = std::mem::take(&mut self.room);
        let values: Vec<Vec<f64>> = (trials.iter())
            .map(|trial| {
                let (own, part) = trial.parameters.split_at(self.own.len());
                self.values_of(trial.member, own, part)
            })
            .collect();
        let asked: Vec<Asked<'_>> = (trials.iter().zip(&values))
            .map(|(trial, values)| Asked {
                member: trial.member,
                input: &self.cases[trial.member].input,
                values,
            })
            .collect();
        let simulated = &mut room.simulated;
        simulate(&self.cases, &self.models, &asked, &once(&order), simulated);
        let mut outcome = Ok(());
        for (index, trial) in trials.iter_mut().enumerate() {
            let (residual, jacobian) = self.weigh_simulated(trial.member, &order, index, &mut room);
            if self.reach > 0 {
                smooth(residual, self.reach);
                for column in jacobian.chunks_exact_mut(residual.len()) {
                    smooth(column, self.reach);
                }
            }
            outcome = outcome.and(trial.linearization.set_jacobian(residual, jacobian));
        }
        self.room = room;
        outcome
    }
}

impl PooledModel<'_> {
    /// Weighted residuals of all members, and parameters that are fitted to them.
    pub(super) fn residuals_and_parameters(&self) -> (usize, usize) {
        let members = 0..self.cases.len();
        let residuals = members.map(|member| self.residual_count(member)).sum();
        (
            residuals,
            self.cases.len() * self.own.len() + self.shared.len(),
        )
    }
}
