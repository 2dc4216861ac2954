//! Angles that begin anew after every turn, as an absolute encoder tells them, and counters that run over.

use super::spikes::{self, WIDEST};
use crate::noise::spread::{extremes, median};
use std::f64::consts::TAU as TURN_RAD;

/// Share of the range of all samples that a jump must exceed to be one \[–\]: over the seam it is nearly all of it. Chosen.
const JUMP: f64 = 0.5;
/// Share of the range that the largest other step must stay below \[–\]: what moves a quarter of a turn from sample to sample
/// leaves open which way it went. Chosen.
const STEP: f64 = 0.25;
/// Steps before and after a jump by which the rig is seen to go on over the seam, none of them with the jump: of what jumps from end to end
/// by itself and rests there, noise alone looks so in one case of 64. Chosen.
const BESIDE: usize = 3;
/// How much farther the rig must go on over the seam once than it typically goes beside jumps where it does not \[–\]: at rest on the seam it
/// goes to and fro with the noise, and so does what jumps from end to end. Chosen: of such noise, the few jumps that look as if it went on
/// go some three times as far.
const FARTHER: f64 = 5.0;
/// Times a step beside a jump that a jump typically is at most, taken the short way round, where a rig rests on its seam \[–\]: both are
/// noise, and that over the seam is 2.85 times the other where the noise is normal and jumps are many. Chosen.
const AT_REST: f64 = 10.0;
/// Largest difference between the ways that jumps skip, over that way \[–\]. Chosen.
const ALIKE: f64 = 0.02;

/// What was found of an angle that begins anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wrapped {
    /// How often it does.
    pub(crate) times: usize,
    /// After which way \[rad\].
    pub(crate) period_rad: f64,
    /// Whether that is one turn, which then was put together.
    pub(crate) is_turn: bool,
}

/// Puts the turns of an angle together where it begins anew after each, so that it goes on where the rig does, from between minus and plus
/// half a turn on. Glitches, which leave and come back by more than `spike_sd` standard deviations of the noise, are no turns, wherever
/// they are; they stay, at most half a turn away.
pub(crate) fn unwrap(angle_rad: &mut [f64], spike_sd: f64) -> Option<Wrapped> {
    let together = put_together(angle_rad);
    let found = find(&without_spikes(angle_rad, &together, spike_sd))?;
    if found.is_turn {
        angle_rad.copy_from_slice(&together);
    }
    Some(found)
}

/// Each sample so many turns away that it is nearest to the last before it that is no glitch.
fn put_together(angle_rad: &[f64]) -> Vec<f64> {
    let mut before = 0.0;
    let mut astray = WIDEST;
    let next = |&angle: &f64| {
        let next = angle - TURN_RAD * ((angle - before) / TURN_RAD).round();
        if (next - before).abs() <= STEP * TURN_RAD || astray == WIDEST {
            (before, astray) = (next, 0);
        } else {
            astray += 1;
        }
        next
    };
    angle_rad.iter().map(next).collect()
}

/// The angle, which begins anew wherever it does, without the spikes that are left in it put `together`.
fn without_spikes(angle_rad: &[f64], together: &[f64], spike_sd: f64) -> Vec<f64> {
    let mut mended = together.to_vec();
    let spikes = spikes::repair(&mut mended, spike_sd, |_, _, _, _| false).mended;
    let ways = together.iter().zip(angle_rad).map(|(to, from)| to - from);
    let mut ways: Vec<f64> = ways.collect();
    for spike in spikes {
        let before = ways[spike.start - 1];
        ways[spike].fill(before);
    }
    let anew = mended.iter().zip(&ways).map(|(mended, way)| mended - way);
    anew.collect()
}

