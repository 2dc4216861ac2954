//! Median and median absolute deviation: location and scale that a pulse or a few outliers do not move.

/// Ratio of standard deviation to median absolute deviation of a normal distribution, 1/Φ⁻¹(3/4).
pub(crate) const NORMAL_CONSISTENCY: f64 = 1.482_602_218_505_602;

/// Median (upper one for an even count); 0 for no values. The values must be finite.
pub(crate) fn median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Smallest and largest value; ∞ and −∞ of no values.
pub(crate) fn extremes(values: &[f64]) -> [f64; 2] {
    [
        values.iter().copied().fold(f64::INFINITY, f64::min),
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Median and robust standard deviation of finite samples.
///
/// Where more than half of the samples coincide (coarse quantisation) the median absolute deviation is 0; the
/// deviation then comes from the successive differences, which a slow pulse hardly enters.
pub(crate) fn location_and_scale(samples: &[f64]) -> (f64, f64) {
    let mut values = samples.to_vec();
    let location = median(&mut values);
    for value in &mut values {
        *value = (*value - location).abs();
    }
    let scale = NORMAL_CONSISTENCY * median(&mut values);
    if scale > 0.0 {
        (location, scale)
    } else {
        (location, difference_scale(samples))
    }
}

/// Standard deviation of white noise from its successive differences, √(mean (x_i − x_{i−1})² / 2).
pub(crate) fn difference_scale(samples: &[f64]) -> f64 {
    if samples.len() < 2 {
        return 0.0;
    }
    let sum: f64 = samples
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).powi(2))
        .sum();
    (sum / (2.0 * (samples.len() - 1) as f64)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outliers_do_not_move_it() {
        let mut samples: Vec<f64> = (0..101).map(|i| f64::from(i) / 100.0).collect();
        let clean = location_and_scale(&samples);
        samples[3] = 1e9;
        let spoilt = location_and_scale(&samples);
        assert_eq!(clean.0, 0.5);
        assert!((clean.1 - NORMAL_CONSISTENCY * 0.25).abs() < 0.02);
        assert!((spoilt.0 - clean.0).abs() < 0.02 && (spoilt.1 - clean.1).abs() < 0.05);
    }

    #[test]
    fn coarse_quantisation_still_has_a_scale() {
        let samples: Vec<f64> = (0..100).map(|i| f64::from(u8::from(i % 10 == 0))).collect();
        assert!(location_and_scale(&samples).1 > 0.2);
        assert_eq!(location_and_scale(&[2.0; 50]), (2.0, 0.0));
    }
}
