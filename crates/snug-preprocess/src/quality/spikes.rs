use crate::spread::median;
use std::ops::Range;

/// Widest spike \[samples\].
const WIDEST: usize = 3;

/// Samples on either side whose differences tell the local noise.
const NEIGHBOURHOOD: usize = 50;

/// Median of |x_i − x_{i−1}| for white noise of unit standard deviation: √2 · Φ⁻¹(3/4).
const MEDIAN_ABSOLUTE_DIFFERENCE: f64 = 0.953_872_552_417_469;

/// Replaces spikes by a straight line between their neighbours and says where they were.
///
/// A spike leaves and returns within three samples: the jump into it and the jump out of it have opposite signs and both
/// exceed `threshold_sd` standard deviations of the local sample-to-sample noise. A step (torque released) does not
/// return, so it is none.
pub(crate) fn repair(samples: &mut [f64], threshold_sd: f64) -> Vec<Range<usize>> {
    let candidates = {
        let typical = typical_difference(samples, 0..samples.len());
        (1..samples.len())
            .filter(|&index| (samples[index] - samples[index - 1]).abs() > threshold_sd * typical)
            .collect::<Vec<_>>()
    };
    let mut found: Vec<Range<usize>> = Vec::new();
    for start in candidates {
        if found.last().is_some_and(|spike| start <= spike.end) {
            continue;
        }
        if let Some(end) = spike_end(samples, start, threshold_sd) {
            let (before, after) = (samples[start - 1], samples[end]);
            let steps = (end - start + 1) as f64;
            for (step, sample) in samples[start..end].iter_mut().enumerate() {
                *sample = before + (after - before) * (step + 1) as f64 / steps;
            }
            found.push(start..end);
        }
    }
    found
}

/// One past the spike that begins with the jump into `start`, if it is one.
fn spike_end(samples: &[f64], start: usize, threshold_sd: f64) -> Option<usize> {
    let around = start.saturating_sub(NEIGHBOURHOOD)..(start + NEIGHBOURHOOD).min(samples.len());
    let threshold = threshold_sd * typical_difference(samples, around);
    let jump = samples[start] - samples[start - 1];
    if jump.abs() <= threshold {
        return None;
    }
    (start + 1..=start + WIDEST)
        .take_while(|&end| end < samples.len())
        .find(|&end| {
            let back = samples[end - 1] - samples[end];
            let left = samples[end] - samples[start - 1];
            back * jump.signum() > threshold && left.abs() < 0.5 * jump.abs()
        })
}

/// Standard deviation of the noise from the median absolute difference; infinite where more than half of the samples
/// repeat, because then nothing is known.
fn typical_difference(samples: &[f64], range: Range<usize>) -> f64 {
    let mut differences: Vec<f64> = samples[range]
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .collect();
    let typical = median(&mut differences);
    if typical > 0.0 {
        typical / MEDIAN_ABSOLUTE_DIFFERENCE
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{ONSET, SEGMENT, acceleration, coloured_noise, pulse, white_noise};

    fn measured(seed: u64) -> [Vec<f64>; 2] {
        let torque = pulse(40.0);
        let add = |clean: &[f64], noise: Vec<f64>| -> Vec<f64> {
            clean.iter().zip(noise).map(|(a, b)| a + b).collect()
        };
        [
            add(&torque, white_noise(SEGMENT, 0.02, seed)),
            add(&acceleration(&torque), coloured_noise(SEGMENT, 0.5, seed)),
        ]
    }

    #[test]
    fn clean_channels_have_no_spikes() {
        for seed in 0..20 {
            for mut samples in measured(seed) {
                let before = samples.clone();
                assert!(repair(&mut samples, 12.0).is_empty(), "seed {seed}");
                assert_eq!(samples, before);
            }
        }
        // A torque that is released within one sample is a step, and silence has no noise to compare with.
        let mut step = white_noise(1000, 0.02, 1);
        step[300..600].iter_mut().for_each(|x| *x += 30.0);
        assert!(repair(&mut step, 12.0).is_empty());
        assert!(repair(&mut pulse(30.0), 12.0).is_empty());
    }

    #[test]
    fn spikes_are_found_and_mended() {
        let [mut torque, _] = measured(5);
        let clean = torque.clone();
        torque[500] += 4.0;
        torque[ONSET + 300] -= 6.0;
        torque[ONSET + 301] -= 7.0;
        let spikes = repair(&mut torque, 12.0);
        assert_eq!(spikes, vec![500..501, ONSET + 300..ONSET + 302]);
        for (mended, clean) in torque.iter().zip(&clean) {
            assert!(
                (mended - clean).abs() < 0.15,
                "within the noise of the line's ends"
            );
        }
    }
}