fn find(angle_rad: &[f64]) -> Option<Wrapped> {
    let [lowest, highest] = extremes(angle_rad);
    let range = highest - lowest;
    let steps: Vec<f64> = angle_rad.windows(2).map(|two| two[1] - two[0]).collect();
    let (jumps, others): (Vec<usize>, Vec<usize>) =
        (0..steps.len()).partition(|&place| steps[place].abs() > JUMP * range);
    let largest = others.iter().map(|&place| steps[place].abs());
    if jumps.is_empty() || largest.fold(0.0, f64::max) > STEP * range {
        return None;
    }
    let beside = |place: usize| -> Vec<f64> {
        let places = place.saturating_sub(BESIDE)..=(place + BESIDE).min(steps.len() - 1);
        let steps = places.map(|place| steps[place]);
        steps.filter(|step| step.abs() <= JUMP * range).collect()
    };
    let way = |place: usize| beside(place).iter().sum::<f64>();
    // How far the rig moves while it goes over the seam.
    let moves = |place: usize| way(place) / beside(place).len().max(1) as f64;
    let goes_on = |place: usize| {
        let against = |step: &f64| step * steps[place] <= 0.0;
        beside(place).iter().all(against) && way(place) != 0.0
    };
    let (seams, noisy): (Vec<usize>, Vec<usize>) =
        jumps.iter().copied().partition(|&place| goes_on(place));
    let ways =
        |places: &[usize]| -> Vec<f64> { places.iter().map(|&place| way(place).abs()).collect() };
    let to_and_fro = median(&mut ways(&noisy));
    let farthest = ways(&seams).into_iter().fold(0.0, f64::max);
    let is_passed = farthest > 0.0 && farthest >= FARTHER * to_and_fro;
    let mut near: Vec<f64> = (jumps.iter().flat_map(|&place| beside(place)))
        .map(f64::abs)
        .filter(|step| *step > 0.0)
        .collect();
    let round = jumps.iter().map(|&place| TURN_RAD - steps[place].abs());
    let round = median(&mut round.collect::<Vec<f64>>());
    // All of it within a turn, as of an encoder and not of what jumps by itself, whose noise is on both sides.
    let rests_there = range < TURN_RAD && round <= AT_REST * median(&mut near);
    if !is_passed && !rests_there {
        return None;
    }
    let skipped = jumps
        .iter()
        .map(|&place| (moves(place) - steps[place]).abs());
    let mut skipped: Vec<f64> = skipped.collect();
    skipped.sort_by(f64::total_cmp);
    let period_rad = skipped[skipped.len() / 2];
    let alike = |way: f64| (way - period_rad).abs() <= ALIKE * period_rad;
    (skipped.iter().all(|&way| alike(way))).then(|| Wrapped {
        times: jumps.len(),
        period_rad,
        is_turn: alike(TURN_RAD),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::white_noise;
    use std::f64::consts::PI;

    const SPIKE_SD: f64 = 12.0;

    /// Turns both ways, with noise.
    fn turning() -> Vec<f64> {
        let noise = white_noise(4000, 1e-3, 3);
        let at = |(k, noise): (usize, f64)| {
            let t = 0.002 * k as f64;
            0.4 + 9.0 * (0.9 * t).sin() + 4.0 * t + noise
        };
        noise.into_iter().enumerate().map(at).collect()
    }

    #[test]
    fn turns_are_put_together_whatever_the_seam() {
        let truth = turning();
        for from in [0.0, -PI, 1.0] {
            let within = |angle: &f64| (angle - from).rem_euclid(TURN_RAD) + from;
            let mut angle: Vec<f64> = truth.iter().map(within).collect();
            let found = unwrap(&mut angle, SPIKE_SD).expect("it begins anew");
            assert!(found.is_turn && found.times > 5, "{found:?}");
            for (found, truth) in angle.iter().zip(&truth) {
                assert!((found - truth).abs() < 1e-9);
            }
        }
    }

    /// At rest on the seam, and then over it.
    #[test]
    fn a_rig_that_starts_on_the_seam_is_no_square_wave() {
        let noise = white_noise(2000, 1e-3, 11);
        let on_the_seam = |rad_per_sample: f64| -> [Vec<f64>; 2] {
            let at =
                |(k, noise): (usize, &f64)| rad_per_sample * (k as f64 - 500.0).max(0.0) + noise;
            let truth: Vec<f64> = noise.iter().enumerate().map(at).collect();
            let within = truth
                .iter()
                .map(|angle| angle.rem_euclid(TURN_RAD))
                .collect();
            [truth, within]
        };
        // It stays there, goes over the seam fast, leaves it slowly forwards, and backwards.
        for rad_per_sample in [0.0, 0.01, 1e-4, -1e-4] {
            let [truth, mut angle] = on_the_seam(rad_per_sample);
            assert!(unwrap(&mut angle, SPIKE_SD).is_some_and(|found| found.is_turn));
            let from = TURN_RAD * ((angle[0] - truth[0]) / TURN_RAD).round();
            for (found, truth) in angle.iter().zip(&truth) {
                assert!((found - from - truth).abs() < 1e-9);
            }
        }
    }

    /// One to three samples read anything, where the seam is crossed as well as elsewhere, and the noise goes to and fro over the seam.
    #[test]
    fn glitches_are_no_turns() {
        let truth = turning();
        let within: Vec<f64> = truth
            .iter()
            .map(|angle| angle.rem_euclid(TURN_RAD))
            .collect();
        let crosses = |k: &usize| (within[*k] - within[k - 1]).abs() > PI;
        let seams: Vec<usize> = (1..4000).filter(crosses).collect();
        let elsewhere = (60..4000).step_by(173);
        let places: Vec<usize> = seams.iter().step_by(3).copied().chain(elsewhere).collect();
        let mut angle = within.clone();
        let mut is_glitch = [false; 4000];
        for (number, &place) in places.iter().enumerate() {
            let wide = 1 + number % 3;
            let read = 0.7 * number as f64 % TURN_RAD;
            let those = place..(place + wide).min(4000);
            angle[those.clone()].fill(read);
            is_glitch[those].fill(true);
        }
        let found = unwrap(&mut angle, SPIKE_SD).expect("it begins anew");
        assert!(found.is_turn && found.times > 5, "{found:?}");
        for ((found, truth), _) in angle.iter().zip(&truth).zip(is_glitch).filter(|one| !one.1) {
            assert!((found - truth).abs() < 1e-9, "{found} {truth}");
        }
        for (found, truth) in angle.iter().zip(&truth) {
            assert!((found - truth).abs() < PI + 0.3, "{found} {truth}");
        }
    }

    #[test]
    fn a_counter_that_runs_over_is_told_and_left() {
        let mut angle: Vec<f64> = turning()
            .iter()
            .map(|angle| angle.rem_euclid(2.5))
            .collect();
        let before = angle.clone();
        let found = unwrap(&mut angle, SPIKE_SD).expect("it begins anew");
        assert!(!found.is_turn && (found.period_rad - 2.5).abs() < 0.02);
        assert_eq!(angle, before);
    }

    /// A rig that follows steps faster than it is sampled, one that is still, one spike, and one that swings.
    #[test]
    fn what_jumps_by_itself_is_left() {
        let noise = white_noise(2000, 1e-3, 5);
        let between = |from: f64, to: f64, period: usize| -> Vec<f64> {
            let at = |(k, noise): (usize, &f64)| {
                let is_high = (k / period) % 2 == 1;
                (if is_high { to } else { from }) + noise
            };
            noise.iter().enumerate().map(at).collect()
        };
        let square = |period: usize| between(-PI, PI, period);
        let mut spike = noise.clone();
        spike[700] = TURN_RAD;
        let swing = (0..2000).map(|k| 3.2 * (0.01 * f64::from(k)).sin());
        for mut angle in [
            square(40),
            square(1000),
            square(1),
            // A little less than a turn.
            between(0.01, TURN_RAD - 0.01, 40),
            between(0.01, TURN_RAD - 0.01, 1),
            noise.clone(),
            spike,
            swing.collect(),
            vec![0.0; 50],
            Vec::new(),
        ] {
            let before = angle.clone();
            assert_eq!(unwrap(&mut angle, SPIKE_SD), None);
            assert_eq!(angle, before);
        }
    }
}
