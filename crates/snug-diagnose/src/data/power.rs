//! How much of a measured output there is to explain.

use snug_campaign::Quantity;
use snug_identify::FitTask;

/// Σ of squares of the fitted output about its mean, over what is scored of all recordings; about the mean between two restarts where
/// the model is restarted, since what it takes up it need not explain.
pub(crate) fn power(cases: &[FitTask<'_>]) -> f64 {
    let about_mean = |values: &[f64]| -> f64 {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|y| (y - mean).powi(2)).sum()
    };
    let of_case = |case: &FitTask<'_>| -> f64 {
        let scored = &case.measured()[case.unscored()..];
        let apart = case.input.samples_between_restarts();
        (scored
            .chunks(apart.unwrap_or(scored.len()).max(1))
            .map(about_mean))
        .sum()
    };
    cases.iter().map(of_case).sum()
}

/// Σ of squares of a `signal` in the fitted output's place about the uniform motion nearest to it between two restarts, over what is scored
/// of a recording: a straight line of a displacement, a constant velocity, no acceleration. Errors of the motion at a restart are nearly one.
pub(crate) fn bent_power(case: &FitTask<'_>, signal: &[f64]) -> f64 {
    let scored = &signal[case.unscored()..];
    let apart = case.input.samples_between_restarts();
    let stretches = scored.chunks(apart.unwrap_or(scored.len()).max(1));
    let about = stretches.map(|stretch| about_uniform(stretch, case.quantity()));
    about.sum()
}

/// Σ of squares about the nearest uniform motion.
fn about_uniform(stretch: &[f64], quantity: Quantity) -> f64 {
    let squares = |values: &[f64]| values.iter().map(|y| y * y).sum::<f64>();
    let whole = squares(stretch);
    let middle = 0.5 * (stretch.len() as f64 - 1.0);
    let times: Vec<f64> = (0..stretch.len()).map(|i| i as f64 - middle).collect();
    let mean = stretch.iter().sum::<f64>() / stretch.len() as f64;
    let of_mean = stretch.len() as f64 * mean * mean;
    let along: f64 = times.iter().zip(stretch).map(|(t, y)| t * y).sum();
    let of_slope = along * along / squares(&times).max(f64::MIN_POSITIVE);
    let left = match quantity {
        Quantity::Displacement => whole - of_mean - of_slope,
        Quantity::Velocity => whole - of_mean,
        Quantity::Acceleration => whole,
    };
    left.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola t² about its nearest line over −2..2: 2, −1, −2, −1, 2.
    #[test]
    fn what_bends_is_what_is_beside_a_uniform_motion() {
        let at = |of: fn(f64) -> f64| [-2.0, -1.0, 0.0, 1.0, 2.0].map(of);
        let bent = at(|t| 7.0 - 3.0 * t + t * t);
        assert!((about_uniform(&bent, Quantity::Displacement) - 14.0).abs() < 1e-9);
        let rising = at(|t| 4.0 + t);
        assert!(about_uniform(&rising, Quantity::Displacement) < 1e-9);
        assert!((about_uniform(&rising, Quantity::Velocity) - 10.0).abs() < 1e-9);
        assert!((about_uniform(&rising, Quantity::Acceleration) - 90.0).abs() < 1e-9);
        assert_eq!(about_uniform(&[3.0], Quantity::Displacement), 0.0);
    }
}
