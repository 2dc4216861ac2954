//! Accelerometer noise, white or correlated from sample to sample; the noise of torque and force is always white.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Share of the coloured noise's variance that remembers.
const COLOURED_SHARE: f64 = 0.36;

/// Correlation of that part from sample to sample.
const COLOURED_MEMORY: f64 = 0.895;

/// Correlation structure of the accelerometer's noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoiseKind {
    /// Every sample on its own.
    #[default]
    White,
    /// White noise (64 % of the variance) plus first-order autoregressive noise (36 %, 0.895 from sample to sample):
    /// the autocorrelation is 0.32 at one sample and falls tenfold over 21.
    Coloured,
}

impl NoiseKind {
    /// Stationary noise of standard deviation `standard_deviation`.
    pub(crate) fn samples(
        self,
        standard_deviation: f64,
        count: usize,
        rng: &mut ChaCha8Rng,
    ) -> Vec<f64> {
        let mut standard = || -> f64 { StandardNormal.sample(rng) };
        match self {
            Self::White => (0..count)
                .map(|_| standard_deviation * standard())
                .collect(),
            Self::Coloured => {
                let white_sd = standard_deviation * (1.0 - COLOURED_SHARE).sqrt();
                let coloured_sd = standard_deviation * COLOURED_SHARE.sqrt();
                let innovation_sd = coloured_sd * (1.0 - COLOURED_MEMORY * COLOURED_MEMORY).sqrt();
                let mut coloured = coloured_sd * standard();
                (0..count)
                    .map(|_| {
                        let sample = coloured + white_sd * standard();
                        coloured = COLOURED_MEMORY * coloured + innovation_sd * standard();
                        sample
                    })
                    .collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    fn autocorrelation(samples: &[f64], lag: usize) -> f64 {
        let product = |lag: usize| -> f64 {
            samples[lag..]
                .iter()
                .zip(samples)
                .map(|(later, sooner)| later * sooner)
                .sum()
        };
        product(lag) / product(0)
    }

    #[test]
    fn spread_and_correlation_are_as_declared() {
        for kind in [NoiseKind::White, NoiseKind::Coloured] {
            let noise = kind.samples(0.5, 200_000, &mut ChaCha8Rng::seed_from_u64(5));
            let power = noise.iter().map(|n| n * n).sum::<f64>() / noise.len() as f64;
            // 200 000 samples, correlated over about ten: a standard error of about half a percent.
            assert!((power.sqrt() - 0.5).abs() < 0.01, "{kind:?} {power}");
            for lag in [1, 5, 20] {
                let expected = match kind {
                    NoiseKind::White => 0.0,
                    NoiseKind::Coloured => 0.36 * 0.895_f64.powi(lag as i32),
                };
                let found = autocorrelation(&noise, lag);
                assert!(
                    (found - expected).abs() < 0.015,
                    "{kind:?} {lag} {found} {expected}"
                );
            }
        }
    }
}
