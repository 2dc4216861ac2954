//! The whitened residuals that every way of looking shares.

use super::Seen;
use crate::locate::thresholds::{BEYOND_CHANCE, SMALLEST_EXCESS};
use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_identify::Whitening;

/// The whitened residual of one tightening: `values[i]` belongs to sample `first + i`.
pub struct White<'a> {
    pub seen: Seen<'a>,
    pub first: usize,
    pub values: Vec<f64>,
}

impl White<'_> {
    /// Time of sample `index` since the onset \[s\] (since the window's start where there is none).
    pub fn time_s(&self, index: usize) -> f64 {
        let onset = self.seen.tightening.onset.unwrap_or(0) as f64;
        (index as f64 - onset) * self.interval_s()
    }

    /// Time from sample to sample \[s\].
    pub fn interval_s(&self) -> f64 {
        self.seen.tightening.time_base.interval_s
    }

    /// Sample indices that `values` belong to.
    pub fn samples(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.values.len()
    }
}

/// The residuals of all tightenings that can be compared.
pub struct Residuals<'a> {
    pub all: Vec<White<'a>>,
    /// Whether `values` are in multiples of a known noise; else of their own pooled rms.
    pub noise_known: bool,
    /// What is compared.
    pub quantity: Quantity,
    /// What the residual was multiplied with where the noise is not known, one over the residual's
    /// unit; 1 where it is, no unit.
    pub scale: f64,
    /// Whether some tightening has an onset; then those without are left out of everything that counts from it.
    pub has_onset: bool,
    /// √(Σ w² / n) over everything.
    pub error_over_noise: f64,
    /// Σ (w² − 1), or Σ w² where the noise is not known; no unit.
    pub excess: f64,
    /// Whether the excess is more than chance and an imperfectly known floor give.
    pub beyond_noise: bool,
}

impl<'a> Residuals<'a> {
    /// Residuals in the quantity whose noise is known, else in the first measured of acceleration, velocity,
    /// displacement.
    pub fn of(seen: &[Seen<'a>]) -> Self {
        let known = seen.iter().find_map(|one| noise_quantity(one));
        let quantity = known.or_else(|| {
            [
                Quantity::Acceleration,
                Quantity::Velocity,
                Quantity::Displacement,
            ]
            .into_iter()
            .find(|&quantity| seen.iter().any(|one| difference(one, quantity).is_some()))
        });
        let mut all: Vec<White<'a>> = match quantity {
            Some(quantity) => seen
                .par_iter()
                .filter_map(|one| white(one, quantity, known.is_some()))
                .collect(),
            None => Vec::new(),
        };
        let (mut square, samples) = totals(&all);
        let mut scale = 1.0;
        if known.is_none() && square > 0.0 {
            scale = (samples / square).sqrt();
            all.iter_mut()
                .flat_map(|one| &mut one.values)
                .for_each(|value| *value *= scale);
            square = samples;
        }
        let excess = if known.is_some() {
            square - samples
        } else {
            square
        };
        let error_over_noise = (square / samples.max(1.0)).sqrt();
        let beyond_noise = known.is_none()
            || (excess > BEYOND_CHANCE * chance(&all) && error_over_noise > 1.0 + SMALLEST_EXCESS);
        Self {
            has_onset: all.iter().any(|one| one.seen.tightening.onset.is_some()),
            noise_known: known.is_some(),
            quantity: quantity.unwrap_or(Quantity::Acceleration),
            scale,
            error_over_noise,
            excess,
            beyond_noise,
            all,
        }
    }

    /// Whether times of this tightening mean the same as everybody's.
    pub fn is_timed(&self, one: &White<'_>) -> bool {
        !self.has_onset || one.seen.tightening.onset.is_some()
    }
}

/// The quantity whose noise is known, if it was measured and its noise can be whitened.
fn noise_quantity(seen: &Seen<'_>) -> Option<Quantity> {
    let noise = seen.tightening.noise.as_ref()?;
    Whitening::new(noise)?;
    difference(seen, noise.quantity).map(|_| noise.quantity)
}

/// Measured − simulated of every sample; `None` where one of the two is missing or not finite.
pub fn difference(seen: &Seen<'_>, quantity: Quantity) -> Option<Vec<f64>> {
    let measured = seen.tightening.motion.get(quantity)?;
    let simulated = seen.simulated.get(quantity)?;
    let residual: Vec<f64> = measured.iter().zip(simulated).map(|(y, s)| y - s).collect();
    residual.iter().all(|r| r.is_finite()).then_some(residual)
}

fn white<'a>(seen: &Seen<'a>, quantity: Quantity, noise_known: bool) -> Option<White<'a>> {
    let residual = difference(seen, quantity)?;
    let scored = residual.get(seen.unscored..)?;
    let whitening = match noise_known {
        true => Some(Whitening::of(seen.tightening, quantity)?),
        false => None,
    };
    let order = whitening.as_ref().map_or(0, Whitening::order);
    let count = scored.len().checked_sub(order).filter(|&count| count > 0)?;
    let mut values = vec![0.0; count];
    match whitening {
        Some(whitening) => whitening.apply(scored, &mut values),
        None => values.copy_from_slice(scored),
    }
    Some(White {
        seen: *seen,
        first: seen.unscored + order,
        values,
    })
}

fn totals(all: &[White<'_>]) -> (f64, f64) {
    all.iter().fold((0.0, 0.0), |(square, samples), one| {
        let own: f64 = one.values.iter().map(|w| w * w).sum();
        (square + own, samples + one.values.len() as f64)
    })
}

/// Standard deviation of Σ (w² − 1) of Gaussian noise, of which each floor was estimated from so many samples.
fn chance(all: &[White<'_>]) -> f64 {
    let variance: f64 = all
        .iter()
        .map(|one| {
            let samples = one.values.len() as f64;
            let noise = one.seen.tightening.noise.as_ref();
            let floor = noise.map_or(0.0, |noise| samples / noise.samples.max(1) as f64);
            2.0 * samples * (1.0 + floor)
        })
        .sum();
    variance.sqrt()
}
