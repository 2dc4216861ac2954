//! Score before refit: how much of the residual points where an effect would push the simulation.
//!
//! With J_i the sensitivities of the fitted model, z_ij the effect's signature and everything weighted,
//! z̃ = z − J (JᵀJ)⁻¹ Jᵀ z, s_ij = z̃ᵀ r_i, I_ij = z̃ᵀ z̃; predicted size Σ s / Σ I.

use crate::DiagnoseError;
use crate::dense::dot;
use crate::fitted::Fitted;
use crate::hypothesis::{Hypothesis, Room};
use crate::nuisance::{Nuisance, coordinates};
use crate::simulated::Asked;
use crate::units::Units;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use snug_model::{Effect, Input, Law, PlausibleRange, Scope};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// One direction in which an effect could push: the derivative to a parameter, or one of its starts against none.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    pub effect: Effect,
    /// Which of the effect's parameters is differentiated by; `None` for a start against none.
    along: Option<usize>,
    /// Values of the effect's own parameters to begin a refit with.
    pub start: Vec<f64>,
    /// Largest plausible size of each of the effect's own parameters.
    pub largest: Vec<f64>,
    /// The physics knows only one sign.
    one_sided: bool,
    /// Every tightening has its own size.
    own: bool,
    /// s of each unit.
    pub scores: Vec<f64>,
    /// s over its noise, bounded: z / √(1 + (z/2)²).
    bounded: Vec<f64>,
    /// Variance of s of each unit under noise alone.
    variances: Vec<f64>,
    /// Σ I.
    pub information: f64,
    cross: Vec<f64>,
}

/// The fitted model against which effects are scored.
pub(crate) struct Scorer<'a, 'h> {
    hypothesis: &'h Hypothesis<'a>,
    fitted: &'h Fitted,
    units: Units,
    /// Campaigns of nothing but noise that are scored beside the measured one.
    control: Control,
}

/// Samples on either side over which the torque is averaged for the signatures.
const NOISE_REACH: usize = 5;

/// Tightenings that are simulated side by side, which bounds the memory.
const TOGETHER: usize = 8;

/// How many campaigns of nothing but noise are drawn, and from which seed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Control {
    pub campaigns: usize,
    pub seed: u64,
}

/// Columns of the measured campaign and of campaigns that hold nothing but noise.
pub(crate) struct Scored {
    pub columns: Vec<Column>,
    pub control: Vec<Vec<Column>>,
}

/// What one tightening adds to every column.
struct Contribution {
    /// Column by column: s of each unit.
    scores: Vec<Vec<f64>>,
    variances: Vec<Vec<f64>>,
    information: Vec<f64>,
    cross: Vec<Vec<f64>>,
    /// Campaign by campaign: s of each column, then the gradient over the shared parameters.
    control: Vec<Vec<f64>>,
}

impl Column {
    /// T = Σ u / √Σ u² over units, the larger of two: u = s, and u = s in units of its noise, bounded, so that a few
    /// loud tightenings do not drown what all agree on. What is against a one-sided effect's sign counts as nothing.
    pub fn statistic(&self) -> f64 {
        self.flipped_statistic(&vec![1.0; self.scores.len()])
    }

    /// The same with the signs of whole units flipped.
    pub fn flipped_statistic(&self, signs: &[f64]) -> f64 {
        let ratio = |u: &[f64]| {
            let length = dot(u, u).sqrt();
            if length > 0.0 {
                self.sided(dot(signs, u)) / length
            } else {
                0.0
            }
        };
        ratio(&self.scores).max(ratio(&self.bounded))
    }

    /// A column with these scores, for tests of what is made of them.
    #[cfg(test)]
    pub fn with_scores(effect: Effect, scores: Vec<f64>) -> Self {
        let hand = |spec| {
            snug_model::Scale::HandOnTool.range(
                spec,
                &snug_campaign::Rig {
                    lever_arm_m: 0.33,
                    known_inertia_kg_m2: 0.15,
                },
            )
        };
        let ranges: Vec<_> = effect.description().parameters.iter().map(hand).collect();
        let mut column = directions(effect, &ranges, true).swap_remove(0);
        column.variances = vec![1.0; scores.len()];
        column.scores = scores;
        column.bound();
        column
    }

