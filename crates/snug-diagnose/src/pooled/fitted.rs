//! A pooled model after its fit: sizes, errors, and what it is worth in data that took no part.

use crate::data::clusters::Clusters;
use crate::data::power::power;
use crate::pooled::error_beyond::error_beyond;
use crate::pooled::model::{PooledModel, Room, Start};
use crate::pooled::parameter_place::{effect_of, first_parameter, index_among};
use crate::pooled::sharing::{SharedSize, Sharing, differs_by_group};
use crate::pooled::thresholds::{AT_FLOOR, HARDLY, NOISE_AND_A_LITTLE, ROUNDING};
use crate::pooled::torque_noise::passed_on;
use crate::settings::DiagnoseSettings;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_least_squares::{PooledFit, Profile};
use snug_model::{BASE_PARAMETERS, Effect};
use snug_statistics::descriptive::median;

/// What a cluster says about the parameters around the optimum: squared residual, gradient and curvature.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    /// Σ r² over the cluster.
    pub squares: f64,
    /// Number of residuals.
    pub count: usize,
    /// Jᵀr; over the tightening's shared parameters where the cluster is a whole one, else over own and shared.
    pub(super) gradient: Vec<f64>,
    /// JᵀJ likewise.
    pub(super) curvature: SymmetricMatrix,
}

/// A fitted pooled model.
#[derive(Debug, Clone)]
pub(crate) struct Fitted {
    pub effects: Vec<Effect>,
    /// Which of their sizes differ from group to group.
    pub sharing: Sharing,
    own_names: Vec<String>,
    shared_names: Vec<String>,
    /// Which of the model's parameters these are.
    own_indices: Vec<usize>,
    pub(super) shared_sizes: Vec<SharedSize>,
    /// Which of the shared sizes are each tightening's.
    pub(super) shared_of: Vec<Vec<usize>>,
    /// How much of each; `None` where all count whole.
    pub(super) shares: Option<Vec<Vec<f64>>>,
    pub own: Vec<Vec<f64>>,
    pub shared: Vec<f64>,
    pub converged: bool,
    /// Cluster by cluster, tightening by tightening.
    pub blocks: Vec<Block>,
    /// Which tightening a cluster belongs to.
    pub members: Vec<usize>,
    /// Σ r² of each cluster that the noise of the logged torque alone makes.
    pub(super) torque_noise: Vec<f64>,
    pub(super) clusters: Clusters,
    /// Whether residuals are in units of a measured noise.
    pub is_weighted: bool,
    /// Whether it leaves less than an instrument could see, so that only rounding is left.
    pub is_exact: bool,
    /// Per tightening curvature over own and shared (only where clusters are stretches).
    pub(super) member_curvature: Vec<SymmetricMatrix>,
    /// Per tightening projected curvature and gradient over its shared parameters.
    pub(super) profiles: Vec<(SymmetricMatrix, Vec<f64>)>,
    /// Parameters that every tightening has of its own, beyond the base model's.
    pub own_effect_count: usize,
}

impl Fitted {
    /// A fit with what follows from it.
    pub fn new(pooled: &PooledModel<'_>, fit: PooledFit, clusters: &Clusters) -> Self {
        let of_shared = |profile: &Profile| {
            let curvature = SymmetricMatrix::new(profile.shared.len(), profile.curvature.clone());
            (curvature, profile.gradient.clone())
        };
        let profiles = fit.profiles.iter().map(of_shared).collect();
        let indices: Vec<usize> = pooled.shared.iter().map(|size| size.index).collect();
        let mut fitted = Self {
            effects: pooled.effects.clone(),
            sharing: pooled.sharing.clone(),
            own_names: pooled.names(&pooled.own),
            shared_names: pooled.names(&indices),
            own_indices: pooled.own.clone(),
            shared_sizes: pooled.shared.clone(),
            shared_of: pooled.shared_of.clone(),
            shares: pooled.shares.clone(),
            converged: fit.converged,
            blocks: Vec::new(),
            members: Vec::new(),
            torque_noise: Vec::new(),
            clusters: *clusters,
            is_weighted: pooled.is_weighted(),
            is_exact: false,
            member_curvature: Vec::new(),
            profiles,
            own_effect_count: pooled
                .own
                .iter()
                .filter(|&&index| index >= BASE_PARAMETERS.len())
                .count(),
            own: fit.own,
            shared: fit.shared,
        };
        fitted.work_out_blocks(pooled, &fit.profiles);
        fitted.is_exact = !fitted.is_weighted && fitted.squares() < ROUNDING * power(&pooled.cases);
        fitted
    }

