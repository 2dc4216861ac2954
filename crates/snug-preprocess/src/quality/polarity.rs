//! Exchanged channels and wrong signs, told by mechanics: a torque has one sign, an acceleration swings both ways.

use std::ops::Range;

/// How one-sided a signal is: |Σ x| / Σ |x|, 1 for one sign only, 0 for balance; 0 for silence.
pub(crate) fn one_sidedness(samples: &[f64]) -> f64 {
    let magnitude: f64 = samples.iter().map(|x| x.abs()).sum();
    if magnitude > 0.0 {
        samples.iter().sum::<f64>().abs() / magnitude
    } else {
        0.0
    }
}

/// A channel at least as one-sided as this looks like a torque pulse.
const LIKE_TORQUE: f64 = 0.9;

/// A channel at most as one-sided as this looks like an acceleration, which brings the tool up to speed and back to rest.
const LIKE_ACCELERATION: f64 = 0.6;

/// Whether torque and acceleration stand in each other's place: the torque column swings both ways, the acceleration
/// column has one sign. Both are given over the pulse, their level at rest taken out.
///
/// Returns the two measures of one-sidedness when they do.
pub(crate) fn swapped(torque: &[f64], acceleration: &[f64]) -> Option<(f64, f64)> {
    let (torque, acceleration) = (one_sidedness(torque), one_sidedness(acceleration));
    (torque <= LIKE_ACCELERATION && acceleration >= LIKE_TORQUE).then_some((torque, acceleration))
}

/// Whether the torque is negative where it should be positive: one-sided, and with a larger negative excursion.
pub(crate) fn inverted_torque(torque: &[f64]) -> bool {
    let largest = torque.iter().copied().fold(0.0, f64::max);
    let smallest = torque.iter().copied().fold(0.0, f64::min);
    one_sidedness(torque) >= LIKE_TORQUE && -smallest > largest && torque.iter().sum::<f64>() < 0.0
}

/// Velocity \[rad/s\] that the tool has picked up when the torque first reaches half its peak: it must follow the torque.
///
/// `rise` is the range from the onset to the torque's peak.
pub(crate) fn early_velocity(
    torque: &[f64],
    acceleration: &[f64],
    rise: &Range<usize>,
    interval_s: f64,
) -> f64 {
    let half = 0.5 * torque[rise.end];
    let until = rise
        .clone()
        .find(|&index| torque[index] >= half)
        .unwrap_or(rise.end);
    acceleration[rise.start..=until].iter().sum::<f64>() * interval_s
}

/// Duration over which the acceleration before and after the release is averaged \[s\].
const BESIDE_RELEASE_S: f64 = 3e-3;
/// Share of its peak below which the torque is released.
const RELEASED: f64 = 0.2;

/// By how much the acceleration falls \[rad/s²\] while the torque is released: it must, whatever the tool did before the
/// pulse. `None` where the torque is not released before `end`.
pub(crate) fn fall_at_release(
    torque: &[f64],
    acceleration: &[f64],
    peak: usize,
    end: usize,
    interval_s: f64,
) -> Option<f64> {
    let beside = ((BESIDE_RELEASE_S / interval_s) as usize).max(1);
    let released = (peak..end).find(|&index| torque[index] < RELEASED * torque[peak])?;
    let mean = |range: Range<usize>| {
        let count = range.len().max(1) as f64;
        acceleration[range].iter().sum::<f64>() / count
    };
    let before = mean(peak.saturating_sub(beside)..peak + 1);
    Some(before - mean(released..(released + beside).min(end)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{ONSET, PEAK, SEGMENT, acceleration, pulse, white_noise};

    #[test]
    fn a_torque_and_an_acceleration_are_told_apart() {
        for (index, peak_nm) in [15.0, 30.0, 45.0].into_iter().enumerate() {
            let torque = pulse(peak_nm);
            let motion = acceleration(&torque);
            let window = 14_800..17_800;
            let noise = white_noise(3000, 0.5, index as u64);
            let noisy: Vec<f64> = motion[window.clone()]
                .iter()
                .zip(noise)
                .map(|(a, n)| a + n)
                .collect();
            let torque = &torque[window];
            assert_eq!(swapped(torque, &noisy), None);
            assert!(swapped(&noisy, torque).is_some());
            assert!(!inverted_torque(torque));
            let negative: Vec<f64> = torque.iter().map(|t| -t).collect();
            assert!(inverted_torque(&negative));
            assert_eq!(swapped(&negative, &noisy), None);
        }
    }

    #[test]
    fn the_tool_follows_the_torque() {
        let torque = pulse(30.0);
        let motion = acceleration(&torque);
        let velocity = early_velocity(&torque, &motion, &(ONSET..PEAK), 1e-4);
        assert!(velocity > 0.1, "{velocity}");
        let inverted: Vec<f64> = motion.iter().map(|a| -a).collect();
        assert_eq!(
            early_velocity(&torque, &inverted, &(ONSET..PEAK), 1e-4),
            -velocity
        );
        assert_eq!(one_sidedness(&[0.0; 5]), 0.0);
    }

    /// A tool that swings back when the pulse begins first moves against the torque, but is pushed by it all the same.
    #[test]
    fn the_release_shows_the_sign_of_a_tool_that_was_in_motion() {
        let torque = pulse(30.0);
        let swing = |index: usize| {
            let since_s = index.saturating_sub(ONSET) as f64 * 1e-4;
            -60.0 * (-10.0 * since_s).exp() * (21.0 * since_s).cos()
        };
        let pushed = acceleration(&torque);
        let motion: Vec<f64> = (pushed.iter().enumerate())
            .map(|(index, a)| a + swing(index))
            .collect();
        assert!(early_velocity(&torque, &motion, &(ONSET..PEAK), 1e-4) < -0.1);
        let fall = |motion: &[f64]| fall_at_release(&torque, motion, PEAK, SEGMENT, 1e-4);
        assert!(
            fall(&motion).is_some_and(|fall| fall > 20.0),
            "{:?}",
            fall(&motion)
        );
        let inverted: Vec<f64> = motion.iter().map(|a| -a).collect();
        assert!(fall(&inverted).is_some_and(|fall| fall < -20.0));
        assert_eq!(
            fall_at_release(&torque, &motion, PEAK, PEAK + 5, 1e-4),
            None
        );
    }
}