    /// How the effect pushes the outputs of some tightenings, the model's own parameters as they are; `plain` are the
    /// outputs without it.
    fn signatures(
        &self,
        with: &Hypothesis<'_>,
        without: &[Asked<'_>],
        plain: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let values: Vec<Vec<f64>> = (without.iter())
            .map(|asked| [asked.values, &self.start].concat())
            .collect();
        let asked: Vec<Asked<'_>> = (without.iter().zip(&values))
            .map(|(asked, values)| Asked { values, ..*asked })
            .collect();
        if let Some(parameter) = self.along {
            let before = without.first().map_or(0, |asked| asked.values.len());
            return with.derivatives(&asked, before + parameter);
        }
        let mut outputs = with.outputs(&asked);
        for (output, plain) in outputs.iter_mut().zip(plain) {
            output.iter_mut().zip(plain).for_each(|(y, p)| *y -= p);
        }
        outputs
    }

    /// Which of the effect's parameters the column is about, and the size that information counts in.
    pub fn size(&self) -> (usize, f64) {
        match self.along {
            Some(parameter) => (parameter, 1.0),
            None => (0, self.start[0]),
        }
    }

    fn sided(&self, sum: f64) -> f64 {
        if self.one_sided {
            sum.max(0.0)
        } else {
            sum.abs()
        }
    }

    fn bound(&mut self) {
        let units = self.scores.iter().zip(&self.variances);
        self.bounded = units
            .map(|(s, v)| match *v {
                v if v > 0.0 => s / (v + 0.25 * s * s).sqrt(),
                _ => 0.0,
            })
            .collect();
    }

    /// Whether every tightening has its own size of it.
    pub fn is_own(&self) -> bool {
        self.own
    }

    /// Chance that noise alone gives this energy; only for sizes of their own.
    pub fn chance_p(&self) -> Option<f64> {
        let freedom = self.variances.iter().filter(|v| **v > 0.0).count();
        (self.own && freedom > 0).then(|| chi_squared_tail(self.energy(), freedom as f64))
    }

    /// Predicted decrease of Σ r².
    pub fn predicted_gain(&self) -> f64 {
        if self.own {
            return self.energy();
        }
        let sum: f64 = self.scores.iter().sum();
        match self.information {
            information if information > 0.0 => self.sided(sum).powi(2) / information,
            _ => 0.0,
        }
    }

    /// Σ s²/var(s): what sizes of its own for every tightening explain, in units of chance.
    fn energy(&self) -> f64 {
        let terms = self.scores.iter().zip(&self.variances);
        terms
            .map(|(s, v)| if *v > 0.0 { s * s / v } else { 0.0 })
            .sum()
    }
}

impl<'a, 'h> Scorer<'a, 'h> {
    pub fn new(
        hypothesis: &'h Hypothesis<'a>,
        fitted: &'h Fitted,
        units: Units,
        control: Control,
    ) -> Self {
        let campaigns = if units.are_whole() && fitted.is_weighted {
            control.campaigns
        } else {
            0
        };
        Self {
            hypothesis,
            fitted,
            units,
            control: Control {
                campaigns,
                ..control
            },
        }
    }

    /// All columns of `effects`.
    pub fn score(&self, effects: &[Effect]) -> Result<Scored, DiagnoseError> {
        let whole = self.units.are_whole();
        let model = &self.hypothesis.cases[0].model;
        let mut columns: Vec<Column> = effects
            .iter()
            .flat_map(|&effect| directions(effect, &model.ranges(effect), whole))
            .collect();
        let mut others = Vec::new();
        for &effect in effects {
            let mut with = self.fitted.effects.clone();
            with.push(effect);
            others.push((effect, Hypothesis::new(self.hypothesis.cases, &with)?));
        }
        let members: Vec<usize> = (0..self.hypothesis.cases.len()).collect();
        let contributions: Vec<Contribution> = (members.par_chunks(TOGETHER))
            .flat_map_iter(|some| self.contributions(some, &columns, &others))
            .collect();
        let blank = columns.clone();
        for contribution in &contributions {
            for (index, column) in columns.iter_mut().enumerate() {
                column.scores.extend(&contribution.scores[index]);
                column.variances.extend(&contribution.variances[index]);
                column.information += contribution.information[index];
                let cross = &contribution.cross[index];
                column.cross.resize(cross.len(), 0.0);
                for (sum, more) in column.cross.iter_mut().zip(cross) {
                    *sum += more;
                }
            }
        }
        let gradients: Vec<&[f64]> = self
            .fitted
            .profiles()
            .iter()
            .map(|(_, g)| g.as_slice())
            .collect();
        let mut control = Vec::new();
        for campaign in 0..self.control.campaigns {
            let mut drawn = blank.clone();
            for (index, column) in drawn.iter_mut().enumerate() {
                column.variances.clone_from(&columns[index].variances);
                column.cross.clone_from(&columns[index].cross);
                let drawn = contributions.iter().map(|c| c.control[campaign][index]);
                column.scores = drawn.collect();
            }
            let gradients: Vec<&[f64]> = contributions
                .iter()
                .map(|c| &c.control[campaign][columns.len()..])
                .collect();
            self.project_shared(&mut drawn, &gradients);
            control.push(drawn);
        }
        self.project_shared(&mut columns, &gradients);
        Ok(Scored { columns, control })
    }

