//! What the noise does to an estimate: M = Jᵀ cov(r) J at the optimum, for the sandwich (JᵀJ)⁻¹ M (JᵀJ)⁻¹.

use crate::agreement::error_over_noise;
use crate::{Fit, Residual, ResidualNoise, TighteningResidual, Whitening};
use snug_campaign::{Quantity, Tightening};
use snug_model::Input;

/// Number of stretches whose summed scores are taken as independent where the residual holds more than noise.
const STRETCHES: usize = 30;
/// Standard deviations by which the mean square residual must exceed the noise to count as misfit.
const MISFIT: f64 = 4.0;

/// Mean square of the whitened acceleration residual beyond which a fit of the displacement shows misfit: the parameter
/// errors that integrated noise causes are visible in the acceleration by themselves, but do not double it.
const BEYOND_PARAMETER_ERROR: f64 = 2.0;

/// The noise in a residual, owned.
pub enum OwnedNoise {
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

/// The residual and its Jacobian at the optimum.
struct Linearized {
    residual: Vec<f64>,
    /// Column-major.
    jacobian: Vec<f64>,
    parameters: usize,
}

/// What is known of the noise in this residual.
///
/// Whitened residual: unit variance, plus the uncertainty of the bias taken out in the quiet part. Integrated noise
/// (displacement or velocity fitted, acceleration measured): the measured noise, integrated as the signal was. Unknown
/// noise: from the scores of the residual itself, summed over stretches so that their correlation in time counts. More
/// residual than noise: those scores beside the noise, or the integrated noise times the excess.
pub fn noise_of(
    residual: &mut TighteningResidual<'_>,
    tightening: &Tightening,
    input: &Input,
    fit: &Fit,
) -> OwnedNoise {
    let whitened = residual.is_whitened();
    let excess = excess(residual, tightening, fit);
    let misfit = excess > 1.0;
    let bias_variance = bias_variance(tightening);
    if whitened && !misfit && bias_variance == 0.0 {
        return OwnedNoise::Unit;
    }
    let Some(at) = linearize(residual, fit) else {
        return OwnedNoise::Unit;
    };
    let known = if whitened {
        Some(products(&at.jacobian, at.parameters))
    } else {
        integrated_noise(residual, &at, tightening, input)
    };
    let mut meat = match known {
        Some(known) if misfit && whitened => sum(known, &scores(&at)),
        // Integrated noise leaves too few independent stretches to learn from.
        Some(known) => known.iter().map(|value| excess * value).collect(),
        None => scores(&at),
    };
    if whitened && bias_variance > 0.0 {
        add_bias(&mut meat, residual, &at, bias_variance);
    }
    OwnedNoise::Sandwich(meat)
}

/// Mean square of the whitened residual of the quantity whose noise is known, where it exceeds 1 beyond chance; else 1.
fn excess(residual: &mut TighteningResidual<'_>, tightening: &Tightening, fit: &Fit) -> f64 {
    let count = residual.residual_count() as f64;
    let mean_square = if residual.is_whitened() {
        Some(fit.sum_of_squares() / count)
    } else {
        tightening.noise.as_ref().and_then(|noise| {
            let measured = tightening.motion.get(noise.quantity)?;
            let simulated = residual.simulate(&fit.values, noise.quantity);
            Some(error_over_noise(measured, &simulated, noise)?.powi(2))
        })
    };
    let chance = if residual.is_whitened() {
        1.0 + MISFIT * (2.0 / count).sqrt()
    } else {
        BEYOND_PARAMETER_ERROR
    };
    mean_square
        .filter(|&mean_square| mean_square > chance)
        .unwrap_or(1.0)
}

fn sum(mut noise: Vec<f64>, misfit: &[f64]) -> Vec<f64> {
    for (value, more) in noise.iter_mut().zip(misfit) {
        *value += more;
    }
    noise
}

/// Variance of the acceleration bias that was estimated and taken out \[(rad/s²)²\].
fn bias_variance(tightening: &Tightening) -> f64 {
    tightening
        .corrections
        .iter()
        .filter(|correction| correction.effect == "acceleration_bias")
        .map(|correction| correction.standard_error.powi(2))
        .sum()
}

fn linearize(residual: &mut TighteningResidual<'_>, fit: &Fit) -> Option<Linearized> {
    let (count, parameters) = (residual.residual_count(), residual.parameter_count());
    let mut at = Linearized {
        residual: vec![0.0; count],
        jacobian: vec![0.0; count * parameters],
        parameters,
    };
    residual
        .evaluate(&fit.values, &mut at.residual, Some(&mut at.jacobian))
        .ok()?;
    Some(at)
}

/// Aᵀ A for a column-major A of `columns` columns; row-major.
fn products(columns: &[f64], count: usize) -> Vec<f64> {
    let length = columns.len() / count.max(1);
    let column = |index: usize| &columns[index * length..(index + 1) * length];
    let mut products = vec![0.0; count * count];
    for i in 0..count {
        for j in 0..count {
            products[i * count + j] = column(i).iter().zip(column(j)).map(|(a, b)| a * b).sum();
        }
    }
    products
}

/// Σ over stretches of u uᵀ with u = Σ_t J_t r_t, corrected for the parameters that were fitted.
fn scores(at: &Linearized) -> Vec<f64> {
    let count = at.residual.len();
    let stretch = count.div_ceil(STRETCHES).max(1);
    let stretches = count.div_ceil(stretch);
    let mut sums = vec![0.0; at.parameters * stretches];
    for parameter in 0..at.parameters {
        let column = &at.jacobian[parameter * count..(parameter + 1) * count];
        for (index, (j, r)) in column.iter().zip(&at.residual).enumerate() {
            sums[parameter * stretches + index / stretch] += j * r;
        }
    }
    let lost = (stretches as f64 - at.parameters as f64).max(1.0);
    let mut meat = products(&sums, at.parameters);
    for value in &mut meat {
        *value *= stretches as f64 / lost;
    }
    meat
}

/// Adds var(b) g gᵀ, g = J_wᵀ d_w, where d is what a unit bias does to the fitted output.
fn add_bias(meat: &mut [f64], residual: &TighteningResidual<'_>, at: &Linearized, variance: f64) {
    let mut effect = vec![0.0; at.residual.len()];
    residual.weigh(&vec![1.0; residual.samples()], &mut effect);
    let along: Vec<f64> = at
        .jacobian
        .chunks_exact(effect.len())
        .map(|column| column.iter().zip(&effect).map(|(j, e)| j * e).sum())
        .collect();
    for (i, a) in along.iter().enumerate() {
        for (j, b) in along.iter().enumerate() {
            meat[i * at.parameters + j] += variance * a * b;
        }
    }
}

/// M for acceleration noise that was integrated into the fitted velocity or displacement; `None` for other noise.
fn integrated_noise(
    residual: &TighteningResidual<'_>,
    at: &Linearized,
    tightening: &Tightening,
    input: &Input,
) -> Option<Vec<f64>> {
    let noise = tightening.noise.as_ref()?;
    let whitening = Whitening::new(noise)?;
    let integrations = match (noise.quantity, residual.quantity()) {
        (Quantity::Acceleration, Quantity::Displacement) => 2,
        (Quantity::Acceleration, Quantity::Velocity) => 1,
        _ => return None,
    };
    let interval_s = tightening.time_base.interval_s;
    let unscored = residual.samples() - at.residual.len();
    let mut sources = vec![0.0; residual.samples() * at.parameters];
    let mut drift = vec![0.0; at.parameters];
    for ((column, source), drift) in at
        .jacobian
        .chunks_exact(at.residual.len())
        .zip(sources.chunks_exact_mut(residual.samples()))
        .zip(&mut drift)
    {
        source[unscored..].copy_from_slice(column);
        // What a velocity that was already wrong at the window's start adds: 1 to the velocity, t to the displacement.
        *drift = source
            .iter()
            .enumerate()
            .map(|(k, s)| s * (k as f64 * interval_s).powi(integrations - 1))
            .sum();
        for _ in 0..integrations {
            integrate_transposed(source, interval_s);
        }
        whitening.colour_transposed(source);
    }
    let mut meat = products(&sources, at.parameters);
    let velocity_variance =
        whitening.long_run_variance() * interval_s * input.rest_before_s().max(0.0);
    for (i, a) in drift.iter().enumerate() {
        for (j, b) in drift.iter().enumerate() {
            meat[i * at.parameters + j] += velocity_variance * a * b;
        }
    }
    Some(meat)
}

/// Lᵀ s for the cumulative trapezoid L with step `interval_s` (L starts at zero).
fn integrate_transposed(signal: &mut [f64], interval_s: f64) {
    let mut later = 0.0;
    for index in (0..signal.len()).rev() {
        let own = if index == 0 { 0.0 } else { signal[index] };
        let weight = if index == 0 {
            0.5 * later
        } else {
            later + 0.5 * own
        };
        later += own;
        signal[index] = interval_s * weight;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// sᵀ L a = (Lᵀ s)ᵀ a with L the cumulative trapezoid.
    #[test]
    fn transposed_integration_is_the_adjoint() {
        let (s, a, h) = ([0.3, -1.0, 2.0, 0.7], [1.0, 0.5, -2.0, 4.0], 0.1);
        let mut integral = 0.0;
        let mut forwards = 0.0;
        for k in 1..4 {
            integral += 0.5 * h * (a[k - 1] + a[k]);
            forwards += s[k] * integral;
        }
        let mut transposed = s;
        integrate_transposed(&mut transposed, h);
        let backwards: f64 = transposed.iter().zip(&a).map(|(s, a)| s * a).sum();
        assert!((forwards - backwards).abs() < 1e-15);
    }
}
