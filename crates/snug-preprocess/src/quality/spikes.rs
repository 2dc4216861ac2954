//! Mends spikes of one to three samples, except those that the tool's own motion explains.

use super::non_finite::fill;
use crate::noise::spread::median;
use crate::segment::channel::Channel;
use std::cell::OnceCell;
use std::ops::Range;

/// Widest spike \[samples\].
pub(super) const WIDEST: usize = 3;

/// Samples on either side whose differences tell the local noise.
const NEIGHBOURHOOD: usize = 50;

/// Median of |x_i − x_{i−1}| for white noise of unit standard deviation: √2 · Φ⁻¹(3/4).
const MEDIAN_ABSOLUTE_DIFFERENCE: f64 = 0.953_872_552_417_469;

/// Where a channel left its course and came back.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Spikes {
    /// Bridged by straight lines.
    pub(crate) mended: Vec<Range<usize>>,
    /// Left as they are, because the tool may have moved so.
    pub(crate) explained: Vec<Range<usize>>,
}

/// Replaces spikes by a straight line between their neighbours and says where they were, but for those that
/// `explains(index, level before, value, tolerance)` at every sample.
///
/// A spike leaves and returns within three samples: the jump into it and the jump out of it have opposite signs and both
/// exceed `threshold_sd` standard deviations of the local sample-to-sample noise, or as many steps of a channel that mostly repeats because it
/// is coarse; the tolerance is half of that. A step (torque released) does not return, so it is none.
pub(crate) fn repair(
    samples: &mut [f64],
    threshold_sd: f64,
    explains: impl Fn(usize, f64, f64, f64) -> bool,
) -> Spikes {
    let coarse = OnceCell::new();
    let typical = |samples: &[f64], range| match typical_difference(samples, range) {
        typical if typical.is_finite() => typical,
        _ => *coarse.get_or_init(|| resolution(samples)),
    };
    let candidates = {
        let typical = typical(samples, 0..samples.len());
        (1..samples.len())
            .filter(|&index| (samples[index] - samples[index - 1]).abs() > threshold_sd * typical)
            .collect::<Vec<_>>()
    };
    let mut found = Spikes::default();
    let mut behind = 0;
    for start in candidates {
        if start <= behind {
            continue;
        }
        let around =
            start.saturating_sub(NEIGHBOURHOOD)..(start + NEIGHBOURHOOD).min(samples.len());
        let threshold = threshold_sd * typical(samples, around);
        let Some(end) = spike_end(samples, start, threshold) else {
            continue;
        };
        behind = end;
        let before = samples[start - 1];
        let is_explained = |index: usize| explains(index, before, samples[index], 0.5 * threshold);
        if (start..end).all(is_explained) {
            found.explained.push(start..end);
            continue;
        }
        fill(samples, &(start..end));
        found.mended.push(start..end);
    }
    found
}

/// How many there are in a channel and where the first is; `None` where there are none.
pub(crate) fn told(spikes: &[Range<usize>], channel: Channel, interval_s: f64) -> Option<String> {
    let first_s = spikes.first()?.start as f64 * interval_s;
    Some(format!(
        "{} of at most {WIDEST} samples in {}, the first at {first_s:.4} s",
        spikes.len(),
        channel.name()
    ))
}

/// Where a channel jumps by more than `threshold_sd` standard deviations of the differences between neighbours; of one that mostly stays as it
/// is, wherever it changes.
pub(crate) fn jumps(samples: &[f64], threshold_sd: f64) -> Vec<usize> {
    let typical = typical_difference(samples, 0..samples.len());
    let least = match typical.is_finite() {
        true => threshold_sd * typical,
        false => 0.0,
    };
    (1..samples.len())
        .filter(|&index| (samples[index] - samples[index - 1]).abs() > least)
        .collect()
}

