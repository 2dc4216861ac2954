//! Score before refit: how much of the residual points where an effect would push the simulation.
//!
//! With J_i the sensitivities of the fitted model, z_ij the effect's signature and everything weighted,
//! z̃ = z − J (JᵀJ)⁻¹ Jᵀ z, s_ij = z̃ᵀ r_i, I_ij = z̃ᵀ z̃; predicted size Σ s / Σ I.

use crate::data::clusters::Clusters;
use crate::data::simulation::Asked;
use crate::data::thresholds::{FEW_COLUMNS, SIMULATED_TOGETHER};
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::{PooledModel, Room};
use crate::ranking::nuisance::{Nuisance, coordinates};
use crate::ranking::pairs::gram;
use crate::ranking::sensitivity::{Column, directions};
use crate::ranking::thresholds::{INSTANT_REACH, NOISE_REACH};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_identify::smooth;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::{Effect, Input};

/// The fitted model against which effects are scored.
pub(crate) struct Scorer<'a, 'h> {
    pooled: &'h PooledModel<'a>,
    fitted: &'h Fitted,
    clusters: Clusters,
    /// Campaigns of nothing but noise that are scored beside the measured one.
    control: Control,
    /// Of every residual of each tightening whether it counts; `None` where all do.
    counted: Option<&'h [Vec<bool>]>,
}

/// How many campaigns of nothing but noise are drawn, and from which seed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Control {
    pub campaigns: usize,
    pub seed: u64,
}

/// Columns of the measured campaign, and what campaigns that hold nothing but noise are made of.
pub(crate) struct Scored {
    pub columns: Vec<Column>,
    /// Inner products of the columns' signatures; only of a few long records.
    pub gram: Option<SymmetricMatrix>,
    /// Tightening by tightening, campaign by campaign: s of each column, then the gradient over the shared parameters.
    draws: Vec<Vec<Vec<f64>>>,
}

/// What one tightening adds to every column.
#[derive(Default)]
struct Contribution {
    /// Column by column: s of each cluster.
    scores: Vec<Vec<f64>>,
    variances: Vec<Vec<f64>>,
    /// The three of those residuals that count; none where no part is told apart.
    counted: Vec<(Vec<f64>, Vec<f64>, f64)>,
    information: Vec<f64>,
    cross: Vec<Vec<f64>>,
    gram: Option<SymmetricMatrix>,
    /// Campaign by campaign: s of each column, then the gradient over the shared parameters.
    control: Vec<Vec<f64>>,
}

impl<'a, 'h> Scorer<'a, 'h> {
    pub fn new(
        pooled: &'h PooledModel<'a>,
        fitted: &'h Fitted,
        clusters: Clusters,
        control: Control,
    ) -> Self {
        let campaigns = if clusters.are_whole() && fitted.is_weighted {
            control.campaigns
        } else {
            0
        };
        Self {
            pooled,
            fitted,
            clusters,
            control: Control {
                campaigns,
                ..control
            },
            counted: None,
        }
    }

    /// The same, told apart what some residuals of each tightening say. What the model's own parameters can imitate is taken out over the
    /// whole window all the same, and what all share tightening by tightening, too.
    pub fn counting(self, counted: &'h [Vec<bool>]) -> Self {
        Self {
            counted: Some(counted),
            ..self
        }
    }