    /// How many more numbers its effects have where each of a few long recordings has some of its own than where all share one; 0 of
    /// whole tightenings, each of which shows its own.
    pub fn more_for_each_recording(&self) -> usize {
        match self.clusters.are_whole() {
            true => 0,
            false => self.own_effect_count * self.own.len().saturating_sub(1),
        }
    }

    /// Where this fit ended as a start for `pooled`, which may hold other effects; those begin as usual.
    pub fn start(&self, pooled: &PooledModel<'_>) -> Start {
        let all: Vec<usize> = (0..self.own.len()).collect();
        self.start_of(pooled, &all)
    }

    /// The same for a model of these of the tightenings.
    pub fn start_of(&self, pooled: &PooledModel<'_>, members: &[usize]) -> Start {
        let mut start = pooled.usual_start();
        let index = |place: usize| index_among(&self.effects, &pooled.effects, place);
        let of_all = |index: usize| self.shared_value(index, &SharedSize { index, level: None });
        for (column, &place) in pooled.own.iter().enumerate() {
            let Some(index) = index(place) else { continue };
            let known = self.own_indices.iter().position(|&known| known == index);
            for (to, &member) in start.own.iter_mut().zip(members) {
                let ended = match known {
                    Some(known) => Some(self.own[member][known]),
                    None => of_all(index),
                };
                to[column] = ended.unwrap_or(to[column]);
            }
        }
        for (size, to) in pooled.shared.iter().zip(&mut start.shared) {
            if let Some(value) = index(size.index).and_then(|index| self.shared_value(index, size))
            {
                *to = value;
            }
        }
        start
    }

    /// What it says of the shared parameter number `index`: of that group, of all, or the mean over its groups.
    pub fn shared_value(&self, index: usize, of: &SharedSize) -> Option<f64> {
        let known = || {
            let all = self.shared_sizes.iter().zip(&self.shared);
            all.filter(move |(known, _)| known.index == index)
        };
        if let Some((_, value)) = known().find(|(known, _)| known.level == of.level) {
            return Some(*value);
        }
        let values: Vec<f64> = known().map(|(_, value)| *value).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }

    fn work_out_blocks(&mut self, pooled: &PooledModel<'_>, profiles: &[Profile]) {
        let order: Vec<usize> = match self.clusters.are_whole() {
            true => Vec::new(),
            false => pooled.order(),
        };
        let mut room = Room::default();
        let values: Vec<Vec<f64>> = (self.own.iter().enumerate())
            .map(|(member, own)| pooled.values(member, own, &self.shared))
            .collect();
        self.torque_noise = passed_on(pooled, &values, &self.clusters);
        for (member, profile) in profiles.iter().enumerate() {
            let values = &values[member];
            if self.clusters.are_whole() {
                let (curvature, gradient) = self.profiles[member].clone();
                self.blocks.push(Block {
                    squares: 2.0 * profile.cost,
                    count: pooled.residual_count(member),
                    gradient,
                    curvature,
                });
                self.members.push(member);
                continue;
            }
            let (residual, jacobian) = pooled.weighted(member, values, &order, &mut room);
            let count = residual.len();
            let mut whole = SymmetricMatrix::zero(order.len());
            for range in self.clusters.ranges(count) {
                let r = &residual[range.clone()];
                let column = |index: usize| &jacobian[index * count..][range.clone()];
                let mut curvature = SymmetricMatrix::zero(order.len());
                for i in 0..order.len() {
                    for j in 0..order.len() {
                        curvature.set(i, j, dot(column(i), column(j)));
                    }
                }
                whole.add(&curvature);
                self.blocks.push(Block {
                    squares: dot(r, r),
                    count: r.len(),
                    gradient: (0..order.len()).map(|i| dot(column(i), r)).collect(),
                    curvature,
                });
                self.members.push(member);
            }
            self.member_curvature.push(whole);
        }
    }