/// One past the spike that begins with the jump into `start`, if it is one.
fn spike_end(samples: &[f64], start: usize, threshold: f64) -> Option<usize> {
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

/// Median absolute difference of neighbours that differ: the step of a coarse channel; infinite where none do.
fn resolution(samples: &[f64]) -> f64 {
    let steps = samples.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let mut steps: Vec<f64> = steps.filter(|&step| step > 0.0).collect();
    match steps.is_empty() {
        true => f64::INFINITY,
        false => median(&mut steps),
    }
}

/// Standard deviation of the noise from the median absolute difference; infinite where more than half of the samples
/// repeat, because then nothing is known.
pub(super) fn typical_difference(samples: &[f64], range: Range<usize>) -> f64 {
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
    use crate::quality::free_flight::FreeFlight;
    use crate::tests::synthetic::{
        ONSET, SEGMENT, acceleration, coloured_noise, pulse, white_noise,
    };
    use snug_campaign::Rig;

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

    fn unexplained(samples: &mut [f64]) -> Spikes {
        repair(samples, 12.0, |_, _, _, _| false)
    }

    #[test]
    fn clean_channels_have_no_spikes() {
        for seed in 0..20 {
            for mut samples in measured(seed) {
                let before = samples.clone();
                assert_eq!(unexplained(&mut samples), Spikes::default(), "seed {seed}");
                assert_eq!(samples, before);
            }
        }
        // A torque that is released within one sample is a step, and silence has no noise to compare with.
        let mut step = white_noise(1000, 0.02, 1);
        step[300..600].iter_mut().for_each(|x| *x += 30.0);
        assert_eq!(unexplained(&mut step), Spikes::default());
        assert_eq!(unexplained(&mut pulse(30.0)), Spikes::default());
    }

    #[test]
    fn spikes_are_found_and_mended() {
        let [mut torque, _] = measured(5);
        let clean = torque.clone();
        torque[500] += 4.0;
        torque[ONSET + 300] -= 6.0;
        torque[ONSET + 301] -= 7.0;
        let spikes = unexplained(&mut torque);
        assert_eq!(spikes.mended, vec![500..501, ONSET + 300..ONSET + 302]);
        for (mended, clean) in torque.iter().zip(&clean) {
            assert!(
                (mended - clean).abs() < 0.15,
                "within the noise of the line's ends"
            );
        }
    }

    /// A slow swing of ±0.5 rad by an encoder of 1024 counts a turn repeats itself in most samples.
    #[test]
    fn glitches_of_a_coarse_encoder_are_mended() {
        let count = std::f64::consts::TAU / 1024.0;
        let at = |k: u32| (0.5 * (0.003 * f64::from(k)).sin() / count).round() * count;
        let clean: Vec<f64> = (0..3000).map(at).collect();
        let mut angle = clean.clone();
        assert_eq!(unexplained(&mut angle), Spikes::default());
        angle[520] += 1.1;
        angle[1900..1902].fill(-2.0);
        let spikes = unexplained(&mut angle);
        assert_eq!(spikes.mended, vec![520..521, 1900..1902]);
        for (mended, clean) in angle.iter().zip(&clean) {
            assert!((mended - clean).abs() <= count);
        }
    }

    /// Swinging back at −8 rad/s² with no torque, the tool crosses a gap within two samples, and the hand's force with it;
    /// electrical spikes go the other way, or too far.
    #[test]
    fn free_flight_through_a_gap_is_no_spike() {
        let rig = Rig {
            lever_arm_m: 0.33,
            known_inertia_kg_m2: 0.1,
        };
        let mut measured = white_noise(1000, 0.5, 3);
        let flight = FreeFlight::new(&white_noise(1000, 0.02, 4), rig);
        measured[400..600].iter_mut().for_each(|a| *a -= 9.0);
        measured[500..502].iter_mut().for_each(|a| *a += 9.0);
        measured[450] -= 9.0;
        measured[550] += 27.0;
        let spikes = repair(&mut measured, 8.0, |index, level, value, tolerance| {
            flight.explains(index, level, value, tolerance)
        });
        assert_eq!(spikes.explained, vec![500..502]);
        assert_eq!(spikes.mended, vec![450..451, 550..551]);
    }
}
