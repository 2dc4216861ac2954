//! The slope of a noisy signal with kinks: long fits where it is smooth, short ones where it turns.
//!
//! A lag of several milliseconds multiplies the slope of the logged torque, and with it the slope's noise. The slope at a
//! sample is that of the cubic that fits the samples within a reach on either side best (Savitzky & Golay 1964); its
//! standard error falls with the reach to the power of 3/2, its bias grows where the signal turns. The reach grows as
//! long as the slopes of all shorter reaches agree with it within their errors (intersection of confidence intervals:
//! Goldenshluger & Nemirovski 1997; Katkovnik 1999).
//! At its ends the signal is taken to go on as it came, reflected in its end points.

use snug_signal::white_noise_level;

/// Reaches on either side \[s\], shortest first: a shut-off takes longer than the shortest, a ramp as long as the longest.
const REACHES_S: [f64; 8] = [1.8e-3, 2.5e-3, 3.5e-3, 5e-3, 7e-3, 10e-3, 14e-3, 20e-3];
/// The fewest samples on either side.
const LEAST_REACH: usize = 5;
/// The most weights of one fit.
const MOST_WEIGHTS: usize = 25;
/// Standard errors within which slopes agree.
const AGREEMENT: f64 = 2.5;

/// Slope at every one of `values`, `interval_s` apart and `substeps` to a sample, per second.
pub(crate) fn slopes(values: &[f64], interval_s: f64, substeps: usize) -> Vec<f64> {
    if values.len() < 3 {
        return vec![0.0; values.len()];
    }
    let reaches = REACHES_S.map(|reach_s| (reach_s / interval_s).round() as usize);
    let reaches = reaches.map(|reach| reach.max(LEAST_REACH * substeps).min(values.len() - 1));
    let fits = reaches.map(SlopeFit::over);
    let samples: Vec<f64> = values.iter().copied().step_by(substeps).collect();
    let noise = white_noise_level(&samples) * (substeps as f64).sqrt();
    let longest = reaches[reaches.len() - 1];
    let sums = sums(&continued(values, longest));
    (longest..longest + values.len())
        .map(|index| slope_within(&fits, &sums, index, noise) / interval_s)
        .collect()
}

/// The values with `more` before and after them, by reflection in the points at the ends: as if it went on as it came.
fn continued(values: &[f64], more: usize) -> Vec<f64> {
    let last = values.len() - 1;
    let before = (1..=more).rev().map(|j| 2.0 * values[0] - values[j]);
    let after = (1..=more).map(|j| 2.0 * values[last] - values[last - j]);
    before.chain(values.iter().copied()).chain(after).collect()
}

/// The slope over the longest but one reach that agrees with all shorter ones: what bends a slope by as much as its error
/// is not seen, and the same bend over a shorter reach is less.
fn slope_within(shortest_first: &[SlopeFit], sums: &[f64], index: usize, noise: f64) -> f64 {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut shorter, mut longest) = (None, None);
    for fit in shortest_first {
        let slope = fit.at(sums, index);
        let error = AGREEMENT * noise * fit.error;
        low = low.max(slope - error);
        high = high.min(slope + error);
        if low > high {
            break;
        }
        (shorter, longest) = (longest, Some(slope));
    }
    shorter.or(longest).unwrap_or(0.0)
}

/// The slope of the best cubic over a reach on either side, as a sum over differences of what stands opposite.
///
/// Over long reaches neighbours share a weight: hardly less sure, and as quick as a short reach.
struct SlopeFit {
    /// Values that share a weight.
    together: usize,
    /// Weights of the differences, nearest first.
    weights: Vec<f64>,
    /// Standard error of the slope where the values' is 1.
    error: f64,
}

impl SlopeFit {
    /// Weights wᵦ of least Σ wᵦ² for which j has the slope 1 and j³ the slope 0: with Mₙ the sum of jⁿ over those that
    /// share a weight, wᵦ = (M₁ Σ M₃² − M₃ Σ M₁M₃)/(2 (Σ M₁² Σ M₃² − (Σ M₁M₃)²)).
    fn over(reach: usize) -> Self {
        let together = reach.div_ceil(MOST_WEIGHTS).max(1);
        let moment = |group: usize, power: i32| -> f64 {
            let members = group * together + 1..=(group + 1) * together;
            members.map(|j| (j as f64).powi(power)).sum()
        };
        let moments: Vec<[f64; 2]> = (0..reach / together)
            .map(|group| [moment(group, 1), moment(group, 3)])
            .collect();
        let sum = |a: usize, b: usize| moments.iter().map(|m| m[a] * m[b]).sum::<f64>();
        let (s11, s13, s33) = (sum(0, 0), sum(0, 1), sum(1, 1));
        let determinant = 2.0 * (s11 * s33 - s13 * s13);
        let weight = |m: &[f64; 2]| (m[0] * s33 - m[1] * s13) / determinant;
        let weights: Vec<f64> = moments.iter().map(weight).collect();
        let power: f64 = weights.iter().map(|w| w * w).sum();
        Self {
            together,
            error: (2.0 * together as f64 * power).sqrt(),
            weights,
        }
    }

