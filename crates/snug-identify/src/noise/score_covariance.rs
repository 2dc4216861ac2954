//! What the noise does to an estimate: M = Jᵀ cov(r) J at the optimum, for the sandwich (JᵀJ)⁻¹ M (JᵀJ)⁻¹.
//!
//! It is of one tightening, within which samples depend on each other: M comes from what is known of the noise and, where the
//! residual holds more, from scores summed over stretches of time. snug-least-squares puts bread around it; the sandwiches over
//! tightenings (snug-diagnose, CR1) and over clusters of values (snug-statistics, CR2) are others.

use crate::batch::BatchSimulator;
use crate::noise::integrated::{IntegratedNoise, drift, to_source};
use crate::noise::thresholds::{BEYOND_PARAMETER_ERROR, MISFIT, STRETCHES};
use crate::residual::agreement::error_over_noise;
use crate::residual::tightening::TighteningResidual;
use crate::task::FitTask;
use snug_campaign::{Quantity, Tightening};
use snug_least_squares::matrix::inner_product;
use snug_least_squares::{Fit, Residual, ResidualNoise, without_high_leverage};

/// The noise in a residual, owned.
pub(crate) enum OwnedNoise {
    /// White with unit variance.
    Unit,
    /// M, p × p, row-major.
    Sandwich(Vec<f64>),
}

impl OwnedNoise {
    /// As the covariance takes it.
    pub fn as_residual_noise(&self) -> ResidualNoise<'_> {
        match self {
            Self::Unit => ResidualNoise::Unit,
            Self::Sandwich(meat) => ResidualNoise::Sandwich(meat),
        }
    }
}

/// What is asked about the noise in one residual, and what is known beforehand.
///
/// Whitened residual: unit variance, plus the uncertainty of the bias taken out in the quiet part. Integrated noise
/// (displacement or velocity fitted, acceleration measured): the measured noise, integrated as the signal was. Unknown
/// noise: from the scores of the residual itself, summed over stretches so that their correlation in time counts. More
/// residual than noise: those scores beside the noise, or the integrated noise times the excess.
pub(crate) struct ScoreCovariance {
    whitened: bool,
    /// Whether an effect lets go, so that instants of contact say too much.
    has_unilateral_contact: bool,
    /// Whether a whitened residual holds more than noise, beyond chance.
    is_misfit: bool,
    /// Variance of an error that is the same in every sample, weighed as the residual.
    constant_variance: f64,
    integrated: Option<IntegratedNoise>,
}

/// What answers an [`ScoreCovariance`], as far as it asks; J is weighed as the residual.
#[derive(Default)]
pub(crate) struct ScoreSums {
    /// JᵀJ, or what stands for it where single samples say too much; row-major.
    pub matrix: Vec<f64>,
    /// Jᵀ1.
    pub sums: Vec<f64>,
    /// Jᵀr of each of about [`STRETCHES`] stretches, one after the other.
    pub scores: Vec<f64>,
    /// Where the noise is integrated.
    pub source: Source,
}

/// What is found at the source of integrated noise.
#[derive(Default)]
pub(crate) struct Source {
    /// Inner products of the sensitivities taken back there, row-major.
    pub products: Vec<f64>,
    /// What a velocity that was already wrong by 1 does to the gradient.
    pub drift: Vec<f64>,
    /// Mean square of the whitened acceleration residual, where the acceleration was kept.
    pub mean_square: Option<f64>,
}

impl Source {
    /// Mean square residual over noise where it exceeds 1 beyond what parameter errors do; else 1.
    fn excess(&self) -> f64 {
        let beyond = |square: &f64| *square > BEYOND_PARAMETER_ERROR;
        self.mean_square.filter(beyond).unwrap_or(1.0)
    }
}

impl ScoreCovariance {
    /// About the residual of `fit`.
    pub fn new(residual: &TighteningResidual<'_>, task: &FitTask<'_>, fit: &Fit) -> Self {
        let gain: f64 = residual
            .scoring()
            .whitening()
            .map_or(0.0, |w| w.weights().iter().sum());
        let count = residual.residual_count() as f64;
        let beyond_chance = 1.0 + MISFIT * (2.0 / count).sqrt();
        let (tightening, input) = (&task.tightening, &task.input);
        Self {
            whitened: residual.is_whitened(),
            has_unilateral_contact: residual.has_unilateral_contact(),
            is_misfit: residual.is_whitened() && fit.sum_of_squares() / count > beyond_chance,
            constant_variance: gain * gain * bias_variance(tightening),
            integrated: match residual.is_whitened() {
                true => None,
                false => IntegratedNoise::of(tightening, input, residual.quantity()),
            },
        }
    }

    /// Whether the answer is known beforehand: white noise of unit variance.
    pub fn is_settled(&self) -> bool {
        self.whitened
            && !self.is_misfit
            && !self.has_unilateral_contact
            && self.constant_variance == 0.0
    }

    /// Whether the scores are asked for.
    pub fn asks_scores(&self) -> bool {
        match self.whitened {
            true => self.is_misfit,
            false => self.integrated.is_none(),
        }
    }

    /// The noise for which the sensitivities at the source are asked for.
    pub fn integrated(&self) -> Option<&IntegratedNoise> {
        self.integrated.as_ref()
    }

