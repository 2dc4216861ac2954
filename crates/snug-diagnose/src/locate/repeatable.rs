//! How much of the misfit comes back in other tightenings: the most that any missing effect could remove.
//!
//! b_i holds tightening i's whitened residual averaged over 5 ms bins from the onset on, each average times the root of its
//! samples, so that noise has unit variance; n_i is how many. u_i is the mean of b over other tightenings: over those with
//! the same strategy and joint where there are two, else over all. With three files and more, others are those in other
//! files. With z_i = u_i·b_i / ‖u_i‖ (b_i's length along what the others do, sign included)
//!
//! repeatable_share = Σ sgn(z_i) max(z_i² − 1, 0) / Σ (‖b_i‖² − n_i), clamped to 0..1.
//!
//! Each tightening may have the others' shape in a size of its own; misfit whose sign or shape changes from one to the
//! next cancels. Where the noise is not known nothing is subtracted: Σ sgn(z_i) z_i² / Σ ‖b_i‖².

use super::residual::{Residuals, White};
use crate::locate::thresholds::{BIN_S, ENOUGH_ALIKE, ENOUGH_FILES};
use rayon::prelude::*;

/// One tightening's averages and where it belongs.
struct Averaged {
    bins: Vec<Option<f64>>,
    file: usize,
    alike: usize,
}

/// Sum of the averages of a group of tightenings, and of how many each bin's is.
#[derive(Clone)]
struct Total {
    sum: Vec<f64>,
    count: Vec<f64>,
    members: f64,
}

/// The larger of what comes back over time and of `over_motion`, what comes back as a force over displacement and velocity.
///
/// `None` with fewer than two tightenings that have an onset, where nothing comes back over the motion either.
pub fn share(residuals: &Residuals<'_>, over_motion: Option<f64>) -> Option<f64> {
    let over_motion = over_motion.map(|share| share.clamp(0.0, 1.0));
    match (over_time(residuals), over_motion) {
        (Some(time), Some(motion)) => Some(time.max(motion)),
        (time, motion) => time.or(motion),
    }
}

/// What comes back over the time since the onset.
fn over_time(residuals: &Residuals<'_>) -> Option<f64> {
    let timed: Vec<&White<'_>> = residuals
        .all
        .iter()
        .filter(|one| one.seen.tightening.onset.is_some())
        .collect();
    if timed.len() < 2 {
        return None;
    }
    if !residuals.beyond_noise {
        return Some(0.0);
    }
    let averaged = averages(&timed);
    let files = averaged.iter().map(|one| one.file).max()? + 1;
    let totals = Totals::of(&averaged, files >= ENOUGH_FILES);
    let floor = if residuals.noise_known { 1.0 } else { 0.0 };
    let (mut predicted, mut excess) = (0.0, 0.0);
    for one in &averaged {
        let (length, square, bins) = along(one, &totals.others(one));
        predicted += length.signum() * (length * length - floor).max(0.0);
        excess += square - floor * bins;
    }
    (excess > 0.0).then(|| (predicted / excess).clamp(0.0, 1.0))
}

/// Sums over everyone, over files, over conditions and over both.
struct Totals {
    everyone: Total,
    alike: Vec<Total>,
    /// Per file: all of it, and its part under each condition; empty where only the tightening itself is left out.
    files: Vec<(Total, Vec<Total>)>,
}

impl Totals {
    fn of(averaged: &[Averaged], own_file_out: bool) -> Self {
        let length = averaged.iter().map(|one| one.bins.len()).max().unwrap_or(0);
        let most = |of: fn(&Averaged) -> usize| averaged.iter().map(of).max().map_or(0, |n| n + 1);
        let conditions = vec![Total::zero(length); most(|one| one.alike)];
        let mut totals = Self {
            everyone: Total::zero(length),
            files: match own_file_out {
                true => vec![(Total::zero(length), conditions.clone()); most(|one| one.file)],
                false => Vec::new(),
            },
            alike: conditions,
        };
        for one in averaged {
            totals.everyone.add(one);
            totals.alike[one.alike].add(one);
            if let Some((all, alike)) = totals.files.get_mut(one.file) {
                all.add(one);
                alike[one.alike].add(one);
            }
        }
        totals
    }

    /// What predicts `one`: those alike where there are enough, else everyone, without its own file (or itself).
    fn others(&self, one: &Averaged) -> Total {
        let mut itself = Total::zero(self.everyone.sum.len());
        itself.add(one);
        let (out, out_alike) = match self.files.get(one.file) {
            Some((all, alike)) => (all, &alike[one.alike]),
            None => (&itself, &itself),
        };
        let alike = self.alike[one.alike].without(out_alike);
        if alike.members >= ENOUGH_ALIKE {
            alike
        } else {
            self.everyone.without(out)
        }
    }
}

/// z, ‖b‖² and n of one tightening.
fn along(one: &Averaged, others: &Total) -> (f64, f64, f64) {
    let (mut inner, mut norm, mut square, mut bins) = (0.0, 0.0, 0.0, 0.0);
    for (index, value) in one.bins.iter().enumerate() {
        let Some(value) = value else { continue };
        square += value * value;
        bins += 1.0;
        let (sum, count) = (others.sum[index], others.count[index]);
        if count > 0.0 {
            inner += value * sum / count;
            norm += (sum / count) * (sum / count);
        }
    }
    let length = if norm > 0.0 { inner / norm.sqrt() } else { 0.0 };
    (length, square, bins)
}

impl Total {
    fn zero(bins: usize) -> Self {
        Self {
            sum: vec![0.0; bins],
            count: vec![0.0; bins],
            members: 0.0,
        }
    }

    fn add(&mut self, one: &Averaged) {
        self.members += 1.0;
        for (index, value) in one.bins.iter().enumerate() {
            if let Some(value) = value {
                self.sum[index] += value;
                self.count[index] += 1.0;
            }
        }
    }

    fn without(&self, part: &Self) -> Self {
        let minus = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
        Self {
            sum: minus(&self.sum, &part.sum),
            count: minus(&self.count, &part.count),
            members: self.members - part.members,
        }
    }
}

/// Averages over the bins since the onset; whole bins only.
fn averages(timed: &[&White<'_>]) -> Vec<Averaged> {
    let position = |names: &mut Vec<String>, name: String| {
        names
            .iter()
            .position(|known| *known == name)
            .unwrap_or_else(|| {
                names.push(name);
                names.len() - 1
            })
    };
    let (mut files, mut conditions) = (Vec::new(), Vec::new());
    let places: Vec<(usize, usize)> = timed
        .iter()
        .map(|one| {
            let tightening = one.seen.tightening;
            let condition = &tightening.conditions;
            let words = format!("{:?} {:?}", condition.strategy, condition.joint);
            (
                position(&mut files, tightening.id.file.clone()),
                position(&mut conditions, words),
            )
        })
        .collect();
    timed
        .par_iter()
        .zip(places)
        .map(|(one, (file, alike))| Averaged {
            bins: bins(one),
            file,
            alike,
        })
        .collect()
}

fn bins(one: &White<'_>) -> Vec<Option<f64>> {
    let onset = one.seen.tightening.onset.unwrap_or(0);
    let interval_s = one.seen.tightening.time_base.interval_s;
    let length = ((BIN_S / interval_s).round() as usize).max(1);
    let bins = one.samples().end.saturating_sub(onset) / length;
    (0..bins)
        .map(|bin| {
            let from = (onset + bin * length).checked_sub(one.first)?;
            let values = &one.values[from..from + length];
            Some(values.iter().sum::<f64>() / (length as f64).sqrt())
        })
        .collect()
}
