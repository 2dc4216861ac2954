//! Model against measurement, in units, in percent and in multiples of the noise.

use super::Seen;
use rayon::prelude::*;
use snug_campaign::{Comparison, Misfit, Quantity, TighteningMisfit};
use snug_identify::Whitening;
use snug_model::inverse_dynamics_force;

/// What is compared, in the order it is told.
const COMPARED: [(&str, &str, Option<Quantity>); 4] = [
    ("acceleration", "rad/s²", Some(Quantity::Acceleration)),
    ("velocity", "rad/s", Some(Quantity::Velocity)),
    ("displacement", "rad", Some(Quantity::Displacement)),
    ("force", "N", None),
];

/// Sums from which a misfit follows; they add up over tightenings.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    samples: f64,
    /// Σ (y − ŷ)².
    misfit: f64,
    /// Σ (y − ȳ)² with the tightening's own mean.
    spread: f64,
    /// Σ y².
    size: f64,
    largest: f64,
    /// Σ w² and how many.
    white: f64,
    white_samples: f64,
}

pub fn compare(seen: &[Seen<'_>]) -> Comparison {
    let sums: Vec<Option<[Option<Sums>; 4]>> = seen
        .par_iter()
        .map(|one| {
            let own = COMPARED.map(|(_, _, quantity)| of_quantity(one, quantity));
            let finite = own.iter().flatten().all(|sums| sums.misfit.is_finite());
            (finite && own.iter().any(Option::is_some)).then_some(own)
        })
        .collect();
    let mut pooled = [None; 4];
    for own in sums.iter().flatten() {
        for (pooled, own) in pooled.iter_mut().zip(own) {
            if let Some(own) = own {
                *pooled = Some(sum(pooled.unwrap_or_default(), own));
            }
        }
    }
    let mut tightenings: Vec<TighteningMisfit> = seen
        .iter()
        .zip(&sums)
        .filter_map(|(one, own)| {
            own.as_ref().map(|own| TighteningMisfit {
                id: one.tightening.id.clone(),
                misfits: misfits(own),
            })
        })
        .collect();
    tightenings.sort_by(|a, b| {
        let (a, b) = (badness(&a.misfits), badness(&b.misfits));
        b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    Comparison {
        pooled: misfits(&pooled),
        tightenings,
    }
}

/// Measured and simulated signal of one entry of `COMPARED`, scored part only.
fn of_quantity(seen: &Seen<'_>, quantity: Option<Quantity>) -> Option<Sums> {
    let kinematic = quantity.unwrap_or(Quantity::Acceleration);
    let tightening = seen.tightening;
    let measured = tightening.motion.get(kinematic)?.get(seen.unscored..)?;
    let simulated = seen.simulated.get(kinematic)?.get(seen.unscored..)?;
    if measured.is_empty() || simulated.is_empty() {
        return None;
    }
    if quantity.is_some() {
        let mut sums = unweighted(measured, simulated);
        if let Some(whitening) = Whitening::of(tightening, kinematic) {
            let residual: Vec<f64> = measured.iter().zip(simulated).map(|(y, s)| y - s).collect();
            let mut white = vec![0.0; residual.len().saturating_sub(whitening.order())];
            whitening.apply(&residual, &mut white);
            sums.white = white.iter().map(|w| w * w).sum();
            sums.white_samples = white.len() as f64;
        }
        return Some(sums);
    }
    let torque = tightening.torque_nm.get(seen.unscored..)?;
    let force = |acceleration| inverse_dynamics_force(&tightening.rig, torque, acceleration);
    Some(unweighted(&force(measured), &force(simulated)))
}

fn unweighted(measured: &[f64], simulated: &[f64]) -> Sums {
    let mean = measured.iter().sum::<f64>() / measured.len() as f64;
    let mut sums = Sums::default();
    for (y, s) in measured.iter().zip(simulated) {
        let error = y - s;
        sums.samples += 1.0;
        sums.misfit += error * error;
        sums.spread += (y - mean) * (y - mean);
        sums.size += y * y;
        sums.largest = sums.largest.max(error.abs());
    }
    sums
}

fn sum(a: Sums, b: &Sums) -> Sums {
    Sums {
        samples: a.samples + b.samples,
        misfit: a.misfit + b.misfit,
        spread: a.spread + b.spread,
        size: a.size + b.size,
        largest: a.largest.max(b.largest),
        white: a.white + b.white,
        white_samples: a.white_samples + b.white_samples,
    }
}

fn misfits(sums: &[Option<Sums>; 4]) -> Vec<Misfit> {
    COMPARED
        .iter()
        .zip(sums)
        .filter_map(|((name, unit, _), sums)| {
            sums.map(|sums| Misfit {
                quantity: (*name).to_owned(),
                unit: (*unit).to_owned(),
                rms: (sums.misfit / sums.samples).sqrt(),
                largest: sums.largest,
                fit_percent: (sums.spread > 0.0)
                    .then(|| 100.0 * (1.0 - (sums.misfit / sums.spread).sqrt())),
                relative_percent: (sums.size > 0.0)
                    .then(|| 100.0 * (sums.misfit / sums.size).sqrt()),
                over_noise: (sums.white_samples > 0.0)
                    .then(|| (sums.white / sums.white_samples).sqrt()),
            })
        })
        .collect()
}

/// How bad a tightening is: by its error over noise (−1 without) and then by 100 − fit of the first quantity.
fn badness(misfits: &[Misfit]) -> (f64, f64) {
    let over_noise = misfits.iter().find_map(|misfit| misfit.over_noise);
    let fit = misfits.iter().find_map(|misfit| misfit.fit_percent);
    (
        over_noise.unwrap_or(-1.0),
        fit.map_or(f64::NEG_INFINITY, |fit| 100.0 - fit),
    )
}
