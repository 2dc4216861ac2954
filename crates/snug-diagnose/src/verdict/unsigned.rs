//! An output that lost its sign, as of a counter of pulses that sees how fast something turns and not which way.
//!
//! Where a signal goes through 0, its size turns about as at a wall: with the other sign from there on it is smooth.

use crate::verdict::thresholds::{NEAR_ZERO, SMOOTHER, TURNS};
use snug_identify::{FitTask, means};

/// Samples to either side over which it is looked whether a recording goes through 0 or turns about.
const BESIDE: usize = 3;
/// Samples of which the mean is looked at, too: what moves slowly for its sampling turns about within its noise.
const MEANS_OF: [usize; 5] = [1, 2, 4, 8, 16];

/// Whether no recording goes below 0, and they turn about there again and again.
pub(crate) fn lost_their_sign(cases: &[FitTask<'_>]) -> bool {
    let are_above = cases.iter().all(|case| {
        let near = near_zero(case.measured());
        case.measured().iter().all(|&y| y > -near)
    });
    let turns = |of: &usize| -> usize {
        let turns = cases.iter().map(|case| turns(&means(case.measured(), *of)));
        turns.sum()
    };
    are_above && MEANS_OF.iter().any(|of| turns(of) >= TURNS)
}

fn near_zero(measured: &[f64]) -> f64 {
    let squares: f64 = measured.iter().map(|y| y * y).sum();
    NEAR_ZERO * (squares / measured.len() as f64).sqrt()
}

/// Places near 0 towards and away from which a signal runs, and at which it is smooth once its sign is changed there.
fn turns(measured: &[f64]) -> usize {
    let near = near_zero(measured);
    let around = measured.windows(2 * BESIDE + 1);
    around
        .filter(|around| around[BESIDE] < near && is_a_turn(around))
        .count()
}

fn is_a_turn(around: &[f64]) -> bool {
    let (before, after) = (&around[..=BESIDE], &around[BESIDE..]);
    let runs_there = before.windows(2).all(|pair| pair[1] < pair[0]);
    let runs_away = after.windows(2).all(|pair| pair[1] > pair[0]);
    // The lowest sample itself is on either side.
    let ways = [BESIDE, BESIDE + 1].map(|change| roughness(around, change));
    let smoothest = f64::min(ways[0], ways[1]);
    runs_there && runs_away && SMOOTHER * smoothest < roughness(around, around.len())
}

/// Squares of second differences, the sign being the other from `change` on.
fn roughness(samples: &[f64], change: usize) -> f64 {
    let at = |k: usize| match k < change {
        true => samples[k],
        false => -samples[k],
    };
    let seconds = (2..samples.len()).map(|k| at(k) - 2.0 * at(k - 1) + at(k - 2));
    seconds.map(|second| second * second).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two sines of 100 and 30 samples a period, which go through 0 and turn about near it.
    fn moved() -> Vec<f64> {
        let at = |k: u32| (0.0628 * f64::from(k)).sin() + 0.5 * (0.2094 * f64::from(k) + 0.3).sin();
        (0..1000).map(at).collect()
    }

    #[test]
    fn most_ways_through_0_are_turns() {
        let truth = moved();
        let through = truth.windows(2).filter(|pair| pair[0] * pair[1] < 0.0);
        let through = through.count();
        let folded: Vec<f64> = truth.iter().map(|y| y.abs()).collect();
        let found = turns(&folded);
        assert!(
            through > 20 && found <= through && 2 * found > through,
            "{found} of {through}"
        );
    }

    /// What rests at 0 between its pulses, touches it, or only comes near it.
    #[test]
    fn what_is_never_below_0_may_have_its_sign() {
        let pulses: Vec<f64> = moved().iter().map(|y| y.max(0.0)).collect();
        let touches: Vec<f64> = moved().iter().map(|y| y * y).collect();
        let near: Vec<f64> = moved().iter().map(|y| 1.55 + y).collect();
        for samples in [pulses, touches, near, vec![0.0; 100], Vec::new()] {
            assert_eq!(turns(&samples), 0);
        }
    }
}
