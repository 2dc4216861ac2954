//! The pulses of a torque and the sample at which one begins, which for a slow rise lies well before the threshold.

use crate::noise::spread::{difference_scale, location_and_scale};
use crate::settings::onset::{END_RATIO, OnsetSettings};
use std::ops::Range;

/// The torque before the pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Baseline {
    /// Level at rest \[Nm\].
    pub(crate) level_nm: f64,
    /// Standard deviation of the noise \[Nm\].
    pub(crate) sd_nm: f64,
}

/// Fewest samples that a baseline is taken from.
const BASELINE_MINIMUM: usize = 20;

impl Baseline {
    /// Median and robust deviation of what comes before `end`; without enough of it, level 0 and the noise of the
    /// sample-to-sample differences.
    pub(crate) fn of(torque_nm: &[f64], end: usize) -> Self {
        let end = end.min(torque_nm.len());
        let (level_nm, sd_nm) = if end >= BASELINE_MINIMUM {
            location_and_scale(&torque_nm[..end])
        } else {
            (0.0, difference_scale(torque_nm))
        };
        Self { level_nm, sd_nm }
    }
}

/// One torque pulse of a segment.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pulse {
    /// From where it has risen by `second_pulse_ratio` of the peak to where it has fallen to a tenth of it, or to where
    /// the next pulse rises.
    pub(crate) range: Range<usize>,
    /// Its highest sample.
    pub(crate) peak: usize,
}

/// Every pulse, in order: a maximum that the torque rises to and falls from by `second_pulse_ratio` of the greatest
/// height above the baseline. A shallower dip, as between the steps of one tightening, divides nothing.
pub(crate) fn pulses(
    torque_nm: &[f64],
    baseline: Baseline,
    settings: &OnsetSettings,
) -> Vec<Pulse> {
    let highest = torque_nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let height = highest - baseline.level_nm;
    if height <= 0.0 {
        return Vec::new();
    }
    let stroke = settings.second_pulse_ratio * height;
    let mut found: Vec<Pulse> = Vec::new();
    let mut valley_nm = baseline.level_nm;
    let mut rising: Option<(usize, usize)> = None;
    for (index, &torque) in torque_nm.iter().enumerate() {
        rising = match rising {
            // Back from an undershoot to the level at rest is no pulse.
            None if torque >= valley_nm.max(baseline.level_nm) + stroke => Some((index, index)),
            None => {
                valley_nm = valley_nm.min(torque);
                None
            }
            Some((start, peak)) if torque_nm[peak] - torque >= stroke => {
                found.push(pulse(torque_nm, baseline, height, (start, peak)));
                valley_nm = torque;
                None
            }
            Some((start, peak)) if torque > torque_nm[peak] => Some((start, index)),
            unchanged => unchanged,
        };
    }
    found.extend(rising.map(|rise| pulse(torque_nm, baseline, height, rise)));
    for index in 1..found.len() {
        let next = found[index].range.start;
        found[index - 1].range.end = found[index - 1].range.end.min(next);
    }
    found
}

/// The pulse that passed its stroke at `start` and is highest at `peak`.
fn pulse(
    torque_nm: &[f64],
    baseline: Baseline,
    height_nm: f64,
    (start, peak): (usize, usize),
) -> Pulse {
    let ends = baseline.level_nm + END_RATIO * height_nm;
    let fall = torque_nm[peak..]
        .iter()
        .take_while(|&&torque| torque > ends);
    Pulse {
        range: start..peak + fall.count(),
        peak,
    }
}

