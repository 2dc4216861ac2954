//! Dropouts: runs of one repeated value, longer than quantised noise repeats itself by chance.

use crate::segment::channel::Channel;
use std::ops::Range;

/// A channel that freezes for at least this share of its samples is quantised or free of noise: nothing can be said.
const FROZEN_RATIO: f64 = 0.5;

/// A run must be this many times as long as the longest that chance would give.
const CHANCE_FACTOR: f64 = 3.0;

/// Runs of identical successive samples in a channel that otherwise changes: dropouts, lost packets.
///
/// Chance repeats neighbours of a quantised channel with some probability p, and its longest run over n samples is about
/// ln n / ln(1/p); a run counts from three times that on, and never below `shortest` samples. Samples at `limits` (a known
/// saturation) are passed over.
pub(crate) fn find(samples: &[f64], shortest: usize, limits: &[f64]) -> Vec<Range<usize>> {
    let runs = runs_of_identical(samples, shortest.max(2));
    let frozen: usize = runs.iter().map(Range::len).sum();
    if frozen as f64 > FROZEN_RATIO * samples.len() as f64 {
        return Vec::new();
    }
    let repeats = samples.windows(2).filter(|pair| pair[0] == pair[1]).count();
    let by_runs: usize = runs.iter().map(|run| run.len() - 1).sum();
    let others = (samples.len().saturating_sub(frozen)).max(1) as f64;
    let chance = (repeats - by_runs) as f64 / others;
    let longest_by_chance = if chance > 0.0 {
        CHANCE_FACTOR * (samples.len() as f64).ln() / -chance.min(0.999).ln()
    } else {
        0.0
    };
    runs.into_iter()
        .filter(|run| run.len() as f64 > longest_by_chance)
        .filter(|run| !limits.contains(&samples[run.start]))
        .collect()
}

/// The runs of a channel in words, the first with its length and place; `None` where there are none.
pub(crate) fn told(runs: &[Range<usize>], channel: Channel, interval_s: f64) -> Option<String> {
    let (first, others) = runs.split_first()?;
    let more = match others.len() {
        0 => String::new(),
        more => format!(", the first of {} such stretches,", more + 1),
    };
    Some(format!(
        "{} repeats one value for {} samples from {:.4} s on{more}",
        channel.name(),
        first.len(),
        first.start as f64 * interval_s,
    ))
}

fn runs_of_identical(samples: &[f64], shortest: usize) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let mut start = 0;
    for index in 1..=samples.len() {
        if index == samples.len() || samples[index] != samples[start] {
            if index - start >= shortest {
                runs.push(start..index);
            }
            start = index;
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{coloured_noise, white_noise};

    #[test]
    fn a_frozen_stretch_is_found() {
        let mut samples = coloured_noise(18_000, 0.5, 1);
        let held = samples[15_000];
        samples[15_000..15_040].fill(held);
        samples[16_000..16_030].fill(0.0);
        assert_eq!(
            find(&samples, 20, &[]),
            vec![15_000..15_040, 16_000..16_030]
        );
        assert_eq!(find(&samples, 20, &[0.0]), vec![15_000..15_040]);
    }

    #[test]
    fn several_are_counted_and_one_is_not() {
        let channel = Channel::GripForce;
        let both = [4..7, 9..20];
        let said = |runs: &[Range<usize>]| told(runs, channel, 0.5);
        let one = format!(
            "{} repeats one value for 3 samples from 2.0000 s on",
            channel.name()
        );
        assert_eq!(said(&both[..1]), Some(one.clone()));
        let two = format!("{one}, the first of 2 such stretches,");
        assert_eq!(said(&both), Some(two));
        assert_eq!(said(&[]), None);
    }

    #[test]
    fn quantised_noise_and_silence_are_not_frozen() {
        for seed in 0..20 {
            let noise = white_noise(18_000, 0.02, seed);
            assert!(find(&noise, 20, &[]).is_empty());
            for step in [0.02, 0.05, 0.08] {
                let quantised: Vec<f64> = noise.iter().map(|x| (x / step).round() * step).collect();
                assert!(find(&quantised, 20, &[]).is_empty(), "step {step}");
            }
        }
        assert!(find(&[0.0; 500], 20, &[]).is_empty());
        assert!(find(&[], 20, &[]).is_empty());
    }
}
