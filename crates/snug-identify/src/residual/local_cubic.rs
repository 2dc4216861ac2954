//! The cubic nearest to the samples around one: where a motion is, and how fast, though it is measured with noise.

/// Value and rate, at one `place` of a few samples, of the cubic that fits those best.
pub(crate) fn cubic_at(samples: &[f64], interval_s: f64, place: usize) -> [f64; 2] {
    LocalCubic::fit(samples, place, samples.len()).over(interval_s)
}

/// Those of every `apart`th sample, over `half_width` on either side.
pub(crate) fn local_cubics(measured: &[f64], apart: usize, half_width: usize) -> Vec<LocalCubic> {
    let places = (0..measured.len()).step_by(apart.max(1));
    let of_one = |place| LocalCubic::fit(measured, place, half_width);
    places.map(of_one).collect()
}

/// The cubic through the samples around one, by least squares.
pub(crate) struct LocalCubic {
    /// Value, and slope per sample.
    pub motion: [f64; 2],
    /// Variance of these two, over that of white noise \[–\].
    pub of_noise: [f64; 2],
    /// Of the residual.
    pub variance: f64,
}

impl LocalCubic {
    /// Value and rate of samples so far apart.
    pub fn over(&self, interval_s: f64) -> [f64; 2] {
        let [value, slope] = self.motion;
        [value, slope / interval_s]
    }

    /// Over `half_width` samples on either side of `place`, as far as there are.
    pub fn fit(measured: &[f64], place: usize, half_width: usize) -> Self {
        let first = place.saturating_sub(half_width);
        let some = &measured[first..(place + half_width + 1).min(measured.len())];
        let unit = half_width as f64;
        let at = |index: usize| (first + index) as f64 / unit - place as f64 / unit;
        // Gram–Schmidt over the samples; each polynomial keeps its value and slope at the place.
        let mut basis: Vec<(Vec<f64>, f64, f64)> = Vec::new();
        for power in 0..=3_i32.min(some.len() as i32 - 1) {
            let mut values: Vec<f64> = (0..some.len()).map(|i| at(i).powi(power)).collect();
            let (mut value, mut slope) = (f64::from(power == 0), f64::from(power == 1));
            for (known, known_value, known_slope) in &basis {
                let along: f64 = known.iter().zip(&values).map(|(a, b)| a * b).sum();
                values
                    .iter_mut()
                    .zip(known)
                    .for_each(|(v, k)| *v -= along * k);
                value -= along * known_value;
                slope -= along * known_slope;
            }
            let length = values.iter().map(|v| v * v).sum::<f64>().sqrt();
            values.iter_mut().for_each(|v| *v /= length);
            basis.push((values, value / length, slope / length));
        }
        let mut rest = some.to_vec();
        let (mut value, mut slope) = (0.0, 0.0);
        let mut of_noise = [0.0; 2];
        for (known, known_value, known_slope) in &basis {
            of_noise[0] += known_value * known_value;
            of_noise[1] += (known_slope / unit).powi(2);
            let along: f64 = known.iter().zip(&rest).map(|(a, b)| a * b).sum();
            rest.iter_mut()
                .zip(known)
                .for_each(|(v, k)| *v -= along * k);
            value += along * known_value;
            slope += along * known_slope;
        }
        let freedom = some.len().saturating_sub(basis.len()).max(1) as f64;
        Self {
            motion: [value, slope / unit],
            of_noise,
            variance: rest.iter().map(|r| r * r).sum::<f64>() / freedom,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_found_exactly_in_the_middle_and_at_the_ends() {
        let x = |t: f64| 0.3 - 0.2 * t + 0.01 * t * t - 2e-4 * t * t * t;
        let slope = |t: f64| -0.2 + 0.02 * t - 6e-4 * t * t;
        let samples: Vec<f64> = (0..40).map(|t| x(f64::from(t))).collect();
        for place in [0_usize, 1, 20, 39] {
            let local = LocalCubic::fit(&samples, place, 8);
            let ([value, rate], t) = (local.motion, place as f64);
            assert!((value - x(t)).abs() < 1e-10 && (rate - slope(t)).abs() < 1e-10);
            assert!(local.variance < 1e-18);
        }
    }
}