/// First sample of the pulse: just after the torque last stayed for `hold` samples at or below the threshold.
///
/// Searched backwards from the pulse, so that a disturbance earlier in the segment is not taken for it. The threshold is
/// `threshold_sd` standard deviations or `threshold_peak_ratio` of the height above the baseline, whichever is larger.
/// From there the rise is followed back to the baseline. 0 when the torque never was at rest.
pub(crate) fn onset(
    torque_nm: &[f64],
    baseline: Baseline,
    pulse: &Pulse,
    settings: &OnsetSettings,
    hold: usize,
) -> usize {
    let height = torque_nm[pulse.peak] - baseline.level_nm;
    let threshold = baseline.level_nm
        + (settings.threshold_sd * baseline.sd_nm).max(settings.threshold_peak_ratio * height);
    let hold = hold.max(1);
    let mut below = 0;
    for index in (0..pulse.range.start).rev() {
        below = if torque_nm[index] > threshold {
            0
        } else {
            below + 1
        };
        if below == hold {
            return back_to_rest(torque_nm, baseline, index + hold, hold);
        }
    }
    below
}

/// Where the rise that passes the threshold at `crossing` left the baseline: a slow rise passes it long after it began.
///
/// T = baseline + s (t − t_0)^p with s > 0 is fitted to the `10 hold` samples before and the `2 hold` after the crossing,
/// and t_0 is where the squares are least. p is 1, or 0 (a step) or 2 (a smooth
/// beginning) where that fits better beyond chance.
fn back_to_rest(torque_nm: &[f64], baseline: Baseline, crossing: usize, hold: usize) -> usize {
    let first = crossing.saturating_sub(10 * hold);
    let after = (crossing + 2 * hold).min(torque_nm.len());
    let rise: Vec<f64> = torque_nm[first..after]
        .iter()
        .map(|torque| torque - baseline.level_nm)
        .collect();
    // What the best rise explains of Σ T², and the sample on which it begins.
    let best = |power: i32| {
        let begun = (0..=crossing - first).map(|start| (explained(&rise[start..], power), start));
        begun.fold((0.0, crossing - first), |best, one| {
            if one.0 > best.0 { one } else { best }
        })
    };
    let mut found = best(1);
    let beyond_chance = CHANCE * baseline.sd_nm * baseline.sd_nm;
    for power in [0, 2] {
        let other = best(power);
        if other.0 > found.0 + beyond_chance {
            found = other;
        }
    }
    let (_, start) = found;
    first + start
}

/// Squared deviations by which another rise than the straight one must fit better: two standard deviations.
const CHANCE: f64 = 4.0;

