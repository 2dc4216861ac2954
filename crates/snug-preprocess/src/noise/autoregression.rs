//! Fits an autoregression to noise: it whitens residuals, and gives the standard error of a mean under coloured noise.

use snug_campaign::{NoiseFloor, NoiseSource, Quantity};

/// Prediction error over variance below which no further order is added: the rest is rounding (a pure line spectrum).
const SMALLEST_ERROR_RATIO: f64 = 1e-6;

/// Samples needed per coefficient.
const SAMPLES_PER_ORDER: usize = 10;

/// A stationary process as an autoregression driven by white noise.
///
/// n_t + a_1 n_{t−1} + … + a_p n_{t−p} = e_t, where n is the signal less its mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Autoregression {
    /// a_1 … a_p, without unit; empty for white noise.
    pub coefficients: Vec<f64>,
    /// Standard deviation of e_t, in the signal's unit.
    pub innovation_sd: f64,
    /// Standard deviation of n_t, in the signal's unit.
    pub standard_deviation: f64,
    /// Samples it was fitted to.
    pub samples: usize,
}

impl Autoregression {
    /// Fits by the Yule–Walker equations, order by Akaike's criterion.
    ///
    /// The Levinson–Durbin recursion on the biased autocovariance gives every order up to `maximum_order` and only stable
    /// processes. Akaike's criterion, not the Bayesian one, because the order is only a means here: too short an
    /// autoregression makes the variance of a mean too small. At most one coefficient per ten samples.
    /// `None` when the signal is constant, not finite, or shorter than ten samples.
    ///
    /// Source: Brockwell and Davis, Time Series: Theory and Methods, sections 8.1, 8.2 and 9.3.
    pub fn fit(signal: &[f64], maximum_order: usize) -> Option<Self> {
        let count = signal.len();
        if count < SAMPLES_PER_ORDER || signal.iter().all(|&value| value == signal[0]) {
            return None;
        }
        let mean = signal.iter().sum::<f64>() / count as f64;
        let centred: Vec<f64> = signal.iter().map(|value| value - mean).collect();
        let orders = maximum_order.min(count / SAMPLES_PER_ORDER);
        let covariance: Vec<f64> = (0..=orders)
            .map(|lag| dot(&centred[lag..], &centred[..count - lag]) / count as f64)
            .collect();
        let variance = covariance[0];
        if !variance.is_finite() || variance <= 0.0 {
            return None;
        }
        let (coefficients, error) = levinson_durbin(&covariance, count);
        // The recursion's error lacks the degrees of freedom of the mean and the coefficients.
        let free = (count - 1 - coefficients.len()) as f64;
        Some(Self {
            innovation_sd: (error * count as f64 / free).sqrt(),
            standard_deviation: (variance * count as f64 / (count - 1) as f64).sqrt(),
            coefficients,
            samples: count,
        })
    }

    /// Spectral density at frequency zero times 2π, S_0 = σ_e² / (1 + Σ a_i)²: n times the variance of a mean of n.
    pub fn long_run_variance(&self) -> f64 {
        let gain = 1.0 + self.coefficients.iter().sum::<f64>();
        (self.innovation_sd / gain).powi(2)
    }

    /// Standard error of the mean of `count` successive samples, √(S_0 / count); valid when the process forgets within
    /// far fewer samples.
    pub fn standard_error_of_mean(&self, count: usize) -> f64 {
        (self.long_run_variance() / count as f64).sqrt()
    }

    /// The noise floor of `quantity`, where this is what the quiet part shows of it.
    pub(crate) fn floor(&self, quantity: Quantity) -> NoiseFloor {
        NoiseFloor {
            source: NoiseSource::PreRoll,
            quantity,
            standard_deviation: self.standard_deviation,
            autoregression: self.coefficients.clone(),
            innovation_sd: self.innovation_sd,
            samples: self.samples,
        }
    }
}

/// Coefficients and prediction error of the order that Akaike's criterion, n ln σ² + 2 p, likes best.
fn levinson_durbin(covariance: &[f64], count: usize) -> (Vec<f64>, f64) {
    let mut error = covariance[0];
    let mut coefficients: Vec<f64> = Vec::new();
    let mut best = (Vec::new(), error);
    let mut best_criterion = count as f64 * error.ln();
    for order in 1..covariance.len() {
        let predicted: f64 = coefficients
            .iter()
            .enumerate()
            .map(|(index, coefficient)| coefficient * covariance[order - 1 - index])
            .sum();
        let reflection = -(covariance[order] + predicted) / error;
        let mirrored: Vec<f64> = coefficients.iter().rev().copied().collect();
        for (coefficient, mirror) in coefficients.iter_mut().zip(mirrored) {
            *coefficient += reflection * mirror;
        }
        coefficients.push(reflection);
        error *= 1.0 - reflection * reflection;
        if error <= SMALLEST_ERROR_RATIO * covariance[0] {
            break;
        }
        let criterion = count as f64 * error.ln() + 2.0 * order as f64;
        if criterion < best_criterion {
            best_criterion = criterion;
            best = (coefficients.clone(), error);
        }
    }
    best
}

/// Scalar product in eight running sums: the compiler can use vector instructions, the order stays the same everywhere.
fn dot(left: &[f64], right: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0; LANES];
    let (left_blocks, right_blocks) = (left.chunks_exact(LANES), right.chunks_exact(LANES));
    let rest: f64 = left_blocks
        .remainder()
        .iter()
        .zip(right_blocks.remainder())
        .map(|(a, b)| a * b)
        .sum();
    for (a, b) in left_blocks.zip(right_blocks) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
#[path = "autoregression_tests.rs"]
mod tests;
