//! Score before refit: how much of the residual points where an effect would push the simulation.
//!
//! With J_i the sensitivities of the fitted model, z_ij the effect's signature and everything weighted,
//! z̃ = z − J (JᵀJ)⁻¹ Jᵀ z, s_ij = z̃ᵀ r_i, I_ij = z̃ᵀ z̃; predicted size Σ s / Σ I.

use crate::DiagnoseError;
use crate::dense::dot;
use crate::fitted::Fitted;
use crate::hypothesis::Hypothesis;
use crate::units::Units;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use snug_model::{Effect, Law, ParameterSpec, Scope};

/// One direction in which an effect could push: the derivative to a parameter, or one of its starts against none.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    pub effect: Effect,
    /// Which of the effect's parameters is differentiated by; `None` for a start against none.
    along: Option<usize>,
    /// Values of the effect's own parameters to begin a refit with.
    pub start: Vec<f64>,
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

/// The fitted model against which effects are scored, and what was worked out of it once.
pub(crate) struct Scorer<'a, 'h> {
    hypothesis: &'h mut Hypothesis<'a>,
    fitted: &'h Fitted,
    units: Units,
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

    /// How the effect pushes the output of one tightening, the model's own parameters as they are.
    fn signature(
        &self,
        with: &Hypothesis<'_>,
        member: usize,
        values: &[f64],
        plain: &[f64],
    ) -> Vec<f64> {
        let all = [values, &self.start].concat();
        match self.along {
            Some(parameter) => with.derivative(member, &all, values.len() + parameter),
            None => {
                let mut output = with.output(member, &all);
                output.iter_mut().zip(plain).for_each(|(y, p)| *y -= p);
                output
            }
        }
    }

    fn sided(&self, sum: f64) -> f64 {
        if self.one_sided { sum.max(0.0) } else { sum.abs() }
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
        terms.map(|(s, v)| if *v > 0.0 { s * s / v } else { 0.0 }).sum()
    }
}

impl<'a, 'h> Scorer<'a, 'h> {
    pub fn new(hypothesis: &'h mut Hypothesis<'a>, fitted: &'h Fitted, units: Units) -> Self {
        Self {
            hypothesis,
            fitted,
            units,
        }
    }

    /// All columns of `effects`.
    pub fn columns(&mut self, effects: &[Effect]) -> Result<Vec<Column>, DiagnoseError> {
        let mut columns: Vec<Column> = effects.iter().flat_map(|&effect| directions(effect, self.units.are_whole())).collect();
        let mut others = Vec::new();
        for &effect in effects {
            let mut with = self.fitted.effects.clone();
            with.push(effect);
            others.push((effect, Hypothesis::new(self.hypothesis.cases, &with)?));
        }
        for member in 0..self.hypothesis.cases.len() {
            self.score_member(member, &mut columns, &others);
        }
        self.project_shared(&mut columns);
        columns.iter_mut().for_each(Column::bound);
        Ok(columns)
    }