    /// What some tightenings, simulated side by side, add.
    fn contributions(
        &self,
        members: &[usize],
        columns: &[Column],
        others: &[(Effect, Hypothesis<'_>)],
    ) -> Vec<Contribution> {
        let hypothesis = self.hypothesis;
        // What an effect does is worked out from a torque without the noise that the residual has from it: a delay or a
        // lag would otherwise be seen to remove that noise.
        let smoothed: Vec<(Input, Vec<f64>)> = (members.iter())
            .map(|&member| {
                let input = hypothesis.cases[member].input.smoothed(NOISE_REACH);
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
        let plain = hypothesis.outputs(&asked);
        let of_columns: Vec<Vec<Vec<f64>>> = (columns.par_iter())
            .map(|column| {
                let other = others.iter().find(|(effect, _)| *effect == column.effect);
                other.map_or_else(
                    || plain.iter().map(|plain| vec![0.0; plain.len()]).collect(),
                    |(_, other)| column.signatures(other, &asked, &plain),
                )
            })
            .collect();
        (members.par_iter().enumerate())
            .map(|(index, &member)| {
                let own: Vec<&[f64]> = of_columns.iter().map(|of| of[index].as_slice()).collect();
                self.contribution(member, &own)
            })
            .collect()
    }

    /// All parameters of one tightening's model as fitted.
    fn values(&self, member: usize) -> Vec<f64> {
        let fitted = self.fitted;
        self.hypothesis
            .values(member, &fitted.own[member], &fitted.shared)
    }

    /// What one tightening adds, given every column's signature in it.
    fn contribution(&self, member: usize, of_columns: &[&[f64]]) -> Contribution {
        let hypothesis = self.hypothesis;
        // Stretches of one tightening share everything with each other.
        let own_count = match self.units.are_whole() {
            true => hypothesis.own.len(),
            false => hypothesis.own.len() + hypothesis.shared.len(),
        };
        let order = [hypothesis.own.as_slice(), &hypothesis.shared].concat();
        let values = self.values(member);
        let mut room = Room::default();
        let (residual, jacobian) = hypothesis.weighted(member, &values, &order, &mut room);
        let count = residual.len();
        let nuisance = Nuisance::new(jacobian, count, own_count);
        // Sensitivities to the shared parameters, as far as the own ones cannot imitate them.
        let (_, shared) = jacobian.split_at_mut(own_count * count);
        for column in shared.chunks_exact_mut(count) {
            nuisance.project(column);
        }
        let bias = self.bias_signature(member, &nuisance);
        let mut contribution = Contribution {
            scores: Vec::new(),
            variances: Vec::new(),
            information: Vec::new(),
            cross: Vec::new(),
            control: Vec::new(),
        };
        let mut signatures: Vec<Vec<f64>> = Vec::new();
        let mut along_bias = Vec::new();
        for signature in of_columns {
            let mut z = hypothesis.weigh_signal(member, signature);
            nuisance.project(&mut z);
            let (mut scores, mut variances) = (Vec::new(), Vec::new());
            let mut information = 0.0;
            for range in self.units.ranges(count) {
                let (z, r) = (&z[range.clone()], &residual[range.clone()]);
                let along = bias
                    .as_ref()
                    .map_or(0.0, |bias| dot(z, &bias[range.clone()]));
                let squares = dot(z, z);
                scores.push(dot(z, r));
                variances.push(squares + along * along);
                information += squares;
            }
            // The Jacobian is that of the residual: minus the output's.
            let cross = shared.chunks_exact(count).map(|shared| -dot(shared, &z));
            contribution.cross.push(cross.collect());
            contribution.scores.push(scores);
            contribution.variances.push(variances);
            contribution.information.push(information);
            if self.control.campaigns > 0 {
                along_bias.push(bias.as_ref().map_or(0.0, |bias| dot(&z, bias)));
                signatures.push(z);
            }
        }
        if self.control.campaigns > 0 {
            for column in shared.chunks_exact(count) {
                along_bias.push(bias.as_ref().map_or(0.0, |bias| dot(column, bias)));
                signatures.push(column.to_vec());
            }
            contribution.control = self.draw(member, &signatures, &along_bias);
        }
        contribution
    }

    /// Scores of campaigns that hold nothing but noise: white noise, seen through what the signatures span.
    fn draw(&self, member: usize, signatures: &[Vec<f64>], along_bias: &[f64]) -> Vec<Vec<f64>> {
        let coordinates = coordinates(signatures);
        let most = coordinates.iter().map(Vec::len).max().unwrap_or(0);
        let mut random = ChaCha8Rng::seed_from_u64(self.control.seed);
        // Stream 0 flips signs.
        random.set_stream(1 + member as u64);
        (0..self.control.campaigns)
            .map(|_| {
                let noise: Vec<f64> = (0..most)
                    .map(|_| StandardNormal.sample(&mut random))
                    .collect();
                let bias: f64 = StandardNormal.sample(&mut random);
                (coordinates.iter().zip(along_bias))
                    .map(|(own, along)| dot(own, &noise) + bias * along)
                    .collect()
            })
            .collect()
    }

    /// What one standard error of the bias taken out in the quiet part does to the weighted output.
    fn bias_signature(&self, member: usize, nuisance: &Nuisance) -> Option<Vec<f64>> {
        let case = &self.hypothesis.cases[member];
        let corrections = &case.tightening.corrections;
        let bias = corrections
            .iter()
            .find(|c| c.effect == "acceleration_bias")?;
        if case.quantity != snug_campaign::Quantity::Acceleration || bias.standard_error <= 0.0 {
            return None;
        }
        let constant = vec![bias.standard_error; case.measured().len()];
        let mut weighted = self.hypothesis.weigh_signal(member, &constant);
        nuisance.project(&mut weighted);
        Some(weighted)
    }

    /// Takes out of every column what the shared parameters of the model can imitate over all tightenings together.
    fn project_shared(&self, columns: &mut [Column], gradients: &[&[f64]]) {
        if !self.fitted.shared.is_empty() && self.units.are_whole() {
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

/// P(χ² > x) with `freedom` degrees of freedom.
fn chi_squared_tail(x: f64, freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(1.0, |chi| chi.sf(x))
}

/// The directions of an effect: derivatives where it vanishes at its start, else each combination of its starts.
fn directions(effect: Effect, ranges: &[PlausibleRange], whole: bool) -> Vec<Column> {
    let specs = effect.description().parameters;
    let own = whole && specs.iter().all(|spec| spec.scope == Scope::PerTightening);
    let column = |start: Vec<f64>, along: Option<usize>| Column {
        effect,
        along,
        start,
        one_sided: specs[0].minimum >= 0.0,
        largest: ranges.iter().map(PlausibleRange::largest).collect(),
        own,
        scores: Vec::new(),
        bounded: Vec::new(),
        variances: Vec::new(),
        information: 0.0,
        cross: Vec::new(),
    };
    let usual: Vec<f64> = ranges.iter().map(|range| range.starts[0]).collect();
    if usual.iter().all(|&start| start == 0.0) {
        return (0..specs.len())
            .map(|parameter| column(usual.clone(), Some(parameter)))
            .collect();
    }
    combinations(ranges)
        .into_iter()
        .map(|start| column(start, None))
        .collect()
}

/// Every combination of the starts of an effect's parameters.
fn combinations(ranges: &[PlausibleRange]) -> Vec<Vec<f64>> {
    ranges.iter().fold(vec![Vec::new()], |partial, range| {
        partial
            .iter()
            .flat_map(|values: &Vec<f64>| {
                range.starts.iter().map(|&start| {
                    let mut values = values.clone();
                    values.push(start);
                    values
                })
            })
            .collect()
    })
}