    /// Per interval, at an index that has the reach on either side; `sums` are those of all values before an index.
    fn at(&self, sums: &[f64], index: usize) -> f64 {
        let (mut slope, mut after, mut before) = (0.0, index + 1, index);
        for weight in &self.weights {
            let (farther_after, farther_before) = (after + self.together, before - self.together);
            let difference =
                sums[farther_after] - sums[after] - sums[before] + sums[farther_before];
            slope += weight * difference;
            (after, before) = (farther_after, farther_before);
        }
        slope
    }
}

/// Sums of all values before each, and of all.
pub(crate) fn sums(values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let all = values.iter().map(|value| {
        sum += value;
        sum
    });
    std::iter::once(0.0).chain(all).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::even_noise::even_noise;

    fn root_mean_square(values: &[f64]) -> f64 {
        (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
    }

    #[test]
    fn slopes_of_a_cubic_are_exact() {
        let cubic: Vec<f64> = (0..900).map(|i| (1e-3 * f64::from(i)).powi(3)).collect();
        let found = slopes(&cubic, 1e-3, 1);
        for (i, slope) in found.iter().enumerate().take(880).skip(20) {
            let expected = 3.0 * (1e-3 * i as f64).powi(2);
            assert!((slope - expected).abs() < 1e-10, "{i}: {slope} {expected}");
        }
    }

    #[test]
    fn the_shortest_reach_is_the_published_one_and_its_error_what_noise_makes() {
        // Savitzky & Golay 1964, table for 11 points: (300, −294, −532, −503, −296, 0, …)/5148.
        let table = [296.0, 503.0, 532.0, 294.0, -300.0].map(|c: f64| c / 5148.0);
        let fit = SlopeFit::over(5);
        for (weight, expected) in fit.weights.iter().zip(table) {
            assert!((weight - expected).abs() < 1e-14, "{weight} {expected}");
        }
        let values = even_noise(20_000);
        let sums = sums(&values);
        let found: Vec<f64> = (5..19_995).map(|i| fit.at(&sums, i)).collect();
        assert!((root_mean_square(&found) / fit.error - 1.0).abs() < 0.05);
        assert!((white_noise_level(&values) - 1.0).abs() < 0.1);
    }

    /// A ramp of 700 Nm/s that ends in a kink, with a noise of 0.02 Nm at 10 kHz: far from the kink the slope is as sure as
    /// a cubic over 14 ms on either side makes it, at the kink it turns within the shortest reach.
    #[test]
    fn a_slope_is_sure_where_the_signal_is_smooth_and_quick_where_it_turns() {
        let ramp = |i: usize| 0.07 * i.min(2000) as f64;
        let values: Vec<f64> = (even_noise(4000).iter().enumerate())
            .map(|(i, noise)| ramp(i) + 0.02 * noise)
            .collect();
        let found = slopes(&values, 1e-4, 1);
        let error = |from: usize, to: usize, slope: f64| {
            let errors: Vec<f64> = found[from..to].iter().map(|s| s - slope).collect();
            root_mean_square(&errors)
        };
        // √(75/281³) · 0.02/1e-4 = 0.37 Nm/s over 14 ms; 4.8 Nm/s over 2.5 ms.
        assert!(error(250, 1750, 700.0) < 0.8, "{}", error(250, 1750, 700.0));
        assert!(error(2250, 3750, 0.0) < 0.8, "{}", error(2250, 3750, 0.0));
        assert!(
            error(1950, 1980, 700.0) < 25.0,
            "{}",
            error(1950, 1980, 700.0)
        );
        assert!(error(2020, 2050, 0.0) < 25.0, "{}", error(2020, 2050, 0.0));
    }

    #[test]
    fn few_values_have_slopes_too() {
        assert_eq!(slopes(&[], 0.1, 1), [0.0; 0]);
        assert_eq!(slopes(&[1.0, 2.0], 0.1, 1), [0.0; 2]);
        for slope in slopes(&[0.0, 1.0, 2.0, 3.0], 0.1, 1) {
            assert!((slope - 10.0).abs() < 1e-12, "{slope}");
        }
    }
}
