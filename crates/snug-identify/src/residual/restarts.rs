//! How the model is run beside a measurement: freely, or again and again from the measured motion.

use crate::residual::local_cubic::{LocalCubic, local_cubics};
use crate::residual::taken_up::variances;
use crate::residual::thresholds::{AS_WELL, FEWEST_APART, GROWN, LEAST_HALF_WIDTH, PLACES};
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
/// fewer, noise and vibration speak; with more, the motion bends too much for a cubic.
fn calmest(displacement_rad: &[f64], apart: usize) -> [Vec<LocalCubic>; 2] {
    // Beyond the recording all cubics are the same, and no surer for that.
    let widest = (apart.min(displacement_rad.len()) / 2).max(2 * LEAST_HALF_WIDTH);
    let half_widths = successors(Some(LEAST_HALF_WIDTH), |half_width| Some(2 * half_width));
    let mut all: Vec<Vec<LocalCubic>> = half_widths
        .take_while(|&half_width| half_width <= widest)
        .map(|half_width| local_cubics(displacement_rad, apart, half_width))
        .collect();
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

    /// A swing of 1 rad at 8 rad/s, begun at rest at its end, of which a cubic over all samples knows nothing.
    #[test]
    fn restarts_further_apart_than_the_recording_begin_where_it_does() {
        let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24);
        let swing = |i: u32| (f64::from(i) * 8e-3).cos() + 1e-4 * (noise(i) - 0.5);
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

    /// Savitzky–Golay: a cubic's slope has the noise of Σ over ±h; wider is calmer, as far as the motion allows.
    #[test]
    fn the_reach_grows_until_the_motion_bends_too_much() {
        let wave = |period: f64| -> Vec<f64> {
            (0..4000)
                .map(|i| (f64::from(i) * std::f64::consts::TAU / period).sin())
                .zip((0_u32..).map(|i| {
                    f64::from(i.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24) - 0.5
                }))
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
