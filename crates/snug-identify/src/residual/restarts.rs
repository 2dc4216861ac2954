//! How the model is run beside a measurement: freely, or again and again from the measured motion.

use crate::residual::local_cubic::{LocalCubic, local_cubics};
use crate::residual::taken_up::variances;
use crate::residual::thresholds::{
    AS_WELL, FEWEST_APART, GROWN, LEAST_HALF_WIDTH, MOST_OF_MOTION, PLACES,
};
use serde::{Deserialize, Serialize};
use snug_campaign::{Quantity, Tightening};
use snug_model::Input;
use std::iter::successors;

/// How the model is run beside a measurement.
///
/// A free run over a long record accumulates every error: without a spring the position drifts away, past the top of a
/// pendulum the simulation falls to the other side, and the cost has minima that have nothing to do with the parameters.
/// Restarted from the measured motion every so often (multiple shooting with known states), a model is judged by what it
/// predicts over that time, and of a displacement not by what errors of that motion make of it ([`Scoring`](crate::Scoring)).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Simulation {
    /// Restarted where the window is `Whole` and a free run of the study's own model misses the measurement by far;
    /// every verb decides it alike and says so. Otherwise free.
    #[default]
    Automatic,
    /// From the first sample to the last.
    FreeRun,
    /// From the measured displacement and velocity, again and again.
    Restarted {
        /// From one restart to the next \[s\].
        every_s: f64,
    },
}

impl Simulation {
    /// `input` with the restarts that this asks for, each from the measured motion there.
    pub fn of(self, input: Input, tightening: &Tightening) -> Input {
        let interval_s = tightening.time_base.interval_s;
        let measured = tightening.motion.get(Quantity::Displacement);
        let (Self::Restarted { every_s }, Some(measured)) = (self, measured) else {
            return input;
        };
        let apart = ((every_s / interval_s).round() as usize).max(FEWEST_APART);
        let [taken_up, narrower] = calmest(measured, apart);
        let motions = taken_up.iter().map(|cubic| cubic.over(interval_s));
        let variances = variances(&taken_up, &narrower, measured).into_iter();
        let grown = variances.map(|both| both.map(|variance| GROWN * variance));
        (input.with_restarts(apart, motions.collect())).with_variances_at_restarts(grown.collect())
    }
}

/// Displacement \[rad\] and velocity \[rad/s\] at every `apart`th sample of a measured displacement: those of the cubic
/// that fits `half_width` samples on either side best.
pub fn motions(
    displacement_rad: &[f64],
    interval_s: f64,
    apart: usize,
    half_width: usize,
) -> Vec<[f64; 2]> {
    let half_width = half_width.max(LEAST_HALF_WIDTH);
    let cubics = local_cubics(displacement_rad, apart, half_width).into_iter();
    cubics.map(|cubic| cubic.over(interval_s)).collect()
}

