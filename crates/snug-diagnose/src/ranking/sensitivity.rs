//! One direction in which an effect could push, and what the clusters say of it.

use crate::data::simulation::Asked;
use crate::pooled::model::PooledModel;
use snug_least_squares::matrix::inner_product as dot;
use snug_model::{Effect, Law, PlausibleRange, Scope};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// One direction in which an effect could push: the derivative to a parameter, or one of its starts against none.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    pub effect: Effect,
    /// Which of the effect's parameters is differentiated by; `None` for a start against none.
    pub along: Option<usize>,
    /// Values of the effect's own parameters to begin a refit with.
    pub start: Vec<f64>,
    /// Largest plausible size of each of the effect's own parameters.
    pub largest: Vec<f64>,
    /// The physics knows only one sign.
    one_sided: bool,
    /// Every tightening has its own size.
    own: bool,
    /// s of each cluster.
    pub scores: Vec<f64>,
    /// s over its noise, bounded: z / √(1 + (z/2)²).
    bounded: Vec<f64>,
    /// √Σ u² of the scores and of the bounded ones.
    lengths: [f64; 2],
    /// Variance of s of each cluster under noise alone.
    pub variances: Vec<f64>,
    /// What of it those residuals say that count, where a part is told apart.
    pub counted: CountedPart,
    /// Σ I.
    pub information: f64,
    pub cross: Vec<f64>,
}

/// What some residuals of each tightening say of a column.
#[derive(Debug, Clone, Default)]
pub(crate) struct CountedPart {
    /// s of each cluster.
    pub scores: Vec<f64>,
    /// Its variance under noise alone.
    pub variances: Vec<f64>,
    /// Σ I.
    pub information: f64,
}

impl Column {
    /// T = Σ u / √Σ u² over clusters, the larger of two: u = s, and u = s in units of its noise, bounded, so that a few
    /// loud tightenings do not drown what all agree on. What is against a one-sided effect's sign counts as nothing.
    pub fn statistic(&self) -> f64 {
        self.flipped_statistic(&vec![1.0; self.scores.len()])
    }

    /// The same with the signs of whole clusters flipped.
    pub fn flipped_statistic(&self, signs: &[f64]) -> f64 {
        let ratio = |u: &[f64], length: f64| {
            if length > 0.0 {
                self.sided(dot(signs, u)) / length
            } else {
                0.0
            }
        };
        let [length, bounded_length] = self.lengths;
        ratio(&self.scores, length).max(ratio(&self.bounded, bounded_length))
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
    pub fn signatures(
        &self,
        with: &PooledModel<'_>,
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

    /// Whether physics knows so many times the signature.
    pub fn may_be(&self, times: f64) -> bool {
        !self.one_sided || times >= 0.0
    }

    fn sided(&self, sum: f64) -> f64 {
        if self.one_sided {
            sum.max(0.0)
        } else {
            sum.abs()
        }
    }

    /// Works out what follows from the scores and their variances.
    pub fn bound(&mut self) {
        let clusters = self.scores.iter().zip(&self.variances);
        self.bounded = clusters
            .map(|(s, v)| match *v {
                v if v > 0.0 => s / (v + 0.25 * s * s).sqrt(),
                _ => 0.0,
            })
            .collect();
        let length = |u: &[f64]| dot(u, u).sqrt();
        self.lengths = [length(&self.scores), length(&self.bounded)];
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

    /// Predicted decrease of Σ r² of those residuals that count, with the size that all of them predict: s̃ and Ĩ of what counts give
    /// 2 β s̃ − β² Ĩ, β = Σ s / Σ I; what a size of its own would do there is no promise.
    pub fn predicted_gain_counted(&self) -> f64 {
        let gain = |score: f64, information: f64, counted: f64, known: f64| {
            let size = score / information;
            match information > 0.0 && self.may_be(size) {
                true => size * (2.0 * counted - size * known),
                false => 0.0,
            }
        };
        let there = &self.counted;
        if !self.own {
            let [all, counted] = [&self.scores, &there.scores].map(|of| of.iter().sum::<f64>());
            return gain(all, self.information, counted, there.information);
        }
        let all = self.scores.iter().zip(&self.variances);
        let counted = there.scores.iter().zip(&there.variances);
        all.zip(counted)
            .map(|((s, v), (counted, known))| gain(*s, *v, *counted, *known))
            .sum()
    }

    /// Σ s²/var(s): what sizes of its own for every tightening explain, in units of chance.
    fn energy(&self) -> f64 {
        let terms = self.scores.iter().zip(&self.variances);
        terms
            .map(|(s, v)| if *v > 0.0 { s * s / v } else { 0.0 })
            .sum()
    }
}

/// P(χ² > x) with `freedom` degrees of freedom.
fn chi_squared_tail(x: f64, freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(1.0, |chi| chi.sf(x))
}

/// The directions of an effect: derivatives where it vanishes at its start, else each combination of its starts.
pub(crate) fn directions(effect: Effect, ranges: &[PlausibleRange], whole: bool) -> Vec<Column> {
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
        lengths: [0.0; 2],
        variances: Vec::new(),
        counted: CountedPart::default(),
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
pub(crate) fn combinations(ranges: &[PlausibleRange]) -> Vec<Vec<f64>> {
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

#[cfg(test)]
mod tests;
