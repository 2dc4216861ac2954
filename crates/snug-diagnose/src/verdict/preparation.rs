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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{close, exact};
    use snug_campaign::{Correction, NoiseFloor};

    fn with_corrections(corrections: &[(&str, f64, bool)]) -> FitTask<'static> {
        let mut case = exact(0, &[], &[]);
        let corrections = corrections
            .iter()
            .map(|&(effect, value, significant)| Correction {
                effect: effect.to_owned(),
                constant_of: Some(Quantity::Acceleration),
                value,
                standard_error: 0.01,
                unit: "rad/s^2".to_owned(),
                significant,
            });
        case.tightening.to_mut().corrections = corrections.collect();
        case
    }

    /// 0.3 and −0.4 are significant, in two tightenings of three: √((0.09 + 0.16) / 2).
    #[test]
    fn the_typical_size_of_what_was_taken_out_is_that_of_where_it_was_significant() {
        let cases = [
            with_corrections(&[("acceleration_bias", 0.3, true)]),
            with_corrections(&[("acceleration_bias", -0.4, true)]),
            with_corrections(&[("acceleration_bias", 5e-3, false)]),
        ];
        let corrected = corrected(&cases);
        assert_eq!(corrected.len(), 1, "one effect is told of once");
        assert_eq!(corrected[0].effect, "acceleration_bias");
        assert_eq!(corrected[0].unit, "rad/s^2");
        close(corrected[0].share, 2.0 / 3.0, 1e-12);
        close(corrected[0].size, 0.125_f64.sqrt(), 1e-12);
    }

    #[test]
    fn what_is_nowhere_significant_is_not_told_of() {
        let cases = [with_corrections(&[
            ("acceleration_bias", 0.01, false),
            ("gravity_leakage", 0.2, true),
        ])];
        let corrected = corrected(&cases);
        let effects: Vec<&str> = corrected.iter().map(|one| one.effect.as_str()).collect();
        assert_eq!(effects, ["gravity_leakage"]);
    }

    fn with_noise(noise: Option<NoiseFloor>) -> FitTask<'static> {
        let mut case = exact(0, &[], &[]);
        case.tightening.to_mut().noise = noise;
        case
    }

    /// √((3² + 4²) / 2); a displacement's noise is in another unit.
    #[test]
    fn the_noise_of_the_acceleration_is_the_root_mean_square_of_those_known() {
        let white = |quantity, sd| with_noise(Some(NoiseFloor::white(quantity, sd)));
        let cases = [
            white(Quantity::Acceleration, 3.0),
            with_noise(None),
            white(Quantity::Displacement, 1e3),
            white(Quantity::Acceleration, 4.0),
        ];
        let statement = noise(&cases);
        close(
            statement.acceleration_rad_per_s2.expect("two know it"),
            12.5_f64.sqrt(),
            1e-12,
        );
        assert_eq!(statement.source, "declared");
    }

    #[test]
    fn without_a_floor_the_residual_stands_for_the_noise() {
        let statement = noise(&[with_noise(None)]);
        assert_eq!(statement.acceleration_rad_per_s2, None);
        assert_eq!(statement.source, "residual");
    }
}
