//! Angles that begin anew after every turn, as an absolute encoder tells them, and counters that run over.

use std::f64::consts::TAU as TURN_RAD;

/// Share of the range of all samples that a jump must exceed to be one \[–\]: over the seam it is nearly all of it. Chosen.
const JUMP: f64 = 0.5;
/// Share of the range that the largest other step must stay below \[–\]: what moves a quarter of a turn from sample to sample
/// leaves open which way it went. Chosen.
const STEP: f64 = 0.25;
/// Steps before and after a jump by which the rig is seen to go on over the seam, none of them with the jump: of what jumps from end to end
/// by itself and rests there, noise alone looks so in one case of 64. Chosen.
const BESIDE: usize = 3;
/// Share of the way beside all jumps that must go on like this \[–\]: a rig that lingers at the seam crosses it with the noise. Chosen.
const GOES_ON: f64 = 0.75;
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
/// half a turn on.
pub(crate) fn unwrap(angle_rad: &mut [f64]) -> Option<Wrapped> {
    let found = find(angle_rad)?;
    if found.is_turn {
        let mut turns = -(angle_rad[0] / TURN_RAD).round();
        let mut before = angle_rad[0];
        for angle in angle_rad {
            turns -= ((*angle - before) / TURN_RAD).round();
            before = *angle;
            *angle += turns * TURN_RAD;
        }
    }
    Some(found)
}

fn find(angle_rad: &[f64]) -> Option<Wrapped> {
    let lowest = angle_rad.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = angle_rad.iter().copied().fold(f64::NEG_INFINITY, f64::max);
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
    // How far the rig moves while it goes over the seam.
    let moves = |place: usize| {
        let beside = beside(place);
        beside.iter().sum::<f64>() / beside.len().max(1) as f64
    };
    let goes_on = |place: usize| {
        let against = |step: &f64| step * steps[place] <= 0.0;
        beside(place).iter().all(against) && moves(place) != 0.0
    };
    let way = |all: &mut dyn Iterator<Item = &usize>| -> f64 {
        all.map(|&place| moves(place).abs()).sum()
    };
    let going_on = way(&mut jumps.iter().filter(|&&place| goes_on(place)));
    if going_on == 0.0 || going_on < GOES_ON * way(&mut jumps.iter()) {
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
            let found = unwrap(&mut angle).expect("it begins anew");
            assert!(found.is_turn && found.times > 5, "{found:?}");
            for (found, truth) in angle.iter().zip(&truth) {
                assert!((found - truth).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_counter_that_runs_over_is_told_and_left() {
        let mut angle: Vec<f64> = turning()
            .iter()
            .map(|angle| angle.rem_euclid(2.5))
            .collect();
        let before = angle.clone();
        let found = unwrap(&mut angle).expect("it begins anew");
        assert!(!found.is_turn && (found.period_rad - 2.5).abs() < 0.02);
        assert_eq!(angle, before);
    }

    /// A rig that follows steps faster than it is sampled, one that is still, one spike, and one that swings.
    #[test]
    fn what_jumps_by_itself_is_left() {
        let noise = white_noise(2000, 1e-3, 5);
        let square = |period: usize| -> Vec<f64> {
            let at = |(k, noise): (usize, &f64)| {
                let is_high = (k / period) % 2 == 1;
                PI * if is_high { 1.0 } else { -1.0 } + noise
            };
            noise.iter().enumerate().map(at).collect()
        };
        let mut spike = noise.clone();
        spike[700] = TURN_RAD;
        let swing = (0..2000).map(|k| 3.2 * (0.01 * f64::from(k)).sin());
        for mut angle in [
            square(40),
            square(1000),
            square(1),
            noise.clone(),
            spike,
            swing.collect(),
            vec![0.0; 50],
            Vec::new(),
        ] {
            let before = angle.clone();
            assert_eq!(unwrap(&mut angle), None);
            assert_eq!(angle, before);
        }
    }
}
