//! The quiet part before the pulse: which samples it has, and whether a channel is at rest in them.

pub(crate) mod bias;
pub(crate) mod measurement;

use crate::noise::autoregression::Autoregression;
use crate::settings::quiet::QuietSettings;
use std::ops::Range;

/// Samples of the quiet part: from the last long gap to the guard before the onset, at most to the window's start.
///
/// `None` when fewer than `minimum` remain.
pub(crate) fn part(
    after_gap: usize,
    window_start: usize,
    onset: usize,
    guard: usize,
    minimum: usize,
) -> Option<Range<usize>> {
    let end = window_start.min(onset.saturating_sub(guard));
    (end >= after_gap + minimum.max(1)).then_some(after_gap..end)
}

/// How a channel that should only show noise moves in the quiet part.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Unsteadiness {
    /// Means of the four quarters, in the channel's unit.
    pub(crate) means: [f64; QUARTERS],
    /// Standard deviations of the four quarters.
    pub(crate) deviations: [f64; QUARTERS],
    /// Largest deviation of a quarter's mean from the whole, in standard errors.
    pub(crate) largest_z: f64,
}

const QUARTERS: usize = 4;

/// Ratio of the quarters' variances above which the noise is not the same throughout.
const VARIANCE_RATIO: f64 = 2.0;

/// Samples per quarter below which their variances scatter too much to be compared.
const QUARTER_MINIMUM: usize = 500;

/// Asks whether a channel is at rest in the quiet part: quarters alike in mean and variance.
///
/// The yardstick is the quarter with the smallest variance, so that a disturbance does not excuse itself. `None` when the
/// channel is at rest (or constant).
pub(crate) fn unsteadiness(quiet: &[f64], settings: &QuietSettings) -> Option<Unsteadiness> {
    let length = quiet.len() / QUARTERS;
    if length < QUARTER_MINIMUM {
        return None;
    }
    let total = length * QUARTERS;
    let whole = quiet[..total].iter().sum::<f64>() / total as f64;
    let mut means = [0.0; QUARTERS];
    let mut deviations = [0.0; QUARTERS];
    for (quarter, samples) in quiet.chunks_exact(length).take(QUARTERS).enumerate() {
        means[quarter] = samples.iter().sum::<f64>() / length as f64;
        let squares: f64 = samples.iter().map(|x| (x - means[quarter]).powi(2)).sum();
        deviations[quarter] = (squares / (length - 1) as f64).sqrt();
    }
    let calmest = (0..QUARTERS).min_by(|&a, &b| deviations[a].total_cmp(&deviations[b]))?;
    let yardstick = Autoregression::fit(
        &quiet[calmest * length..(calmest + 1) * length],
        settings.maximum_order,
    )?;
    let error = yardstick.standard_error_of_mean(length);
    let largest_z = means
        .iter()
        .map(|mean| (mean - whole).abs() / error)
        .fold(0.0, f64::max);
    let largest_deviation = deviations.iter().copied().fold(0.0, f64::max);
    let louder = largest_deviation.powi(2) > VARIANCE_RATIO * deviations[calmest].powi(2);
    (largest_z > settings.drift || louder).then_some(Unsteadiness {
        means,
        deviations,
        largest_z,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{coloured_noise, white_noise};

    #[test]
    fn ends_before_whichever_comes_first() {
        assert_eq!(part(0, 14_800, 14_810, 50, 1000), Some(0..14_760));
        assert_eq!(part(0, 14_800, 15_000, 50, 1000), Some(0..14_800));
        assert_eq!(part(300, 14_800, 15_000, 50, 1000), Some(300..14_800));
        assert_eq!(part(0, 14_800, 900, 50, 1000), None);
        assert_eq!(part(0, 0, 15_000, 50, 0), None);
    }

    #[test]
    fn noise_alone_is_steady() {
        let settings = QuietSettings::default();
        for seed in 0..100 {
            let noise = coloured_noise(14_800, 0.5, seed);
            assert_eq!(unsteadiness(&noise, &settings), None, "seed {seed}");
        }
        assert_eq!(unsteadiness(&[0.0; 14_800], &settings), None);
    }

    #[test]
    fn drift_and_a_rumble_are_not_steady() {
        let settings = QuietSettings::default();
        let mut drifting = coloured_noise(14_800, 0.5, 3);
        let mut rumbling = white_noise(14_800, 0.5, 4);
        for index in 0..14_800 {
            drifting[index] += 0.4 * index as f64 / 14_800.0;
            if index > 12_000 {
                rumbling[index] += 2.0 * (0.05 * index as f64).sin();
            }
        }
        let drift = unsteadiness(&drifting, &settings).expect("a drift of 0.4 over the part");
        assert!(drift.largest_z > settings.drift);
        assert!(
            drift.means[3] - drift.means[0] > 0.2,
            "three quarters of the drift apart"
        );
        assert!(unsteadiness(&rumbling, &settings).is_some());
    }
}
