//! A set of effects as one statement about all tightenings: each its own m, c, k, the effects' sizes shared; of a few recordings
//! of one machine m, c, k are shared, too.

mod starts;

use crate::data::cases::Cases;
use crate::data::follower::Follower;
use crate::data::simulation::{Asked, Simulated, simulate};
use crate::error::DiagnoseError;
use crate::pooled::between::{mix, once, places_in};
use crate::pooled::error_beyond::error_beyond;
use crate::pooled::parameter_place::first_parameter;
use crate::pooled::sharing::{SharedSize, SharedSizes, Sharing, shared_sizes};
use snug_identify::{FitTask, Scoring, convex_set, identify_all};
use snug_least_squares::{
    Constraints, PooledFit, PooledSettings, PooledStep, solve_pooled_followed,
};
use snug_model::{BASE_PARAMETERS, Effect, Law, Model, Scope};
use std::ops::ControlFlow;

/// A set of effects, ready to be fitted to all tightenings together.
pub(crate) struct PooledModel<'a> {
    pub cases: Cases<'a>,
    pub effects: Vec<Effect>,
    pub sharing: Sharing,
    pub models: Vec<Model>,
    scorings: Vec<Scoring>,
    /// Indices (into the model's parameters) of what every tightening has of its own.
    pub own: Vec<usize>,
    /// Indices of what is shared, whether by all or by the tightenings of a group; of a size between two groups' it stands twice.
    pub common: Vec<usize>,
    /// What is shared: each of the common parameters, where a group has its own once for every group.
    pub shared: Vec<SharedSize>,
    /// Which of these are each member's, one for each of the common parameters in their order.
    pub shared_of: Vec<Vec<usize>>,
    /// How much of each; `None` where all count whole.
    pub shares: Option<Vec<Vec<f64>>>,
    pub(super) own_sets: Vec<Constraints>,
    shared_set: Constraints,
    pub(super) room: Room,
    /// Samples to either side over which residuals are averaged, see [`PooledModel::fit_averaged`].
    pub(super) reach: usize,
}

/// Buffers of one evaluation.
#[derive(Default)]
pub(crate) struct Room {
    pub(super) simulated: Vec<Simulated>,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
}

/// Where a pooled fit begins.
#[derive(Debug, Clone)]
pub(crate) struct Start {
    pub own: Vec<Vec<f64>>,
    pub shared: Vec<f64>,
}

impl Start {
    /// Where `fit` ended.
    pub fn at(fit: &PooledFit) -> Self {
        Self {
            own: fit.own.clone(),
            shared: fit.shared.clone(),
        }
    }
}

/// What some members have of their own.
pub(crate) fn pick(own: &[Vec<f64>], members: &[usize]) -> Vec<Vec<f64>> {
    members.iter().map(|&member| own[member].clone()).collect()
}

impl<'a> PooledModel<'a> {
    /// The study's base model with exactly these effects, each size the same for all.
    pub fn new(cases: Cases<'a>, effects: &[Effect]) -> Result<Self, DiagnoseError> {
        Self::shared_by(cases, effects, &Sharing::default())
    }

    /// The study's base model with exactly these effects, their sizes shared as `sharing` says.
    pub fn shared_by(
        cases: Cases<'a>,
        effects: &[Effect],
        sharing: &Sharing,
    ) -> Result<Self, DiagnoseError> {
        let models = cases
            .iter()
            .map(|case| case.model_with(effects))
            .collect::<Result<Vec<_>, _>>()?;
        let first = &models[0];
        let base: Vec<usize> = (0..BASE_PARAMETERS.len()).collect();
        let (mut own, mut common) = match cases.are_of_one_machine() {
            true => (Vec::new(), base),
            false => (base, Vec::new()),
        };
        for effect in effects {
            let index = first_parameter(effects, *effect);
            for (offset, spec) in effect.description().parameters.iter().enumerate() {
                match spec.scope {
                    Scope::Shared => common.push(index + offset),
                    Scope::PerTightening => own.push(index + offset),
                }
            }
        }
        own.retain(|&index| !first.parameters()[index].fixed);
        common.retain(|&index| !first.parameters()[index].fixed);
        let of_all = match cases.are_of_one_machine() {
            true => cases[0].settings.constraints.as_slice(),
            false => &[],
        };
        let of_first = held_but(first, &common);
        let SharedSizes {
            sizes: shared,
            of: shared_of,
            shares,
            common,
        } = shared_sizes(&cases, effects, sharing, &common);
        let shared_set = match sharing.is_by_group() {
            false => convex_set(&of_first, of_all),
            true => bounds(first, &shared),
        };
        let own_sets = (models.iter().zip(cases.iter()))
            .map(|(model, case)| {
                let of_each = match cases.are_of_one_machine() {
                    true => &[],
                    false => case.settings.constraints.as_slice(),
                };
                convex_set(&held_but(model, &own), of_each)
            })
            .collect();
        Ok(Self {
            scorings: cases.iter().map(FitTask::scoring).collect(),
            cases,
            effects: effects.to_vec(),
            sharing: sharing.among(effects),
            models,
            own,
            common,
            shared,
            shared_of,
            shares,
            own_sets,
            shared_set,
            room: Room::default(),
            reach: 0,
        })
    }

