//! How much of a measured output there is to explain.

use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_least_squares::matrix::inner_product as dot;
use snug_signal::without_trend;

/// Σ of squares of the fitted output about its mean, over what is scored of all recordings; about the mean between two restarts where
/// the model is restarted, since what it takes up it need not explain.
pub(crate) fn power(cases: &[FitTask<'_>]) -> f64 {
    let of_case = |case: &FitTask<'_>| -> f64 {
        let stretches = case.input.stretches(case.unscored());
        stretches.map(|one| about_mean(&case.measured()[one])).sum()
    };
    cases.iter().map(of_case).sum()
}

/// Σ of squares of a `signal` of every sample, in the fitted output's place, about the uniform motion nearest to it between two restarts: a
/// straight line of a displacement, a constant velocity, no acceleration. Errors of the motion at a restart are nearly one.
pub(crate) fn bent_power(case: &FitTask<'_>, signal: &[f64]) -> f64 {
    let about_uniform = |stretch: &[f64]| match case.quantity() {
        Quantity::Displacement => {
            let beside = without_trend(stretch.to_vec());
            dot(&beside, &beside)
        }
        Quantity::Velocity => about_mean(stretch),
        Quantity::Acceleration => dot(stretch, stretch),
    };
    let stretches = case.input.stretches(case.unscored());
    stretches.map(|one| about_uniform(&signal[one])).sum()
}

fn about_mean(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|y| (y - mean).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_campaign::Rig;

    /// A parabola t² about its nearest line over −2..2: 2, −1, −2, −1, 2.
    #[test]
    fn what_bends_is_what_is_beside_a_uniform_motion() {
        let at = |of: fn(f64) -> f64| [-2.0, -1.0, 0.0, 1.0, 2.0].map(of);
        let power = |signal: &[f64], quantity| {
            let rig = Rig {
                lever_arm_m: 1.0,
                known_inertia_kg_m2: 0.0,
            };
            let nothing = vec![0.0; signal.len()];
            let case = FitTask::from_arrays(rig, 1e-3, nothing.clone(), quantity, nothing).unwrap();
            bent_power(&case, signal)
        };
        let bent = at(|t| 7.0 - 3.0 * t + t * t);
        assert!((power(&bent, Quantity::Displacement) - 14.0).abs() < 1e-9);
        let rising = at(|t| 4.0 + t);
        assert!(power(&rising, Quantity::Displacement) < 1e-9);
        assert!((power(&rising, Quantity::Velocity) - 10.0).abs() < 1e-9);
        assert!((power(&rising, Quantity::Acceleration) - 90.0).abs() < 1e-9);
        assert_eq!(power(&[3.0], Quantity::Displacement), 0.0);
    }
}
