//! Velocity and displacement by the trapezoidal rule where the rig measures a higher derivative only.

use snug_campaign::{Motion, Quantity};

/// Cumulative integral by the trapezoidal rule, zero at the first sample.
///
/// y_0 = 0, y_i = y_{i−1} + (u_{i−1} + u_i) Δt / 2: as many values as `samples` has, in its unit times seconds (the same
/// as MATLAB's `cumtrapz` and SciPy's `cumulative_trapezoid(initial=0)`).
pub fn cumulative_trapezoid(samples: &[f64], interval_s: f64) -> Vec<f64> {
    let mut integral = Vec::with_capacity(samples.len());
    let mut sum = 0.0;
    let mut previous = None;
    for &sample in samples {
        if let Some(previous) = previous {
            sum += 0.5 * (previous + sample);
        }
        integral.push(sum * interval_s);
        previous = Some(sample);
    }
    integral
}

/// Fills in velocity and displacement that were not measured, from rest at the first sample.
pub(crate) fn complete(motion: &mut Motion, interval_s: f64) {
    for (derivative, quantity) in [
        (Quantity::Acceleration, Quantity::Velocity),
        (Quantity::Velocity, Quantity::Displacement),
    ] {
        if motion.get(quantity).is_none()
            && let Some(samples) = motion.get(derivative)
        {
            let integral = cumulative_trapezoid(samples, interval_s);
            motion.set(quantity, integral);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_for_straight_lines() {
        let interval_s = 1e-3;
        let ramp: Vec<f64> = (0..1001)
            .map(|i| 2.0 - 3.0 * f64::from(i) * interval_s)
            .collect();
        for (index, value) in cumulative_trapezoid(&ramp, interval_s).iter().enumerate() {
            let time_s = index as f64 * interval_s;
            assert!((value - (2.0 * time_s - 1.5 * time_s * time_s)).abs() < 1e-13);
        }
    }

    #[test]
    fn double_integral_of_a_sine_has_the_rule_s_error() {
        // Error bound of the composite rule: T Δt² max|f''| / 12, here 1 · 1e-8 · ω² / 12.
        let (interval_s, omega) = (1e-4, 40.0);
        let mut motion = Motion {
            acceleration_rad_per_s2: Some(
                (0..10_001)
                    .map(|i| (omega * f64::from(i) * interval_s).sin())
                    .collect(),
            ),
            ..Motion::default()
        };
        complete(&mut motion, interval_s);
        let velocity = motion.velocity_rad_per_s.expect("completed");
        let displacement = motion.displacement_rad.expect("completed");
        let bound = interval_s * interval_s * omega * omega / 12.0;
        for (index, (v, x)) in velocity.iter().zip(&displacement).enumerate() {
            let time_s = index as f64 * interval_s;
            assert!((v - (1.0 - (omega * time_s).cos()) / omega).abs() < bound);
            let exact = time_s / omega - (omega * time_s).sin() / (omega * omega);
            assert!((x - exact).abs() < 2.0 * bound);
        }
    }

    #[test]
    fn agrees_with_scipy() {
        // scipy.integrate.cumulative_trapezoid([1, 4, -2, 0.5, 7], dx=0.1, initial=0), SciPy 1.x.
        let expected = [0.0, 0.25, 0.35, 0.275, 0.65];
        let result = cumulative_trapezoid(&[1.0, 4.0, -2.0, 0.5, 7.0], 0.1);
        for (value, expected) in result.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn measured_quantities_stay_as_measured() {
        let mut motion = Motion {
            displacement_rad: Some(vec![5.0, 5.0]),
            acceleration_rad_per_s2: Some(vec![1.0, 1.0]),
            ..Motion::default()
        };
        complete(&mut motion, 1.0);
        assert_eq!(motion.displacement_rad, Some(vec![5.0, 5.0]));
        assert_eq!(motion.velocity_rad_per_s, Some(vec![0.0, 1.0]));
    }
}
