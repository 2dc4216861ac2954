//! What preparation says of the tightenings: what it took out, and the noise it measured.

use snug_campaign::{CorrectedEffect, NoiseSource, NoiseStatement, Quantity};
use snug_identify::FitTask;

/// Sensor errors that were measured in the quiet part and taken out, with their typical size where they are significant.
pub(crate) fn corrected(cases: &[FitTask<'_>]) -> Vec<CorrectedEffect> {
    let mut corrected: Vec<CorrectedEffect> = Vec::new();
    let all = || cases.iter().flat_map(|case| &case.tightening.corrections);
    for correction in all() {
        if corrected
            .iter()
            .any(|known| known.effect == correction.effect)
        {
            continue;
        }
        let same: Vec<_> = all()
            .filter(|other| other.effect == correction.effect)
            .collect();
        let significant: Vec<f64> = (same.iter().filter(|c| c.significant))
            .map(|c| c.value)
            .collect();
        if significant.is_empty() {
            continue;
        }
        let squares: f64 = significant.iter().map(|value| value * value).sum();
        corrected.push(CorrectedEffect {
            effect: correction.effect.clone(),
            share: significant.len() as f64 / same.len() as f64,
            size: (squares / significant.len() as f64).sqrt(),
            unit: correction.unit.clone(),
        });
    }
    corrected
}

/// Where the noise comes from that errors are compared with, and how large it is in the acceleration.
pub(crate) fn noise(cases: &[FitTask<'_>]) -> NoiseStatement {
    let floors: Vec<_> = cases
        .iter()
        .filter_map(|case| case.tightening.noise.as_ref())
        .collect();
    let source = floors
        .first()
        .map_or(NoiseSource::Residual, |floor| floor.source);
    let squares: Vec<f64> = floors
        .iter()
        .filter(|floor| floor.quantity == Quantity::Acceleration)
        .map(|floor| floor.standard_deviation.powi(2))
        .collect();
    NoiseStatement {
        source: match source {
            NoiseSource::PreRoll => "pre_roll",
            NoiseSource::Repeats => "repeats",
            NoiseSource::Declared => "declared",
            NoiseSource::Residual => "residual",
        }
        .to_owned(),
        acceleration_rad_per_s2: (!squares.is_empty())
            .then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()),
    }
}
