//! The noise of a signal that is smooth or straight over most neighbouring samples.

/// Standard deviation of a normal variable over the median of its size.
const NORMAL_OVER_MEDIAN: f64 = 1.482_602_218_505_602;

/// Standard deviation of the white noise of single samples: from the median of |y(i − 1) − 2 y(i) + y(i + 1)|, which a signal
/// without noise hardly moves, and whose variance is six times the noise's; 0 for fewer than three samples.
pub fn white_noise_level(samples: &[f64]) -> f64 {
    let mut bends: Vec<f64> = (samples.windows(3))
        .map(|y| (y[0] - 2.0 * y[1] + y[2]).abs())
        .collect();
    if bends.is_empty() {
        return 0.0;
    }
    let middle = bends.len() / 2;
    let (_, median, _) = bends.select_nth_unstable_by(middle, f64::total_cmp);
    NORMAL_OVER_MEDIAN * *median / 6.0_f64.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp with alternating errors ±e has second differences ∓4e throughout: 1.4826 · 4 e/√6 by hand.
    #[test]
    fn what_is_straight_is_no_noise() {
        let ramp = |error: f64| -> Vec<f64> {
            (0..99)
                .map(|i| 3.0 * f64::from(i) + error * (-1.0_f64).powi(i))
                .collect()
        };
        assert!(white_noise_level(&ramp(0.0)) < 1e-12);
        let expected = 1.482_602_218_505_602 * 4.0 * 0.5 / 6.0_f64.sqrt();
        assert!((white_noise_level(&ramp(0.5)) / expected - 1.0).abs() < 1e-12);
        assert_eq!(white_noise_level(&[1.0, 5.0]), 0.0);
    }
}
