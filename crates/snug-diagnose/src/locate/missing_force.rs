//! The force that the model lacks, over time and over displacement and velocity.

use super::bootstrap::{Draws, Term};
use super::grid::Grid;
use super::residual::{Residuals, White, difference};
use super::time_since_onset;
use crate::locate::thresholds::{MAP_BINS, TIME_BINS};
use rayon::prelude::*;
use snug_campaign::{ForceCurve, ForceMap, Interval, Quantity};
use snug_model::BASE_PARAMETERS;

/// ΔF of every sample from the first scored on \[N\]; `None` without acceleration or without m, c, k.
pub fn missing_force_n(one: &White<'_>) -> Option<Vec<f64>> {
    let seen = &one.seen;
    let rig = &seen.tightening.rig;
    let l = rig.lever_arm_m;
    let [m, c, k] = BASE_PARAMETERS.map(|name| seen.estimate.value(name));
    let mut force: Vec<f64> = difference(seen, Quantity::Acceleration)?;
    let inertia = rig.known_inertia_kg_m2 + m? * l * l;
    let velocity = difference(seen, Quantity::Velocity);
    let angle = difference(seen, Quantity::Displacement);
    force.iter_mut().for_each(|error| *error *= -inertia / l);
    if let (Some(velocity), Some(angle), Some(c), Some(k)) = (velocity, angle, c, k) {
        for ((force, velocity), angle) in force.iter_mut().zip(velocity).zip(angle) {
            *force -= l * (c * velocity + k * angle);
        }
    }
    Some(force)
}

/// One sum of ΔF and one count a bin.
type Binned = Vec<(f64, f64)>;

pub fn curve_and_map(residuals: &Residuals<'_>, draws: &Draws) -> (ForceCurve, ForceMap) {
    let time = time_since_onset::range_s(residuals)
        .and_then(|(low, high)| Grid::of_count(low, high, TIME_BINS));
    let plane = plane(residuals);
    let binned: Vec<(Binned, Binned)> = residuals
        .all
        .par_iter()
        .map(|one| {
            let force = missing_force_n(one).unwrap_or_default();
            let timed = residuals.is_timed(one);
            let over_time = bin(one, &force, TIME_BINS, |index| {
                time?.bin(one.time_s(index)).filter(|_| timed)
            });
            let over_plane = bin(one, &force, MAP_BINS * MAP_BINS, |index| {
                let (x, v) = &plane?;
                let (at_x, at_v) = grip(one)?;
                let l = one.seen.tightening.rig.lever_arm_m;
                Some(x.bin(l * at_x.get(index)?)? * MAP_BINS + v.bin(l * at_v.get(index)?)?)
            });
            (over_time, over_plane)
        })
        .collect();
    let curve = time.map_or_else(ForceCurve::default, |grid| {
        curve(&grid, &means(&binned, draws, TIME_BINS, |(curve, _)| curve))
    });
    let map = plane.map_or_else(ForceMap::default, |(x, v)| {
        let bins = MAP_BINS * MAP_BINS;
        map(&x, &v, &means(&binned, draws, bins, |(_, map)| map))
    });
    (curve, map)
}

/// Measured θ and ω.
fn grip<'a>(one: &White<'a>) -> Option<(&'a [f64], &'a [f64])> {
    let motion = &one.seen.tightening.motion;
    Some((
        motion.displacement_rad.as_deref()?,
        motion.velocity_rad_per_s.as_deref()?,
    ))
}

/// The grids of x and v that hold every measured sample.
fn plane(residuals: &Residuals<'_>) -> Option<(Grid, Grid)> {
    let all = || {
        let every = residuals.all.iter();
        every.filter_map(|one| Some((grip(one)?, one.seen.tightening.rig)))
    };
    let x = all().flat_map(|((x, _), rig)| x.iter().map(move |x| rig.lever_arm_m * x));
    let v = all().flat_map(|((_, v), rig)| v.iter().map(move |v| rig.lever_arm_m * v));
    let (x_low, x_high) = range(x)?;
    let (v_low, v_high) = range(v)?;
    Some((
        Grid::of_count(x_low, x_high, MAP_BINS)?,
        Grid::of_count(v_low, v_high, MAP_BINS)?,
    ))
}

/// Smallest and largest finite value.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .filter(|value| value.is_finite())
        .map(|value| (value, value))
        .reduce(|(low, high), (value, _)| (low.min(value), high.max(value)))
}

fn bin(
    one: &White<'_>,
    force: &[f64],
    bins: usize,
    bin_of: impl Fn(usize) -> Option<usize>,
) -> Binned {
    let mut binned = vec![(0.0, 0.0); bins];
    for (index, force) in force.iter().enumerate().skip(one.seen.unscored) {
        if let Some(bin) = bin_of(index) {
            binned[bin].0 += force;
            binned[bin].1 += 1.0;
        }
    }
    binned
}

/// Mean of every bin with its interval; `None` where no sample fell.
fn means(
    binned: &[(Binned, Binned)],
    draws: &Draws,
    bins: usize,
    of: impl Fn(&(Binned, Binned)) -> &Binned + Sync,
) -> Vec<Option<(f64, Option<Interval>)>> {
    (0..bins)
        .into_par_iter()
        .map(|bin| {
            let terms: Vec<Term> = binned
                .iter()
                .map(|one| of(one)[bin])
                .enumerate()
                .filter(|(_, (_, count))| *count > 0.0)
                .map(|(tightening, (numerator, denominator))| Term {
                    tightening,
                    numerator,
                    denominator,
                })
                .collect();
            let count: f64 = terms.iter().map(|term| term.denominator).sum();
            let sum: f64 = terms.iter().map(|term| term.numerator).sum();
            (count > 0.0).then(|| (sum / count, draws.interval(&terms)))
        })
        .collect()
}

/// Bins without a sample are left out, and the whole band where one bin has none.
fn curve(grid: &Grid, means: &[Option<(f64, Option<Interval>)>]) -> ForceCurve {
    let mut curve = ForceCurve::default();
    for (at, mean) in grid.centres().into_iter().zip(means) {
        let Some((force, interval)) = mean else {
            continue;
        };
        curve.at.push(at);
        curve.force_n.push(*force);
        if let Some(interval) = interval {
            curve.low_n.push(interval.low);
            curve.high_n.push(interval.high);
        }
    }
    if curve.low_n.len() < curve.at.len() {
        curve.low_n.clear();
        curve.high_n.clear();
    }
    curve
}

fn map(x: &Grid, v: &Grid, means: &[Option<(f64, Option<Interval>)>]) -> ForceMap {
    if means.iter().all(Option::is_none) {
        return ForceMap::default();
    }
    ForceMap {
        x_m: x.centres(),
        v_m_per_s: v.centres(),
        force_n: means
            .iter()
            .map(|mean| mean.map(|(force, _)| force))
            .collect(),
        half_width_n: means
            .iter()
            .map(|mean| mean.and_then(|(_, interval)| Some(0.5 * (interval?.high - interval?.low))))
            .collect(),
    }
}
