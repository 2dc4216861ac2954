//! Noise of a measured acceleration in the velocity or displacement that was integrated from it.
//!
//! With L the integration and C the colour of the noise, the fitted signal's noise is L C e with white e of unit variance,
//! so that a sensitivity s meets the noise with the variance ‖Cᵀ Lᵀ s‖²: s is integrated and filtered backwards in time.

use crate::residual::whitening::Whitening;
use snug_campaign::{Quantity, Tightening};
use snug_model::{Input, Real};

/// What is known of such noise in one tightening.
pub(crate) struct IntegratedNoise {
    pub whitening: Whitening,
    /// How often the fitted signal was integrated.
    pub integrations: i32,
    pub interval_s: f64,
    /// Of the velocity that was already wrong at the window's start.
    pub velocity_variance: f64,
}

impl IntegratedNoise {
    /// In the fitted `quantity`; `None` for other noise.
    pub fn of(tightening: &Tightening, input: &Input, quantity: Quantity) -> Option<Self> {
        let noise = tightening.noise.as_ref()?;
        let integrations = match (noise.quantity, quantity) {
            (Quantity::Acceleration, Quantity::Displacement) => 2,
            (Quantity::Acceleration, Quantity::Velocity) => 1,
            _ => return None,
        };
        let whitening = Whitening::new(noise)?;
        let interval_s = tightening.time_base.interval_s;
        let rest_s = input.rest_before_s().max(0.0);
        Some(Self {
            velocity_variance: whitening.long_run_variance() * interval_s * rest_s,
            whitening,
            integrations,
            interval_s,
        })
    }

    /// M from Cᵀ Lᵀ J's inner products (n × n), σ_e left out of it, and from what J makes of the wrong velocity.
    pub fn meat(&self, products: &[f64], drift: &[f64]) -> Vec<f64> {
        let variance = self.whitening.innovation_sd().powi(2);
        let rows = drift.iter().flat_map(|a| drift.iter().map(move |b| a * b));
        let pairs = products.iter().zip(rows);
        pairs
            .map(|(product, wrong)| variance * product + self.velocity_variance * wrong)
            .collect()
    }
}

/// Replaces K signals s by Cᵀ Lᵀ s, σ_e left out, for L the cumulative trapezoid with step `interval_s` (it starts at
/// zero), applied `integrations` times: once or twice.
///
/// From the last sample to the first, everything at once: the signals of many tightenings side by side fill the cache, and
/// every walk over them would fetch them again. Each sample's s and Cᵀ Lᵀ s are handed to `visit` with its number.
#[inline(always)]
pub(crate) fn to_source<R: Real, const K: usize>(
    signals: &mut [[R; K]],
    interval_s: R,
    integrations: i32,
    autoregression: &[R],
    visit: impl FnMut(usize, &[R; K], &[R; K]),
) {
    match integrations {
        1 => backwards::<R, K, 1>(signals, interval_s, autoregression, visit),
        _ => backwards::<R, K, 2>(signals, interval_s, autoregression, visit),
    }
}

#[inline(always)]
fn backwards<R: Real, const K: usize, const INTEGRATIONS: usize>(
    signals: &mut [[R; K]],
    interval_s: R,
    autoregression: &[R],
    mut visit: impl FnMut(usize, &[R; K], &[R; K]),
) {
    // Of every integration the sum of what came later.
    let mut later = [[interval_s.constant(0.0); K]; INTEGRATIONS];
    for t in (0..signals.len()).rev() {
        let given = signals[t];
        let mut source = given;
        for later in &mut later {
            for (s, later) in source.iter_mut().zip(later) {
                let own = *s;
                *s = interval_s
                    * match t {
                        0 => *later * 0.5,
                        _ => *later + own * 0.5,
                    };
                *later += own;
            }
        }
        // The farthest first: only the last of these sums has to wait for the sample just filtered.
        let filtered = &signals[t + 1..];
        for (a, later) in autoregression.iter().zip(filtered).rev() {
            for (s, later) in source.iter_mut().zip(later) {
                *s = *s - *a * *later;
            }
        }
        visit(t, &given, &source);
        signals[t] = source;
    }
}

/// What a velocity that was already wrong by 1 at the window's start adds to the fitted signal at a sample: 1 to the
/// velocity, the time to the displacement.
#[inline(always)]
pub(crate) fn drift<R: Real>(index: usize, interval_s: R, integrations: i32) -> R {
    match integrations {
        2 => interval_s * index as f64,
        _ => interval_s.constant(1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// sᵀ L C e = (Cᵀ Lᵀ s)ᵀ e with L the cumulative trapezoid, once and twice, and C the colour of order 2.
    #[test]
    fn to_source_is_the_adjoint_of_colouring_and_integrating() {
        let (s, e, h) = ([0.3, -1.0, 2.0, 0.7], [1.0, 0.5, -2.0, 4.0], 0.1);
        let mut signal = [0.0; 4];
        for t in 0..4 {
            let past = |lag: usize| if t >= lag { signal[t - lag] } else { 0.0 };
            signal[t] = e[t] + 0.9 * past(1) - 0.2 * past(2);
        }
        for integrations in [1, 2] {
            let mut integral = [0.0; 4];
            for k in 1..4 {
                integral[k] = integral[k - 1] + 0.5 * h * (signal[k - 1] + signal[k]);
            }
            signal = integral;
            let forwards: f64 = s.iter().zip(&signal).map(|(s, n)| s * n).sum();
            let mut source = s;
            let rows = source.as_chunks_mut::<1>().0;
            to_source(rows, h, integrations, &[-0.9, 0.2], |t, [given], _| {
                assert_eq!(*given, s[t]);
            });
            let backwards: f64 = source.iter().zip(&e).map(|(s, e)| s * e).sum();
            assert!((forwards - backwards).abs() < 1e-15);
        }
    }
}