/// The cubics at restarts whose velocity is most certain, where those over half as many samples say most nearly the same, and these. With
/// fewer, noise and vibration speak; with more, the motion bends too much for a cubic. Those that leave much of the motion tell nothing of it:
/// over many swings all say that it rests.
fn calmest(displacement_rad: &[f64], apart: usize) -> [Vec<LocalCubic>; 2] {
    let cubics = |half_width: usize| local_cubics(displacement_rad, apart, half_width);
    let mut all = Vec::from([LEAST_HALF_WIDTH, 2 * LEAST_HALF_WIDTH].map(cubics));
    let left = |cubics: &Vec<LocalCubic>| mean(cubics.iter().map(|cubic| cubic.variance));
    let most_left = left(&all[0]) + MOST_OF_MOTION * variance(displacement_rad);
    // Beyond the recording all cubics are the same, and no surer for that.
    let widest = apart.min(displacement_rad.len()) / 2;
    let half_widths = successors(Some(LEAST_HALF_WIDTH), |half_width| Some(2 * half_width));
    let wider = half_widths.skip(all.len());
    let wider = wider.take_while(|&half_width| half_width <= widest);
    all.extend((wider.map(cubics)).take_while(|cubics| left(cubics) <= most_left));
    let change = |wide: usize| -> f64 {
        let pairs = all[wide].iter().zip(&all[wide - 1]);
        pairs
            .map(|(a, b)| (a.motion[1] - b.motion[1]).powi(2))
            .sum()
    };
    let best = (1..all.len()).min_by(|&a, &b| change(a).total_cmp(&change(b)));
    all.truncate(best.map_or(0, |best| best + 1));
    [all.pop(), all.pop()].map(Option::unwrap_or_default)
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

fn variance(values: &[f64]) -> f64 {
    let middle = mean(values.iter().copied());
    mean(values.iter().map(|value| (value - middle).powi(2)))
}

/// Samples on either side over which cubics describe a measurement as well as over few: the wider, the less noise in the
/// velocity.
pub fn widest_half_width(displacement_rad: &[f64]) -> usize {
    let step = (displacement_rad.len() / PLACES).max(1);
    let places: Vec<usize> = (0..displacement_rad.len()).step_by(step).collect();
    let spread = |half_width: usize| -> f64 {
        let local = places
            .iter()
            .map(|&at| LocalCubic::fit(displacement_rad, at, half_width));
        local.map(|local| local.variance).sum::<f64>().sqrt()
    };
    let few = spread(LEAST_HALF_WIDTH);
    let wider = successors(Some(2 * LEAST_HALF_WIDTH), |half_width| {
        Some(2 * half_width)
    });
    wider
        .take_while(|&half_width| 8 * half_width <= displacement_rad.len())
        .take_while(|&half_width| spread(half_width) <= AS_WELL * few)
        .last()
        .unwrap_or(LEAST_HALF_WIDTH)
}

/// Angle \[rad\] and velocity \[rad/s\] at every `apart`th sample, to restart a simulation from.
pub fn motions_at(angle_rad: &[f64], velocity_rad_per_s: &[f64], apart: usize) -> Vec<[f64; 2]> {
    let motions = angle_rad.iter().zip(velocity_rad_per_s).step_by(apart);
    motions
        .map(|(angle, velocity)| [*angle, *velocity])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From −0.5 to 0.5.
    fn noise(sample: u32) -> f64 {
        f64::from(sample.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24) - 0.5
    }

    /// Swings of 1 rad at 8 and at 1 rad/s, begun at rest at their end, of which a cubic over all samples knows little.
    #[test]
    fn restarts_further_apart_than_the_recording_begin_where_it_does() {
        for rate in [8e-3, 1e-3] {
            let swing = |i: u32| (f64::from(i) * rate).cos() + 1e-4 * noise(i);
            let swing: Vec<f64> = (0..4000).map(swing).collect();
            for apart in [4000, 4001, 60_000, usize::MAX / 2] {
                let [taken_up, _] = calmest(&swing, apart);
                let [angle, velocity] = taken_up[0].over(1e-3);
                assert!(
                    (angle - 1.0).abs() < 1e-3 && velocity.abs() < 0.02,
                    "{apart}: {angle} {velocity}"
                );
            }
        }
    }

    /// Five swings of 1 rad at 3 to 75 rad/s, whose velocity is 68 rad/s rms: cubics over many of them agree that it is 0.
    #[test]
    fn what_many_swings_leave_of_a_cubic_is_no_velocity() {
        let rates = [3.1, 8.2, 19.5, 49.6, 75.4];
        let at = |i: usize| {
            let time_s = 1e-3 * i as f64;
            let angle = rates.iter().map(|rate| (rate * time_s + rate).sin());
            let velocity = rates.iter().map(|rate| rate * (rate * time_s + rate).cos());
            (angle.sum::<f64>(), velocity.sum::<f64>())
        };
        let measured = (0..120_000).map(|i| at(i as usize).0 + 1e-3 * noise(i));
        let measured: Vec<f64> = measured.collect();
        for apart in [5000, 40_000, 119_000] {
            let [taken_up, _] = calmest(&measured, apart);
            for (restart, cubic) in taken_up.iter().enumerate() {
                let (expected, [_, velocity]) = (at(restart * apart).1, cubic.over(1e-3));
                assert!(
                    (velocity - expected).abs() < 2.0,
                    "{apart}: {velocity} {expected}"
                );
            }
        }
    }

    /// Savitzky–Golay: a cubic's slope has the noise of Σ over ±h; wider is calmer, as far as the motion allows.
    #[test]
    fn the_reach_grows_until_the_motion_bends_too_much() {
        let wave = |period: f64| -> Vec<f64> {
            (0..4000)
                .map(|i| (f64::from(i) * std::f64::consts::TAU / period).sin())
                .zip((0_u32..).map(noise))
                .map(|(x, noise)| x + 1e-3 * noise)
                .collect()
        };
        let (fast, slow) = (
            widest_half_width(&wave(100.0)),
            widest_half_width(&wave(4000.0)),
        );
        assert!(
            (64..=512).contains(&slow) && (4..=16).contains(&fast),
            "{slow} {fast}"
        );
    }
}
