//! Where a place jumps and stays, as no inertia lets a rig move: a zero that was set anew, a counter that lost its counts, a belt that slipped.

use crate::noise::spread::{NORMAL_CONSISTENCY, extremes, median};
use std::ops::RangeInclusive;

/// Most jumps of a recording that are faults \[–\]: what jumps more often moves so. Chosen.
const MOST: usize = 3;
/// Times that a jump is larger than any other step out of its neighbours' course \[–\]. Chosen: an axis that is sampled ten times while it
/// swings once is out of it by 4 sin³(π/10), 0.12 of its amplitude, again and again.
const LARGER: f64 = 5.0;
/// Share of the recording's range that a jump is at least \[–\]: less spoils no fit, and a glitch that is bridged leaves some. Chosen.
const LEAST: f64 = 0.01;
/// Steps to either side of a jump that hold it, too.
const BESIDE: usize = 2;

/// Samples to which `samples` jump and from which on they go on as before: those few whose step is out of course,
///
/// ```text
/// e_k = x_k − x_{k−1} − (x_{k−1} − x_{k−2})/2 − (x_{k+1} − x_k)/2
/// ```
///
/// by more than `threshold_sd` standard deviations of all e, by a good part of all x, and by far more than that of any other sample. One that
/// `is_explained` is no fault.
pub(crate) fn find(
    samples: &[f64],
    threshold_sd: f64,
    is_explained: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let out_of_course: Vec<f64> = (samples.windows(4))
        .map(|x| (1.5 * (x[2] - x[1]) - 0.5 * (x[3] - x[0])).abs())
        .collect();
    let typical = NORMAL_CONSISTENCY * median(&mut out_of_course.clone());
    let [lowest, highest] = extremes(samples);
    let least = (threshold_sd * typical).max(LEAST * (highest - lowest));
    let mut left = out_of_course;
    let mut found = Vec::new();
    let largest = |left: &[f64]| {
        left.iter()
            .copied()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))
    };
    while let Some((place, size)) = largest(&left).filter(|(_, size)| *size > least) {
        if found.len() == MOST || is_explained(place + BESIDE) {
            break;
        }
        found.push((place + BESIDE, size));
        let beside = around(place, left.len());
        left[beside].fill(0.0);
    }
    let next = largest(&left).map_or(0.0, |(_, size)| size);
    found.retain(|(_, size)| *size > LARGER * next);
    let mut places: Vec<usize> = found.into_iter().map(|(place, _)| place).collect();
    places.sort_unstable();
    places
}

fn around(place: usize, length: usize) -> RangeInclusive<usize> {
    place.saturating_sub(BESIDE)..=(place + BESIDE).min(length - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::white_noise;

    const SD: f64 = 12.0;

    fn swings(hz: f64, noise: f64) -> Vec<f64> {
        let at = |(k, noise): (usize, f64)| {
            (std::f64::consts::TAU * hz * k as f64 / 200.0).sin() + noise
        };
        white_noise(3000, noise, 7)
            .into_iter()
            .enumerate()
            .map(at)
            .collect()
    }

    fn jumped(mut samples: Vec<f64>, jumps: &[(usize, f64)]) -> Vec<usize> {
        for &(at, by) in jumps {
            samples[at..].iter_mut().for_each(|x| *x += by);
        }
        find(&samples, SD, |_| false)
    }

    #[test]
    fn a_zero_that_jumps_is_found_where_it_does() {
        assert_eq!(jumped(swings(1.0, 0.002), &[(1200, 0.2)]), [1200]);
        assert_eq!(
            jumped(swings(1.0, 0.002), &[(700, -0.2), (1900, 0.3)]),
            [700, 1900]
        );
        assert_eq!(jumped(swings(1.0, 0.0), &[(1200, 0.2)]), [1200]);
    }

    /// An encoder of 100 counts a swing that loses 20 of them.
    #[test]
    fn lost_counts_are_found() {
        let counts = |x: &f64| (100.0 * x).round();
        let coarse: Vec<f64> = swings(0.3, 0.0).iter().map(counts).collect();
        assert_eq!(jumped(coarse.clone(), &[]), []);
        assert_eq!(jumped(coarse, &[(1500, 20.0)]), [1500]);
    }

    /// As large as noise or the motion itself make them, as often as a rig that moves in steps, or where it is kicked.
    #[test]
    fn what_moves_so_itself_is_left() {
        assert_eq!(jumped(swings(1.0, 0.002), &[]), []);
        assert_eq!(jumped(swings(1.0, 0.0), &[(1200, 0.015)]), []);
        assert_eq!(jumped(swings(1.0, 0.02), &[(1200, 0.2)]), []);
        assert_eq!(jumped(swings(40.0, 0.0), &[(1200, 0.5)]), []);
        let steps: Vec<(usize, f64)> = (1..20).map(|k| (150 * k, 0.4)).collect();
        assert_eq!(jumped(swings(1.0, 0.002), &steps), []);
        let mut kicked = swings(1.0, 0.002);
        kicked[1200..].iter_mut().for_each(|x| *x += 0.2);
        assert_eq!(find(&kicked, SD, |place| place == 1200), []);
        for short in 0..4 {
            assert_eq!(find(&kicked[..short], SD, |_| false), []);
        }
    }

    /// A blow changes the speed, not the place.
    #[test]
    fn a_rig_that_bounces_is_left() {
        let bounces = |k: u32| (0.01 * f64::from(k)).sin().abs();
        let bounces: Vec<f64> = (0..3000).map(bounces).collect();
        assert_eq!(find(&bounces, SD, |_| false), []);
    }
}