    /// The noise, after the evidence.
    pub fn conclude(&self, score_sums: &ScoreSums) -> OwnedNoise {
        if self.is_settled() {
            return OwnedNoise::Unit;
        }
        let mut meat = match &self.integrated {
            // It leaves too few independent stretches to learn from their scores.
            Some(noise) => {
                let source = &score_sums.source;
                let meat = noise.meat(&source.products, &source.drift);
                meat.iter().map(|value| source.excess() * value).collect()
            }
            None if !self.whitened => score_sums.scored(),
            None if self.is_misfit => add(score_sums.matrix.clone(), &score_sums.scored()),
            None => score_sums.matrix.clone(),
        };
        if self.constant_variance > 0.0 {
            let sums = || score_sums.sums.iter();
            let products = sums().flat_map(|a| sums().map(move |b| a * b));
            let bias: Vec<f64> = products.map(|ab| self.constant_variance * ab).collect();
            meat = add(meat, &bias);
        }
        OwnedNoise::Sandwich(meat)
    }
}

impl ScoreSums {
    /// Σ over stretches of u uᵀ with u their scores, corrected for the parameters that were fitted.
    fn scored(&self) -> Vec<f64> {
        let parameters = self.sums.len();
        let mut meat = vec![0.0; parameters * parameters];
        for score in self.scores.chunks_exact(parameters.max(1)) {
            for (row, a) in meat.chunks_exact_mut(parameters.max(1)).zip(score) {
                row.iter_mut()
                    .zip(score)
                    .for_each(|(entry, b)| *entry += a * b);
            }
        }
        let stretches = (self.scores.len() / parameters.max(1)) as f64;
        let lost = (stretches - parameters as f64).max(1.0);
        meat.iter_mut().for_each(|value| *value *= stretches / lost);
        meat
    }
}

/// What is known of the noise in this residual, from J itself.
pub(crate) async fn noise_of<'a>(
    residual: &mut TighteningResidual<'a>,
    task: &FitTask<'_>,
    fit: &Fit,
    simulator: &BatchSimulator<'a>,
) -> OwnedNoise {
    let score_covariance = ScoreCovariance::new(residual, task, fit);
    if score_covariance.is_settled() {
        return OwnedNoise::Unit;
    }
    let request = residual.request(&fit.values, true);
    for simulated in simulator.simulate(vec![request]).await {
        residual.prefetch(simulated);
    }
    match score_sums(residual, &score_covariance, &task.tightening, fit) {
        Some(score_sums) => score_covariance.conclude(&score_sums),
        None => OwnedNoise::Unit,
    }
}

/// Mean square of the whitened residual of the quantity whose noise is known.
fn mean_square_of_known(
    residual: &mut TighteningResidual<'_>,
    tightening: &Tightening,
    fit: &Fit,
) -> Option<f64> {
    let noise = tightening.noise.as_ref()?;
    let measured = tightening.motion.get(noise.quantity)?;
    let simulated = residual.simulate(&fit.values, noise.quantity);
    Some(error_over_noise(measured, &simulated, noise)?.powi(2))
}

/// Everything at once: J is at hand.
fn score_sums(
    residual: &mut TighteningResidual<'_>,
    score_covariance: &ScoreCovariance,
    tightening: &Tightening,
    fit: &Fit,
) -> Option<ScoreSums> {
    let (count, parameters) = (residual.residual_count(), residual.parameter_count());
    let (mut r, mut jacobian) = (vec![0.0; count], vec![0.0; count * parameters]);
    (residual.evaluate(&fit.values, &mut r, Some(&mut jacobian))).ok()?;
    let columns = || jacobian.chunks_exact(count);
    let stretch = count.div_ceil(STRETCHES).max(1);
    let mut scores = Vec::new();
    for begin in (0..count).step_by(stretch) {
        let part = begin..(begin + stretch).min(count);
        scores
            .extend(columns().map(|column| inner_product(&column[part.clone()], &r[part.clone()])));
    }
    let source = score_covariance.integrated().map(|noise| {
        let unscored = residual.samples() - count;
        let (h, integrations) = (noise.interval_s, noise.integrations);
        let mut drifts = Vec::new();
        let sources: Vec<f64> = columns()
            .flat_map(|column| {
                let mut source = vec![0.0; unscored];
                source.extend(column);
                let autoregression = noise.whitening.coefficients();
                let signal = source.as_chunks_mut::<1>().0;
                let mut sum = 0.0;
                to_source(signal, h, integrations, autoregression, |t, [s], _| {
                    sum += s * drift(t, h, integrations);
                });
                drifts.push(sum);
                source
            })
            .collect();
        Source {
            products: products(&sources, parameters),
            drift: drifts,
            mean_square: mean_square_of_known(residual, tightening, fit),
        }
    });
    let matrix = products(&jacobian, parameters);
    let fewer = (score_covariance.has_unilateral_contact)
        .then(|| without_high_leverage(&jacobian, parameters, &matrix));
    Some(ScoreSums {
        matrix: fewer.flatten().unwrap_or(matrix),
        sums: columns().map(|column| column.iter().sum()).collect(),
        scores,
        source: source.unwrap_or_default(),
    })
}

/// Variance of the acceleration bias that was estimated and taken out \[(rad/s²)²\].
fn bias_variance(tightening: &Tightening) -> f64 {
    let bias = tightening.correction_of(Quantity::Acceleration);
    bias.map_or(0.0, |bias| bias.standard_error.powi(2))
}

fn add(mut noise: Vec<f64>, more: &[f64]) -> Vec<f64> {
    for (value, more) in noise.iter_mut().zip(more) {
        *value += more;
    }
    noise
}

/// Aᵀ A for a column-major A of `columns` columns; row-major.
fn products(columns: &[f64], count: usize) -> Vec<f64> {
    let length = columns.len() / count.max(1);
    let column = |index: usize| &columns[index * length..(index + 1) * length];
    let mut products = vec![0.0; count * count];
    for i in 0..count {
        for j in i..count {
            let product = inner_product(column(i), column(j));
            (products[i * count + j], products[j * count + i]) = (product, product);
        }
    }
    products
}