/// Σ T² that s i^p explains, i counting from the first sample; none where the rise would fall.
fn explained(rise: &[f64], power: i32) -> f64 {
    let (mut along, mut squares) = (0.0, 0.0);
    for (index, torque) in rise.iter().enumerate() {
        let shape = (index as f64).powi(power);
        along += shape * torque;
        squares += shape * shape;
    }
    if along > 0.0 {
        along * along / squares
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{ONSET, PEAK, pulse, white_noise};

    fn noisy(seed: u64) -> Vec<f64> {
        let noise = white_noise(20_000, 0.02, seed);
        pulse(30.0).iter().zip(noise).map(|(a, b)| a + b).collect()
    }

    fn find(torque: &[f64]) -> (Vec<Pulse>, usize) {
        let settings = OnsetSettings::default();
        let baseline = Baseline::of(torque, 14_750);
        let pulses = pulses(torque, baseline, &settings);
        let onset = onset(torque, baseline, &pulses[0], &settings, 10);
        (pulses, onset)
    }

    #[test]
    fn finds_the_onset_where_the_rise_begins() {
        // 30 Nm in 800 samples: 0.0375 Nm per sample, so 0.1 Nm (5 standard deviations) is passed 3 samples after the onset.
        for seed in 0..50 {
            let (pulses, onset) = find(&noisy(seed));
            assert_eq!(pulses.len(), 1);
            assert!(pulses[0].peak.abs_diff(PEAK) <= 3);
            assert!(onset.abs_diff(ONSET) <= 2, "{onset}");
        }
    }

    /// Where a torque is said to begin that rises as given, so many samples after the 500th, in noise of 0.02 Nm.
    fn begun(rise_nm: impl Fn(usize) -> f64, crossing: usize, seed: u64) -> usize {
        let noise = white_noise(1000, 0.02, seed);
        let rising = |(index, noise): (usize, &f64)| match index.checked_sub(500) {
            Some(past) => noise + rise_nm(past),
            None => *noise,
        };
        let torque: Vec<f64> = noise.iter().enumerate().map(rising).collect();
        let baseline = Baseline {
            level_nm: 0.0,
            sd_nm: 0.02,
        };
        back_to_rest(&torque, baseline, crossing, 10)
    }

    /// A ramp of 0.01 Nm a sample passes a threshold of five standard deviations 10 samples late.
    #[test]
    fn a_slow_ramp_is_followed_back_to_where_it_began() {
        let began = begun(|past| 0.01 * past as f64, 515, 3);
        assert!(began.abs_diff(500) <= 5, "{began}");
    }

    /// 1.2 Nm (3u² − 2u³) over 11 ms passes 0.1 Nm 1.9 ms after it began.
    #[test]
    fn a_smooth_rise_is_followed_back_to_where_it_began() {
        let rise_nm = |past: usize| {
            let u = (past as f64 / 110.0).min(1.0);
            1.2 * u * u * (3.0 - 2.0 * u)
        };
        let began: Vec<f64> = (0..20)
            .map(|seed| begun(rise_nm, 519, seed) as f64)
            .collect();
        let mean = began.iter().sum::<f64>() / began.len() as f64;
        assert!((mean - 500.0).abs() < 3.0, "{began:?}");
    }

    /// A sensor that jumps by 0.5 Nm when it is switched on, on top of a rise.
    #[test]
    fn a_step_begins_where_it_is() {
        let began = begun(|past| 0.5 + 0.01 * past as f64, 500, 4);
        assert!(began.abs_diff(500) <= 3, "{began}");
    }

    #[test]
    fn a_disturbance_long_before_is_not_the_onset() {
        let mut torque = noisy(1);
        for value in &mut torque[5000..5200] {
            *value += 2.0;
        }
        let (pulses, onset) = find(&torque);
        assert_eq!(pulses.len(), 1, "2 Nm are below 30 % of the peak");
        assert!(onset.abs_diff(ONSET) < 10);
    }

    #[test]
    fn two_hits_are_two_pulses_and_a_dip_is_not() {
        let mut torque = noisy(2);
        torque[16_300..16_700]
            .iter_mut()
            .for_each(|value| *value += 15.0);
        assert_eq!(find(&torque).0.len(), 2);
        let mut overlapping = noisy(3);
        for (index, value) in overlapping[15_600..16_200].iter_mut().enumerate() {
            *value += 18.0 * index as f64 / 600.0;
        }
        let pulses = find(&overlapping).0;
        assert_eq!(
            pulses.len(),
            2,
            "the second begins before the first has ended"
        );
        assert!(pulses[0].peak.abs_diff(PEAK) < 10 && pulses[1].peak.abs_diff(16_199) < 10);
        let mut dipping = noisy(4);
        dipping[15_400..15_430]
            .iter_mut()
            .for_each(|value| *value -= 5.0);
        assert_eq!(
            find(&dipping).0.len(),
            1,
            "a sixth of the peak divides nothing"
        );
        let mut undershooting = noisy(5);
        undershooting[16_000..16_400]
            .iter_mut()
            .for_each(|value| *value -= 12.0);
        assert_eq!(find(&undershooting).0.len(), 1);
    }

    #[test]
    fn a_torque_that_never_rests_begins_at_once() {
        let torque = vec![20.0; 2000];
        let baseline = Baseline::of(&torque, 0);
        let settings = OnsetSettings::default();
        let pulses = pulses(&torque, baseline, &settings);
        assert_eq!(onset(&torque, baseline, &pulses[0], &settings, 10), 0);
    }
}