    /// The same model of other tightenings.
    pub fn with_cases<'b>(&self, all: &'b [FitTask<'b>]) -> Result<PooledModel<'b>, DiagnoseError>
    where
        'a: 'b,
    {
        PooledModel::shared_by(self.cases.others(all), &self.effects, &self.sharing)
    }

    /// The sizes that all of these tightenings share with those of `other`, which end there at `from`, put in place of `to`.
    pub fn take_shared(&self, to: &mut [f64], other: &PooledModel<'_>, from: &[f64]) {
        for (size, to) in self.shared.iter().zip(to) {
            let place = other.shared.iter().position(|known| known == size);
            *to = place.map_or(*to, |place| from[place]);
        }
    }

    /// Whether all residuals are in units of a measured noise.
    pub fn is_weighted(&self) -> bool {
        let mut scorings = self.scorings.iter();
        scorings.all(|scoring| scoring.whitening().is_some())
    }

    /// Names of parameters by index.
    pub fn names(&self, indices: &[usize]) -> Vec<String> {
        let parameters = self.models[0].parameters();
        indices
            .iter()
            .map(|&index| parameters[index].name.clone())
            .collect()
    }

    /// What one member has of the shared sizes, in the order of the common parameters.
    pub fn part(&self, member: usize, shared: &[f64]) -> Vec<f64> {
        self.shared_of[member]
            .iter()
            .map(|&place| shared[place])
            .collect()
    }

    /// All parameters of one member's model.
    pub fn values(&self, member: usize, own: &[f64], shared: &[f64]) -> Vec<f64> {
        self.values_of(member, own, &self.part(member, shared))
    }

    /// All parameters of one member's model, given its own and its [part](Self::part) of the shared ones.
    pub(super) fn values_of(&self, member: usize, own: &[f64], part: &[f64]) -> Vec<f64> {
        let parameters = self.models[member].parameters().iter();
        let mut values: Vec<f64> = parameters.map(|parameter| parameter.value).collect();
        let free = self.own.iter().zip(own).chain(self.common.iter().zip(part));
        for (&index, &value) in free {
            values[index] = value;
        }
        if let Some(shares) = &self.shares {
            mix(&mut values, &self.common, part, &shares[member]);
        }
        values
    }

    /// Indices of every member's free parameters: its own, then its part of the shared ones; what stands between two sizes twice.
    pub fn order(&self) -> Vec<usize> {
        [self.own.as_slice(), &self.common].concat()
    }

    /// Fits from one start; [`DiagnoseError::Interrupted`] where whoever follows ended it.
    pub fn fit(
        &mut self,
        start: &Start,
        settings: &PooledSettings,
    ) -> Result<PooledFit, DiagnoseError> {
        let (own_sets, shared_set) = (self.own_sets.clone(), self.shared_set.clone());
        let (follower, tightenings) = (self.cases.follower(), self.cases.len());
        let heard = follower.map(|follower| (follower, self.residuals_and_parameters()));
        let is_whole = self.reach == 0;
        let mut follow = |step: PooledStep| match heard {
            None => ControlFlow::Continue(()),
            Some((follower, (residuals, parameters))) => {
                let error = error_beyond(2.0 * step.cost, residuals, parameters);
                follower.hear(step, tightenings, is_whole.then_some(error))
            }
        };
        let fit = solve_pooled_followed(
            self,
            &start.own,
            &own_sets,
            &start.shared,
            &shared_set,
            settings,
            &mut follow,
        )?;
        self.cases.tally().pooled_fit(&fit.work);
        follower.map_or(Ok(()), Follower::go_on)?;
        Ok(fit)
    }

    /// Fits what is left of the residual once it is averaged over `reach` samples to either side.
    pub fn fit_averaged(
        &mut self,
        start: &Start,
        settings: &PooledSettings,
        reach: usize,
    ) -> Result<PooledFit, DiagnoseError> {
        self.reach = reach;
        let end = self.fit(start, settings);
        self.reach = 0;
        end
    }

    /// Members fitted each by itself with the shared parameters held, from its `own` start: its own parameters and ½‖r‖², or
    /// nothing where it could not be fitted.
    pub fn fit_alone(
        &self,
        members: &[usize],
        own: &[Vec<f64>],
        shared: &[f64],
    ) -> Vec<Option<(Vec<f64>, f64)>> {
        let models: Vec<Model> = (members.iter().zip(own))
            .map(|(&member, own)| self.held(member, own, shared))
            .collect();
        let tasks: Vec<FitTask<'_>> = (members.iter().zip(&models))
            .map(|(&member, model)| self.cases[member].with_model(model))
            .collect();
        let estimates = identify_all(&tasks);
        let mut room = Room::default();
        let ends = estimates
            .into_iter()
            .zip(members)
            .map(|(estimate, &member)| {
                let estimate = estimate.ok()?;
                self.cases.tally().fit_alone(&estimate);
                let found: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
                let (residual, _) = self.weighted(member, &found, &[], &mut room);
                let cost = 0.5 * residual.iter().map(|r| r * r).sum::<f64>();
                Some((self.own.iter().map(|&index| found[index]).collect(), cost))
            });
        ends.collect()
    }

    /// One member's model, everything at these values and what all share held there.
    pub(super) fn held(&self, member: usize, own: &[f64], shared: &[f64]) -> Model {
        let mut model = self.models[member].clone();
        let values = self.values(member, own, shared);
        for (parameter, value) in model.parameters_mut().iter_mut().zip(values) {
            parameter.value = value;
        }
        for &index in &self.common {
            model.parameters_mut()[index].fixed = true;
        }
        model
    }

    /// The compared output of every tightening that is `asked` for.
    pub fn outputs(&self, asked: &[Asked<'_>]) -> Vec<Vec<f64>> {
        let mut simulated = Vec::new();
        simulate(&self.cases, &self.models, asked, &[], &mut simulated);
        simulated.into_iter().map(|one| one.output).collect()
    }

    /// Its derivatives to one parameter.
    pub fn derivatives(&self, asked: &[Asked<'_>], parameter: usize) -> Vec<Vec<f64>> {
        let mut simulated = Vec::new();
        let order = [parameter];
        simulate(&self.cases, &self.models, asked, &order, &mut simulated);
        simulated.into_iter().map(|one| one.sensitivity).collect()
    }

    /// Weighted residual and, for the parameters in `order`, weighted Jacobian (column-major) of one member.
    pub fn weighted<'r>(
        &self,
        member: usize,
        values: &[f64],
        order: &[usize],
        room: &'r mut Room,
    ) -> (&'r mut [f64], &'r mut [f64]) {
        let input = &self.cases[member].input;
        let asked = [Asked {
            member,
            input,
            values,
        }];
        let simulated = &mut room.simulated;
        simulate(&self.cases, &self.models, &asked, &once(order), simulated);
        self.weigh_simulated(member, order, 0, room)
    }

    /// Weighted residual and, for the parameters in `order`, Jacobian of `member`, whose simulation is number `index` of those in
    /// `room`.
    pub(super) fn weigh_simulated<'r>(
        &self,
        member: usize,
        order: &[usize],
        index: usize,
        room: &'r mut Room,
    ) -> (&'r mut [f64], &'r mut [f64]) {
        let case = &self.cases[member];
        let scoring = &self.scorings[member];
        let scored = self.residual_count(member);
        let Room {
            simulated,
            residual,
            jacobian,
        } = room;
        let simulated = &mut simulated[index];
        for (simulated, measured) in simulated.output.iter_mut().zip(case.measured()) {
            *simulated = measured - *simulated;
        }
        residual.resize(scored, 0.0);
        jacobian.resize(scored * order.len(), 0.0);
        scoring.weigh(&simulated.output, residual);
        let samples = simulated.output.len();
        let places = places_in(order);
        for (place, weighted) in places.zip(jacobian.chunks_exact_mut(scored)) {
            let column = &simulated.sensitivity[place * samples..][..samples];
            scoring.weigh(column, weighted);
            for value in weighted {
                *value = -*value;
            }
        }
        if let Some(shares) = &self.shares
            && order.len() == self.own.len() + self.common.len()
        {
            let columns = jacobian.chunks_exact_mut(scored).skip(self.own.len());
            for (column, share) in columns.zip(&shares[member]) {
                column.iter_mut().for_each(|value| *value *= share);
            }
        }
        (residual, jacobian)
    }

    /// Number of weighted residuals of one member.
    pub fn residual_count(&self, member: usize) -> usize {
        self.scorings[member].count()
    }

    /// Whitens a signal of one member's length.
    pub fn weigh_signal(&self, member: usize, signal: &[f64]) -> Vec<f64> {
        let mut weighted = vec![0.0; self.residual_count(member)];
        self.scorings[member].weigh(signal, &mut weighted);
        weighted
    }
}

/// A model of which only these parameters are free, as far as they were.
fn held_but(model: &Model, free: &[usize]) -> Model {
    let mut model = model.clone();
    for (index, parameter) in model.parameters_mut().iter_mut().enumerate() {
        parameter.fixed |= !free.contains(&index);
    }
    model
}

/// The bounds of shared sizes.
fn bounds(model: &Model, shared: &[SharedSize]) -> Constraints {
    let mut set = Constraints::new(shared.len());
    for (column, size) in shared.iter().enumerate() {
        let parameter = &model.parameters()[size.index];
        set.bound(
            column,
            parameter.minimum,
            parameter.maximum,
            &parameter.name,
        );
    }
    set
}
