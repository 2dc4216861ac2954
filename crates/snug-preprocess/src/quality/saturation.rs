//! Channels at the limit of their range, told from the top of a coarsely quantised peak.

use crate::noise::spread::extremes;

/// Samples pinned at the largest or smallest value of a channel, or at both.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Saturation {
    /// The limiting values, in the channel's unit, the largest first.
    pub(crate) levels: Vec<f64>,
    /// Samples at them.
    pub(crate) samples: usize,
    /// Longest run of successive samples at one of them.
    pub(crate) longest_run: usize,
}

/// An extreme is a limit only if it is reached at least this many times as often as the next value: the rounded top of a
/// coarsely quantised peak holds 1/(√2 − 1) ≈ 2.4 times as many samples as the step below it.
const PILE_UP: usize = 4;

/// Looks for a limit at either end of the signal, and at both.
///
/// Sought are runs of at least `shortest_run` successive samples at exactly the extreme, where the extreme is at least
/// half of the largest absolute value (so that a channel at rest at zero does not count).
pub(crate) fn find(samples: &[f64], shortest_run: usize) -> Option<Saturation> {
    let [smallest, largest] = extremes(samples);
    let reach = largest.max(-smallest);
    if largest <= smallest {
        return None;
    }
    [(largest, 1.0), (smallest, -1.0)]
        .into_iter()
        .filter(|(level, sign)| level * sign >= 0.5 * reach)
        .filter_map(|(level, sign)| at_level(samples, level, sign))
        .filter(|found| found.longest_run >= shortest_run)
        .reduce(|one, other| Saturation {
            levels: [one.levels, other.levels].concat(),
            samples: one.samples + other.samples,
            longest_run: one.longest_run.max(other.longest_run),
        })
}

/// Counts at the extreme `level`; `None` when the next value is nearly as frequent.
fn at_level(samples: &[f64], level: f64, sign: f64) -> Option<Saturation> {
    let (mut count, mut run, mut longest_run) = (0, 0, 0);
    let mut next = f64::NEG_INFINITY;
    for &sample in samples {
        if sample == level {
            count += 1;
            run += 1;
            longest_run = longest_run.max(run);
        } else {
            run = 0;
            next = next.max(sample * sign);
        }
    }
    let beside = samples
        .iter()
        .filter(|&&sample| sample * sign == next)
        .count();
    (count >= PILE_UP * beside).then_some(Saturation {
        levels: vec![level],
        samples: count,
        longest_run,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{SEGMENT, pulse, white_noise};

    fn noisy_pulse(seed: u64) -> Vec<f64> {
        let noise = white_noise(SEGMENT, 0.02, seed);
        pulse(30.0).iter().zip(noise).map(|(a, b)| a + b).collect()
    }

    #[test]
    fn clipping_is_found_on_either_side() {
        for seed in 0..10 {
            let clipped: Vec<f64> = noisy_pulse(seed).iter().map(|x| x.min(28.0)).collect();
            let found = find(&clipped, 5).expect("clipped at 28");
            assert_eq!(found.levels, [28.0]);
            // 28 of 30 Nm: above it for 2/30 of the rise (800) and of the fall (120).
            assert!((55..=67).contains(&found.samples), "{found:?}");
            let inverted: Vec<f64> = clipped.iter().map(|x| -x).collect();
            assert_eq!(find(&inverted, 5).map(|s| s.levels), Some(vec![-28.0]));
        }
    }

    #[test]
    fn what_is_cut_off_at_both_ends_counts_at_both() {
        let swings = |index: usize| 40.0 * (0.01 * index as f64).sin();
        let cut: Vec<f64> = (0..6000)
            .map(|index| swings(index).clamp(-28.0, 30.0))
            .collect();
        let found = find(&cut, 5).expect("cut off");
        assert_eq!(found.levels, [30.0, -28.0]);
        let at_either = cut.iter().filter(|&&one| one == 30.0 || one == -28.0);
        assert_eq!(found.samples, at_either.count());
    }

    #[test]
    fn clean_and_quantised_pulses_are_not_clipped() {
        for seed in 0..20 {
            let clean = noisy_pulse(seed);
            assert_eq!(find(&clean, 5), None);
            for step in [0.01, 0.1, 0.5] {
                let quantised: Vec<f64> = clean.iter().map(|x| (x / step).round() * step).collect();
                assert_eq!(find(&quantised, 5), None, "step {step}");
            }
        }
        let rounded: Vec<f64> = (0..3000)
            .map(|i| (40.0 - ((f64::from(i) - 1500.3) / 200.0).powi(2)).round())
            .collect();
        assert_eq!(find(&rounded, 5), None, "a smooth top on a coarse grid");
        assert_eq!(find(&[0.0; 100], 5), None);
    }
}
