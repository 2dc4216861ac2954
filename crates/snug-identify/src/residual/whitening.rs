//! The filter that makes a measured noise white, so that equal residuals are equally unlikely.

use crate::residual::thresholds::WHITENED_AT_ONCE;
use snug_campaign::{NoiseFloor, Quantity, Tightening};
use snug_model::with_processor_instructions;

/// Makes stationary noise white with unit variance: w_t = (r_t + a_1 r_{t−1} + … + a_p r_{t−p}) / σ_e.
///
/// The first p samples lack their past and are left out, so n samples give n − p.
#[derive(Debug, Clone)]
pub struct Whitening {
    autoregression: Vec<f64>,
    innovation_sd: f64,
}

impl Whitening {
    /// The filter that whitens `noise`; `None` when its innovations have no positive standard deviation.
    pub fn new(noise: &NoiseFloor) -> Option<Self> {
        (noise.innovation_sd > 0.0 && noise.innovation_sd.is_finite()).then(|| Self {
            autoregression: noise.autoregression.clone(),
            innovation_sd: noise.innovation_sd,
        })
    }

    /// The filter for `quantity` of a tightening; `None` where its noise is not known.
    pub fn of(tightening: &Tightening, quantity: Quantity) -> Option<Self> {
        let noise = tightening.noise.as_ref();
        noise
            .filter(|noise| noise.quantity == quantity)
            .and_then(Self::new)
    }

    /// Number of samples that are left out at the start.
    pub fn order(&self) -> usize {
        self.autoregression.len()
    }

    /// Variance of a long sum over its number of terms: (σ_e / (1 + a_1 + … + a_p))².
    pub fn long_run_variance(&self) -> f64 {
        (self.innovation_sd / (1.0 + self.autoregression.iter().sum::<f64>())).powi(2)
    }

    /// The weights of a sample and of those before it: (1, a_1, …, a_p) / σ_e.
    pub fn weights(&self) -> Vec<f64> {
        let scale = 1.0 / self.innovation_sd;
        let past = self.autoregression.iter().map(|a| scale * a);
        std::iter::once(scale).chain(past).collect()
    }

    /// Whitens `signal` into `white`, which is shorter by [`Whitening::order`].
    pub fn apply(&self, signal: &[f64], white: &mut [f64]) {
        self.apply_to_grid(signal, 1, white);
    }

    /// Whitens a signal with `substeps` grid points per sample at every one of them; `white` is shorter by as many per
    /// sample of [`Whitening::order`].
    pub fn apply_to_grid(&self, signal: &[f64], substeps: usize, white: &mut [f64]) {
        with_processor_instructions(
            #[inline(always)]
            || self.filter(signal, substeps, white),
        );
    }

    #[inline(always)]
    fn filter(&self, signal: &[f64], substeps: usize, white: &mut [f64]) {
        let past = self.order() * substeps;
        let count = white.len().min(signal.len().saturating_sub(past));
        let (whole, rest) = white[..count].as_chunks_mut::<WHITENED_AT_ONCE>();
        let done = whole.len() * WHITENED_AT_ONCE;
        for (block, white) in whole.iter_mut().enumerate() {
            self.filter_some(&signal[block * WHITENED_AT_ONCE..], substeps, white);
        }
        self.filter_some(&signal[done..], substeps, rest);
    }

    /// No more than are whitened at once. A few registers of neighbouring samples take up lag after lag: the sum over the lags of one
    /// sample alone would wait for each of its additions.
    #[inline(always)]
    fn filter_some(&self, signal: &[f64], substeps: usize, white: &mut [f64]) {
        let (past, scale) = (self.order() * substeps, 1.0 / self.innovation_sd);
        let mut sums = [0.0; WHITENED_AT_ONCE];
        let sums = &mut sums[..white.len()];
        for (lag, a) in self.autoregression.iter().enumerate().rev() {
            let earlier = &signal[past - (lag + 1) * substeps..];
            for (sum, earlier) in sums.iter_mut().zip(earlier) {
                *sum += a * earlier;
            }
        }
        for ((out, now), sum) in white.iter_mut().zip(&signal[past..]).zip(sums) {
            *out = (now + *sum) * scale;
        }
    }

    /// a_1, …, a_p.
    pub(crate) fn coefficients(&self) -> &[f64] {
        &self.autoregression
    }

    /// σ_e.
    pub(crate) fn innovation_sd(&self) -> f64 {
        self.innovation_sd
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::NoiseSource;

    fn second_order() -> Whitening {
        Whitening::new(&NoiseFloor {
            source: NoiseSource::Declared,
            quantity: Quantity::Acceleration,
            standard_deviation: 1.0,
            autoregression: vec![-0.9, 0.2],
            innovation_sd: 0.5,
            samples: 1000,
        })
        .expect("a positive innovation")
    }

    #[test]
    fn whitening_undoes_the_recursion_that_made_the_noise() {
        let innovations = [0.3, -1.0, 0.4, 0.7, -0.2, 1.5];
        let mut noise = [0.0; 6];
        for t in 0..6 {
            let past = |lag: usize| if t >= lag { noise[t - lag] } else { 0.0 };
            noise[t] = 0.5 * innovations[t] + 0.9 * past(1) - 0.2 * past(2);
        }
        let mut white = [0.0; 4];
        second_order().apply(&noise, &mut white);
        for (computed, expected) in white.iter().zip(&innovations[2..]) {
            assert!((computed - expected).abs() < 1e-14);
        }
    }
}