    /// All columns of `effects`.
    pub fn score(&self, effects: &[Effect]) -> Result<Scored, DiagnoseError> {
        let whole = self.clusters.are_whole();
        let model = &self.pooled.cases[0].model;
        let mut columns: Vec<Column> = effects
            .iter()
            .flat_map(|&effect| directions(effect, &model.ranges(effect), whole))
            .collect();
        let mut others = Vec::new();
        for &effect in effects {
            let mut with = self.fitted.effects.clone();
            with.push(effect);
            others.push((effect, PooledModel::new(self.pooled.cases, &with)?));
        }
        let members: Vec<usize> = (0..self.pooled.cases.len()).collect();
        let group = |some: &[usize]| self.contributions(some, &columns, &others);
        let groups = members.chunks(SIMULATED_TOGETHER);
        let contributions: Vec<Contribution> = match columns.len() <= FEW_COLUMNS {
            true => (groups.collect::<Vec<_>>().into_par_iter())
                .flat_map_iter(group)
                .collect(),
            false => groups.flat_map(group).collect(),
        };
        let mut grams = contributions.iter().filter_map(|one| one.gram.as_ref());
        let gram = grams.next().map(|first| {
            let mut sum = first.clone();
            grams.for_each(|more| sum.add(more));
            sum
        });
        for contribution in &contributions {
            for (index, column) in columns.iter_mut().enumerate() {
                column.scores.extend(&contribution.scores[index]);
                column.variances.extend(&contribution.variances[index]);
                column.information += contribution.information[index];
                if let Some((scores, variances, information)) = contribution.counted.get(index) {
                    column.counted.scores.extend(scores);
                    column.counted.variances.extend(variances);
                    column.counted.information += information;
                }
                let cross = &contribution.cross[index];
                column.cross.resize(cross.len(), 0.0);
                for (sum, more) in column.cross.iter_mut().zip(cross) {
                    *sum += more;
                }
            }
        }
        let (_, gradients) = self.fitted.shared_evidence();
        let gradients: Vec<&[f64]> = gradients.iter().map(Vec::as_slice).collect();
        let gram = gram.map(|gram| self.beside_shared(&columns, gram));
        self.project_shared(&mut columns, &gradients);
        let draws = contributions.into_iter().map(|of_one| of_one.control);
        Ok(Scored {
            columns,
            gram,
            draws: draws.collect(),
        })
    }

    /// By how much the shared parameters of the model follow so many times one of a column's signature; nothing where they are taken
    /// out tightening by tightening.
    pub fn shared_that_follow(&self, column: &Column) -> Option<Vec<f64>> {
        let is_taken_out = !self.fitted.shared.is_empty() && self.is_joint();
        let curvature = || self.fitted.shared_curvature();
        is_taken_out.then(|| curvature().solve_scaled(&column.cross))?
    }

    /// How many campaigns of nothing but noise there are.
    pub fn control_campaigns(&self) -> usize {
        self.control.campaigns
    }

    /// The columns of one of them.
    pub fn of_noise(&self, scored: &Scored, campaign: usize) -> Vec<Column> {
        let draws = || scored.draws.iter().map(|of_one| &of_one[campaign]);
        let mut columns = scored.columns.clone();
        for (index, column) in columns.iter_mut().enumerate() {
            column.scores = draws().map(|draw| draw[index]).collect();
        }
        let gradients: Vec<&[f64]> = draws().map(|draw| &draw[columns.len()..]).collect();
        self.project_shared(&mut columns, &gradients);
        columns
    }

