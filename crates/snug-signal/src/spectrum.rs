//! A record as a sum of oscillations.

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// Y_k = Σ_t y_t e^{−2πi k t / n} for k = 0 … n/2, at the frequency k over the record's duration; empty for no samples.
pub fn spectrum(samples: &[f64]) -> Vec<Complex<f64>> {
    if samples.is_empty() {
        return Vec::new();
    }
    let plan = RealFftPlanner::new().plan_fft_forward(samples.len());
    let mut lines = plan.make_output_vec();
    plan.process(&mut samples.to_vec(), &mut lines)
        .expect("buffers of the plan's own lengths");
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One cycle of a cosine about 3: n · 3 at line 0, n/2 at line 1, by hand.
    #[test]
    fn a_cosine_about_a_mean_is_two_lines() {
        let samples: Vec<f64> = (0..8)
            .map(|t| 3.0 + (std::f64::consts::TAU * f64::from(t) / 8.0).cos())
            .collect();
        let lines = spectrum(&samples);
        for (line, expected) in lines.iter().zip([24.0, 4.0, 0.0, 0.0, 0.0]) {
            assert!((line - expected).norm() < 1e-12, "{lines:?}");
        }
        assert!(spectrum(&[]).is_empty());
    }
}
