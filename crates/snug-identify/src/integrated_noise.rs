//! Noise of a measured acceleration in the velocity or displacement that was integrated from it.
//!
//! With L the integration and C the colour of the noise, the fitted signal's noise is L C e with white e of unit variance,
//! so that a sensitivity s meets the noise with the variance ‖Cᵀ Lᵀ s‖²: s is integrated and filtered backwards in time.

use crate::Whitening;
use crate::whitening::colour_transposed;
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

/// Σ s τ, what a velocity that was already wrong at the window's start adds to K signals: τ is the time to the power
/// `integrations` − 1, 1 for the velocity, t for the displacement.
#[inline(always)]
pub(crate) fn drift<R: Real, const K: usize>(
    signals: &[[R; K]],
    interval_s: R,
    integrations: i32,
) -> [R; K] {
    let one = interval_s.constant(1.0);
    let mut sums = [interval_s.constant(0.0); K];
    for (index, row) in signals.iter().enumerate() {
        let time = if integrations == 2 {
            interval_s * index as f64
        } else {
            one
        };
        for (sum, s) in sums.iter_mut().zip(row) {
            *sum += *s * time;
        }
    }
    sums
}

/// Cᵀ Lᵀ s of K signals, σ_e left out.
#[inline(always)]
pub(crate) fn to_source<R: Real, const K: usize>(
    signals: &mut [[R; K]],
    interval_s: R,
    integrations: i32,
    autoregression: &[R],
) {
    for _ in 0..integrations {
        integrate_transposed(signals, interval_s);
    }
    colour_transposed(autoregression, signals);
}

/// Lᵀ s for the cumulative trapezoid L with step `interval_s` (L starts at zero).
#[inline(always)]
fn integrate_transposed<R: Real, const K: usize>(signals: &mut [[R; K]], interval_s: R) {
    let mut later = [interval_s.constant(0.0); K];
    let Some((first, rest)) = signals.split_first_mut() else {
        return;
    };
    for row in rest.iter_mut().rev() {
        for (s, later) in row.iter_mut().zip(&mut later) {
            let own = *s;
            *s = interval_s * (*later + own * 0.5);
            *later += own;
        }
    }
    for (s, later) in first.iter_mut().zip(later) {
        *s = interval_s * (later * 0.5);
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
        integrate_transposed(transposed.as_chunks_mut::<1>().0, h);
        let backwards: f64 = transposed.iter().zip(&a).map(|(s, a)| s * a).sum();
        assert!((forwards - backwards).abs() < 1e-15);
    }
}