    /// What some tightenings, simulated side by side, add.
    fn contributions(
        &self,
        members: &[usize],
        columns: &[Column],
        others: &[(Effect, PooledModel<'_>)],
    ) -> Vec<Contribution> {
        let pooled = self.pooled;
        // What an effect does is worked out from a torque without the noise that the residual has from it: a delay or a
        // lag would otherwise be seen to remove that noise.
        let smoothed: Vec<(Input, Vec<f64>)> = (members.iter())
            .map(|&member| {
                let input = pooled.cases[member].input.smoothed(NOISE_REACH);
                (input, self.values(member))
            })
            .collect();
        let asked: Vec<Asked<'_>> = (members.iter().zip(&smoothed))
            .map(|(&member, (input, values))| Asked {
                member,
                input,
                values,
            })
            .collect();
        let plain = pooled.outputs(&asked);
        let of_columns: Vec<Vec<Vec<f64>>> = (columns.par_iter())
            .map(|column| {
                let other = others.iter().find(|(effect, _)| *effect == column.effect);
                let mut signatures = other.map_or_else(
                    || plain.iter().map(|plain| vec![0.0; plain.len()]).collect(),
                    |(_, other)| column.signatures(other, &asked, &plain),
                );
                for signature in &mut signatures {
                    smooth(signature, INSTANT_REACH);
                }
                signatures
            })
            .collect();
        (members.par_iter().enumerate())
            .map(|(index, &member)| {
                let own: Vec<&[f64]> = of_columns.iter().map(|of| of[index].as_slice()).collect();
                self.contribution(member, &own)
            })
            .collect()
    }

    /// Whether what all share is taken out over all tightenings together.
    pub fn is_joint(&self) -> bool {
        let is_one_statement =
            self.clusters.are_whole() || self.fitted.shares_all() && self.pooled.cases.len() > 1;
        self.counted.is_none() && is_one_statement
    }

    /// All parameters of one tightening's model as fitted.
    fn values(&self, member: usize) -> Vec<f64> {
        let fitted = self.fitted;
        self.pooled
            .values(member, &fitted.own[member], &fitted.shared)
    }

    /// What one tightening adds, given every column's signature in it.
    fn contribution(&self, member: usize, of_columns: &[&[f64]]) -> Contribution {
        let pooled = self.pooled;
        // Stretches of one tightening share everything with each other.
        let own_count = match self.is_joint() {
            true => pooled.own.len(),
            false => pooled.own.len() + pooled.common.len(),
        };
        let order = pooled.order();
        let values = self.values(member);
        let mut room = Room::default();
        let (residual, jacobian) = pooled.weighted(member, &values, &order, &mut room);
        let count = residual.len();
        let nuisance = Nuisance::new(jacobian, count, own_count);
        // Sensitivities to the shared parameters, as far as the own ones cannot imitate them.
        let (_, shared) = jacobian.split_at_mut(own_count * count);
        for column in shared.chunks_exact_mut(count) {
            nuisance.project(column);
        }
        let bias = self.bias_signature(member, &nuisance);
        let mut contribution = Contribution::default();
        let mut signatures: Vec<Vec<f64>> = Vec::new();
        let mut along_bias = Vec::new();
        for signature in of_columns {
            let mut z = pooled.weigh_signal(member, signature);
            nuisance.project(&mut z);
            let (scores, variances, information) = self.of_clusters(&z, residual, bias.as_deref());
            // The Jacobian is that of the residual: minus the output's.
            let cross: Vec<f64> = shared
                .chunks_exact(count)
                .map(|shared| -dot(shared, &z))
                .collect();
            contribution.cross.push(self.of_all_shared(member, cross));
            contribution.scores.push(scores);
            contribution.variances.push(variances);
            contribution.information.push(information);
            if let Some(counted) = self.counted {
                let z = only(&z, &counted[member]);
                let there = self.of_clusters(&z, residual, bias.as_deref());
                contribution.counted.push(there);
            }
            if self.control.campaigns > 0 {
                along_bias.push(bias.as_ref().map_or(0.0, |bias| dot(&z, bias)));
            }
            if self.control.campaigns > 0 || !self.clusters.are_whole() {
                signatures.push(z);
            }
        }
        if !self.clusters.are_whole() {
            contribution.gram = Some(gram(&signatures));
        }
        if self.control.campaigns > 0 {
            for column in shared.chunks_exact(count) {
                along_bias.push(bias.as_ref().map_or(0.0, |bias| dot(column, bias)));
                signatures.push(column.to_vec());
            }
            let mut draws = self.draw(member, &signatures, &along_bias);
            for draw in &mut draws {
                let gradient = draw.split_off(of_columns.len());
                draw.extend(self.of_all_shared(member, gradient));
            }
            contribution.control = draws;
        }
        contribution
    }

    /// s and its variance of each cluster, and Σ I, of one signature as far as nothing imitates it.
    fn of_clusters(
        &self,
        z: &[f64],
        residual: &[f64],
        bias: Option<&[f64]>,
    ) -> (Vec<f64>, Vec<f64>, f64) {
        let (mut scores, mut variances, mut information) = (Vec::new(), Vec::new(), 0.0);
        for range in self.clusters.ranges(z.len()) {
            let (z, r) = (&z[range.clone()], &residual[range.clone()]);
            let along = bias.map_or(0.0, |bias| dot(z, &bias[range]));
            let squares = dot(z, z);
            scores.push(dot(z, r));
            variances.push(squares + along * along);
            information += squares;
        }
        (scores, variances, information)
    }

    /// What one tightening says of its shared parameters, told of all of them where they are taken out together.
    fn of_all_shared(&self, member: usize, part: Vec<f64>) -> Vec<f64> {
        match self.is_joint() {
            true => self.fitted.of_all_shared(member, &part),
            false => part,
        }
    }

    /// Scores of campaigns that hold nothing but noise: white noise, seen through what the signatures span.
    fn draw(&self, member: usize, signatures: &[Vec<f64>], along_bias: &[f64]) -> Vec<Vec<f64>> {
        let coordinates = coordinates(signatures);
        let mut random = ChaCha8Rng::seed_from_u64(self.control.seed);
        // Stream 0 flips signs.
        random.set_stream(1 + member as u64);
        (0..self.control.campaigns)
            .map(|_| {
                let noise: Vec<f64> = (0..coordinates.len())
                    .map(|_| StandardNormal.sample(&mut random))
                    .collect();
                let bias: f64 = StandardNormal.sample(&mut random);
                (coordinates.iter().zip(along_bias))
                    .map(|(own, along)| dot(own, &noise[..own.len()]) + bias * along)
                    .collect()
            })
            .collect()
    }

    /// What one standard error of the bias taken out in the quiet part does to the weighted output.
    fn bias_signature(&self, member: usize, nuisance: &Nuisance) -> Option<Vec<f64>> {
        let case = &self.pooled.cases[member];
        let bias = case.tightening.correction_of(Quantity::Acceleration)?;
        if case.quantity() != Quantity::Acceleration || bias.standard_error <= 0.0 {
            return None;
        }
        let constant = vec![bias.standard_error; case.measured().len()];
        let mut weighted = self.pooled.weigh_signal(member, &constant);
        nuisance.project(&mut weighted);
        Some(weighted)
    }

    /// The inner products that are left once the shared parameters follow.
    fn beside_shared(&self, columns: &[Column], mut gram: SymmetricMatrix) -> SymmetricMatrix {
        if self.fitted.shared.is_empty() || !self.is_joint() {
            return gram;
        }
        let curvature = self.fitted.shared_curvature();
        for (i, column) in columns.iter().enumerate() {
            let Some(b) = curvature.solve_scaled(&column.cross) else {
                continue;
            };
            for (j, other) in columns.iter().enumerate().take(i + 1) {
                gram.set(i, j, gram.at(i, j) - dot(&b, &other.cross));
            }
        }
        gram
    }

    /// Takes out of every column what the shared parameters of the model can imitate over all tightenings together.
    fn project_shared(&self, columns: &mut [Column], gradients: &[&[f64]]) {
        if !self.fitted.shared.is_empty() && self.is_joint() {
            let curvature = self.fitted.shared_curvature();
            for column in columns.iter_mut() {
                let Some(b) = curvature.solve_scaled(&column.cross) else {
                    continue;
                };
                column.information -= dot(&b, &column.cross);
                for (score, gradient) in column.scores.iter_mut().zip(gradients) {
                    *score += dot(&b, gradient);
                }
            }
        }
        columns.iter_mut().for_each(Column::bound);
    }
}

/// A signature of which nothing is left but where it counts.
fn only(signature: &[f64], counted: &[bool]) -> Vec<f64> {
    let pairs = signature.iter().zip(counted);
    pairs
        .map(|(z, counts)| if *counts { *z } else { 0.0 })
        .collect()
}

#[cfg(test)]
mod tests;