    fn score_member(
        &mut self,
        member: usize,
        columns: &mut [Column],
        others: &[(Effect, Hypothesis<'_>)],
    ) {
        // Stretches of one tightening share everything with each other.
        let own_count = match self.units.are_whole() {
            true => self.hypothesis.own.len(),
            false => self.hypothesis.own.len() + self.hypothesis.shared.len(),
        };
        let order = [self.hypothesis.own.as_slice(), &self.hypothesis.shared].concat();
        let (own, shared) = (&self.fitted.own[member], &self.fitted.shared);
        let values = self.hypothesis.values(member, own, shared);
        let (residual, jacobian) = self.hypothesis.weighted(member, &values, &order);
        let (residual, mut jacobian) = (residual.to_vec(), jacobian.to_vec());
        let count = residual.len();
        let nuisance = Nuisance::new(&jacobian, count, own_count);
        // Sensitivities to the shared parameters, as far as the own ones cannot imitate them.
        for column in jacobian[own_count * count..].chunks_exact_mut(count) {
            nuisance.project(column);
        }
        let bias = self.bias_signature(member, &nuisance);
        let plain = self.hypothesis.output(member, &values);
        for column in columns {
            let Some((_, other)) = others.iter().find(|(effect, _)| *effect == column.effect) else {
                continue;
            };
            let signature = column.signature(other, member, &values, &plain);
            let mut weighted = self.hypothesis.weigh_signal(member, &signature);
            nuisance.project(&mut weighted);
            for range in self.units.ranges(count) {
                let (z, r) = (&weighted[range.clone()], &residual[range.clone()]);
                let information = dot(z, z);
                let along_bias = bias.as_ref().map_or(0.0, |bias| dot(z, &bias[range.clone()]));
                column.scores.push(dot(z, r));
                column.variances.push(information + along_bias * along_bias);
                column.information += information;
            }
            let shared = jacobian[own_count * count..].chunks_exact(count);
            column.cross.resize(shared.len(), 0.0);
            for (cross, z) in column.cross.iter_mut().zip(shared) {
                // The Jacobian is that of the residual: minus the output's.
                *cross -= dot(z, &weighted);
            }
        }
    }

    /// What one standard error of the bias taken out in the quiet part does to the weighted output.
    fn bias_signature(&self, member: usize, nuisance: &Nuisance) -> Option<Vec<f64>> {
        let case = &self.hypothesis.cases[member];
        let corrections = &case.tightening.corrections;
        let bias = corrections.iter().find(|c| c.effect == "acceleration_bias")?;
        if case.quantity != snug_campaign::Quantity::Acceleration || bias.standard_error <= 0.0 {
            return None;
        }
        let constant = vec![bias.standard_error; case.measured().len()];
        let mut weighted = self.hypothesis.weigh_signal(member, &constant);
        nuisance.project(&mut weighted);
        Some(weighted)
    }

    /// Takes out of every column what the shared parameters of the model can imitate over all tightenings together.
    fn project_shared(&self, columns: &mut [Column]) {
        if self.fitted.shared.is_empty() || !self.units.are_whole() {
            return;
        }
        let curvature = self.fitted.shared_curvature();
        for column in columns {
            let Some(b) = curvature.solve_scaled(&column.cross) else {
                continue;
            };
            column.information -= dot(&b, &column.cross);
            for (score, (_, gradient)) in column.scores.iter_mut().zip(self.fitted.profiles()) {
                *score += dot(&b, gradient);
            }
        }
    }
}

/// Orthonormal basis of what the own parameters can imitate.
struct Nuisance {
    basis: Vec<Vec<f64>>,
}

impl Nuisance {
    /// Gram–Schmidt, twice, of the first `columns` columns.
    fn new(jacobian: &[f64], count: usize, columns: usize) -> Self {
        let mut nuisance = Self { basis: Vec::new() };
        for column in jacobian.chunks_exact(count.max(1)).take(columns) {
            let mut rest = column.to_vec();
            let before = dot(&rest, &rest);
            nuisance.project(&mut rest);
            nuisance.project(&mut rest);
            let length = dot(&rest, &rest);
            if length > 1e-20 * before && length > 0.0 {
                let scale = 1.0 / length.sqrt();
                rest.iter_mut().for_each(|value| *value *= scale);
                nuisance.basis.push(rest);
            }
        }
        nuisance
    }

    fn project(&self, signal: &mut [f64]) {
        for direction in &self.basis {
            let along = dot(direction, signal);
            for (value, d) in signal.iter_mut().zip(direction) {
                *value -= along * d;
            }
        }
    }
}

/// P(χ² > x) with `freedom` degrees of freedom.
fn chi_squared_tail(x: f64, freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(1.0, |chi| chi.sf(x))
}

/// The directions of an effect: derivatives where it vanishes at its start, else each combination of its starts.
fn directions(effect: Effect, whole: bool) -> Vec<Column> {
    let specs = effect.description().parameters;
    let own = whole && specs.iter().all(|spec| spec.scope == Scope::PerTightening);
    let column = |start: Vec<f64>, along: Option<usize>| Column {
        effect,
        along,
        start,
        one_sided: specs[0].minimum >= 0.0,
        own,
        scores: Vec::new(),
        bounded: Vec::new(),
        variances: Vec::new(),
        information: 0.0,
        cross: Vec::new(),
    };
    let usual: Vec<f64> = specs.iter().map(|spec| spec.starts[0]).collect();
    if usual.iter().all(|&start| start == 0.0) {
        return (0..specs.len())
            .map(|parameter| column(usual.clone(), Some(parameter)))
            .collect();
    }
    combinations(specs)
        .into_iter()
        .map(|start| column(start, None))
        .collect()
}

/// Every combination of the starts of an effect's parameters.
fn combinations(specs: &[ParameterSpec]) -> Vec<Vec<f64>> {
    specs.iter().fold(vec![Vec::new()], |partial, spec| {
        partial
            .iter()
            .flat_map(|values: &Vec<f64>| {
                spec.starts.iter().map(|&start| {
                    let mut values = values.clone();
                    values.push(start);
                    values
                })
            })
            .collect()
    })
}