    /// At most `most` tightenings that differ in how badly they fit, the worst among them.
    pub fn spread(&self, most: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.own.len()).collect();
        let squares = |member: usize| -> f64 {
            let clusters = self.members.iter().zip(&self.blocks);
            clusters
                .filter(|(m, _)| **m == member)
                .map(|(_, b)| b.squares)
                .sum()
        };
        order.sort_by(|&a, &b| squares(b).total_cmp(&squares(a)));
        let step = order.len().div_ceil(most).max(1);
        order.into_iter().step_by(step).collect()
    }

    /// Σ r² over everything.
    pub fn squares(&self) -> f64 {
        self.blocks.iter().map(|block| block.squares).sum()
    }

    /// Mean squared weighted residual: 1 where only noise is left.
    pub fn scale(&self) -> f64 {
        self.squares() / self.count().max(1) as f64
    }

    /// Number of residuals.
    pub fn count(&self) -> usize {
        self.blocks.iter().map(|block| block.count).sum()
    }

    /// Root mean square of the weighted residual, parameters of each tightening accounted for.
    pub fn error(&self) -> f64 {
        let parameters = self.own.len() * self.own_names.len() + self.shared.len();
        error_beyond(self.squares(), self.count(), parameters)
    }

    /// Whether what it leaves is the noise, or rounding.
    pub fn is_at_floor(&self) -> bool {
        self.is_exact || (self.is_weighted && self.error() < AT_FLOOR)
    }

    /// Whether it leaves no more than the noise, the torque's as well, and a little.
    pub fn is_noise(&self) -> bool {
        let of_torque: f64 = self.torque_noise.iter().sum();
        let beyond = (self.squares() - of_torque) / self.count().max(1) as f64;
        self.is_weighted && beyond < NOISE_AND_A_LITTLE
    }

    /// Smallest share of the squared residual that an effect must remove to matter beside this model.
    pub fn smallest_gain(&self, settings: &DiagnoseSettings) -> f64 {
        match self.is_at_floor() {
            true => settings.smallest_gain_at_noise,
            false => settings.smallest_gain,
        }
    }

    /// Whether it leaves more than the noise, as far as that is known.
    pub fn is_beyond_noise(&self) -> bool {
        self.is_weighted && !self.is_at_floor()
    }

    pub fn own_named(&self, member: usize) -> Vec<(String, f64)> {
        self.own_names
            .iter()
            .cloned()
            .zip(self.own[member].iter().copied())
            .collect()
    }

    /// What one tightening has of its own and shares.
    pub fn all_named(&self, member: usize) -> Vec<(String, f64)> {
        let name = |index: usize| {
            let place = self.shared_sizes.iter().position(|one| one.index == index);
            place.map_or_else(String::new, |place| self.shared_names[place].clone())
        };
        let shared = self.parts(member, None).into_iter();
        let shared = shared.map(|part| (name(part.index), part.value));
        self.own_named(member).into_iter().chain(shared).collect()
    }

    pub fn shared_named(&self) -> Vec<(String, f64)> {
        self.shared_names
            .iter()
            .cloned()
            .zip(self.shared.iter().copied())
            .collect()
    }

    /// How many parameters of the base model have hardly anything left to do beside this fit's effects, where beside those
    /// of one of `others` they have.
    pub fn makes_superfluous(&self, others: &[&Self]) -> usize {
        let others: Vec<Vec<f64>> = others.iter().map(|other| other.base_sizes()).collect();
        let is_superfluous = |(column, size): &(usize, f64)| {
            let sizes = others.iter().map(|other| other[*column]);
            *size < HARDLY * sizes.fold(0.0, f64::max)
        };
        let sizes = self.base_sizes().into_iter().enumerate();
        sizes.filter(is_superfluous).count()
    }

    /// Size of each free parameter of the base model: the median over tightenings, or what all share.
    fn base_sizes(&self) -> Vec<f64> {
        let of = |column: usize| {
            let sizes: Vec<f64> = self.own.iter().map(|own| own[column].abs()).collect();
            median(&sizes).unwrap_or(0.0)
        };
        let shared = self.shared_base().map(|(_, value)| value.abs());
        (0..self.free_base_count()).map(of).chain(shared).collect()
    }

    /// Names and values of what all share of the base model.
    fn shared_base(&self) -> impl Iterator<Item = (&String, f64)> {
        let shared = self.shared_names.iter().zip(&self.shared);
        (shared.zip(&self.shared_sizes))
            .filter(|(_, size)| size.index < BASE_PARAMETERS.len())
            .map(|((name, value), _)| (name, *value))
    }

    /// How many of each tightening's own parameters, the first of them, are the base model's.
    fn free_base_count(&self) -> usize {
        self.own_names.len() - self.own_effect_count
    }

    /// What one tightening has of its own of mass, damping and stiffness, as far as they are free; nothing where all share them.
    pub fn own_base(&self, member: usize) -> &[f64] {
        &self.own[member][..self.free_base_count()]
    }

    /// Free parameters of the base model, the mean over records; none where there are many tightenings.
    pub fn base(&self) -> Vec<(String, f64)> {
        if self.clusters.are_whole() {
            return Vec::new();
        }
        let count = self.own.len() as f64;
        let mean = |column: usize| self.own.iter().map(|own| own[column]).sum::<f64>() / count;
        let names = self.own_names[..self.free_base_count()].iter().enumerate();
        names
            .map(|(column, name)| (name.clone(), mean(column)))
            .chain(
                self.shared_base()
                    .map(|(name, value)| (name.clone(), value)),
            )
            .collect()
    }

    /// The first number of one of its effects, which is what its other numbers shape; 0 where it is held or each
    /// tightening has its own.
    pub fn size(&self, effect: Effect) -> f64 {
        let index = first_parameter(&self.effects, effect);
        let all = SharedSize { index, level: None };
        self.shared_value(index, &all).unwrap_or(0.0)
    }

    /// Where the sizes of `effect` stand that could differ from group to group and that all share.
    pub fn places_that_may_differ(&self, effect: Effect) -> Vec<usize> {
        let may = |size: &SharedSize| {
            let of = effect_of(&self.effects, size.index);
            size.level.is_none()
                && of.is_some_and(|(of, offset)| of == effect && differs_by_group(of, offset))
        };
        (0..self.shared_sizes.len())
            .filter(|&place| may(&self.shared_sizes[place]))
            .collect()
    }

    /// Curvature and gradient over the shared sizes at `places` that these whole tightenings add up to; `None` where one of them
    /// does not have them.
    pub fn of_sizes(
        &self,
        members: &[usize],
        places: &[usize],
    ) -> Option<(SymmetricMatrix, Vec<f64>)> {
        let mut curvature = SymmetricMatrix::zero(places.len());
        let mut gradient = vec![0.0; places.len()];
        for &member in members {
            let own = &self.shared_of[member];
            let at: Option<Vec<usize>> = (places.iter())
                .map(|place| own.iter().position(|known| known == place))
                .collect();
            let at = at?;
            let (of_one, g) = &self.profiles[member];
            for (i, &row) in at.iter().enumerate() {
                gradient[i] += g[row];
                for (j, &column) in at.iter().enumerate() {
                    curvature.set(i, j, curvature.at(i, j) + of_one.at(row, column));
                }
            }
        }
        Some((curvature, gradient))
    }

    /// Gradient and curvature of one whole tightening over number `at` of its shared sizes, all others where they are.
    pub fn of_one_size(&self, member: usize, at: usize) -> (f64, f64) {
        let (curvature, gradient) = &self.profiles[member];
        (gradient[at], curvature.at(at, at))
    }

    /// Gradient and curvature of one whole tightening over one of the model's parameters that it shares, all others where they are;
    /// `None` where it knows nothing of it.
    pub fn of_parameter(&self, member: usize, index: usize) -> Option<(f64, f64)> {
        let share = |at: usize| self.shares.as_ref().map_or(1.0, |all| all[member][at]);
        let own = self.shared_of(member).iter().enumerate();
        let of_it = own.filter(|(_, place)| self.shared_sizes()[**place].index == index);
        let (at, share) =
            (of_it.map(|(at, _)| (at, share(at)))).max_by(|a, b| a.1.total_cmp(&b.1))?;
        let (gradient, curvature) = self.of_one_size(member, at);
        (curvature > 0.0).then(|| (gradient / share, curvature / (share * share)))
    }

    /// What is shared, and by which tightenings.
    pub fn shared_sizes(&self) -> &[SharedSize] {
        &self.shared_sizes
    }

    /// Which of it one tightening has.
    pub fn shared_of(&self, member: usize) -> &[usize] {
        &self.shared_of[member]
    }

    /// Which of the model's parameters each tightening has of its own, in their order.
    pub fn own_indices(&self) -> &[usize] {
        &self.own_indices
    }

    /// Projected curvature over the shared parameters, all tightenings together.
    pub fn shared_curvature(&self) -> SymmetricMatrix {
        let mut sum = SymmetricMatrix::zero(self.shared.len());
        for ((curvature, _), places) in self.profiles.iter().zip(&self.shared_of) {
            add_in(&mut sum, curvature, places);
        }
        sum
    }

    /// What one tightening says of the shared parameters, as a vector over all of them.
    pub fn of_all_shared(&self, member: usize, gradient: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.shared.len()];
        for (&place, value) in self.shared_of[member].iter().zip(gradient) {
            all[place] = *value;
        }
        all
    }

    /// Whether clusters are stretches of a few long records.
    pub fn are_stretches(&self) -> bool {
        !self.clusters.are_whole()
    }

    /// Whether no tightening has anything of its own, so that stretches speak of the shared parameters alone.
    pub fn shares_all(&self) -> bool {
        self.own_indices.is_empty()
    }
}

/// Adds a matrix over `places` to one over all.
pub(super) fn add_in(sum: &mut SymmetricMatrix, part: &SymmetricMatrix, places: &[usize]) {
    for (i, &row) in places.iter().enumerate() {
        for (j, &column) in places.iter().enumerate() {
            sum.set(row, column, sum.at(row, column) + part.at(i, j));
        }
    }
}

pub(super) mod evidence;
mod left;
#[cfg(test)]
mod made_up;
#[cfg(test)]
mod tests;
