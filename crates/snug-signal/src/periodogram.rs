//! Power over frequency.

use realfft::{RealFftPlanner, RealToComplex};
use std::f64::consts::PI;
use std::sync::Arc;

/// Share of the samples over which the window rises, and again falls: as little as keeps a residual that does not end where
/// it began from leaking false high frequencies; a longer fall would hide the rise of a pulse.
const TAPER: f64 = 0.05;

/// P_k = |Σ_t h_t w_t e^{−2πi k t / n}|² / Σ h², whose expectation is 1 at every frequency when w is white noise of unit
/// variance; the window h rises and falls as a cosine over 5 % of the samples at each end (Tukey).
#[derive(Clone)]
pub struct Periodogram {
    plan: Arc<dyn RealToComplex<f64>>,
    window: Vec<f64>,
}

impl Periodogram {
    /// For signals of `length` samples.
    pub fn of_length(length: usize) -> Self {
        Self {
            plan: RealFftPlanner::new().plan_fft_forward(length),
            window: window(length),
        }
    }

    /// P_k for k = 0 … n/2, at the frequency k over the signal's duration.
    ///
    /// # Panics
    /// When the signal has another length.
    pub fn power(&self, values: &[f64]) -> Vec<f64> {
        assert_eq!(
            values.len(),
            self.window.len(),
            "the length it was made for"
        );
        let power: f64 = self.window.iter().map(|h| h * h).sum();
        let mut input: Vec<f64> = values
            .iter()
            .zip(&self.window)
            .map(|(w, h)| w * h)
            .collect();
        let mut spectrum = self.plan.make_output_vec();
        self.plan
            .process(&mut input, &mut spectrum)
            .expect("buffers of the plan's own lengths");
        spectrum.iter().map(|x| x.norm_sqr() / power).collect()
    }
}

fn window(length: usize) -> Vec<f64> {
    let ramp = (TAPER * length as f64).max(1.0);
    (0..length)
        .map(|index| {
            let from_edge = (index.min(length - 1 - index) as f64 + 0.5) / ramp;
            0.5 * (1.0 - (PI * from_edge.min(1.0)).cos())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parseval: all lines, those between the ends twice, sum to n Σ (h w)² / Σ h².
    #[test]
    fn power_over_all_frequencies_is_that_over_time() {
        for length in [99, 100] {
            let values: Vec<f64> = (0..length)
                .map(|i| (0.37 * f64::from(i * i)).sin())
                .collect();
            let periodogram = Periodogram::of_length(values.len());
            let power = periodogram.power(&values);
            let ends = |k: usize| k == 0 || 2 * k == values.len();
            let all: f64 = (power.iter().enumerate())
                .map(|(k, p)| if ends(k) { *p } else { 2.0 * p })
                .sum();
            let h = &periodogram.window;
            let squares: f64 = values.iter().zip(h).map(|(w, h)| (w * h).powi(2)).sum();
            let expected = values.len() as f64 * squares / h.iter().map(|h| h * h).sum::<f64>();
            assert!((all / expected - 1.0).abs() < 1e-12, "{all} {expected}");
        }
    }
}
