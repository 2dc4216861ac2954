//! What follows from m, c and k, with its 95 % interval by the delta method: variance gᵀ C g with the gradient g of the
//! quantity and the joint covariance C of the parameters.

use snug_campaign::{Estimate, Interval, NORMAL_95, Rig};
use snug_model::{damped_frequency_hz, damping_ratio, natural_frequency_hz};
use std::f64::consts::PI;

/// An interval narrower than this share of the value is rounding \[–\]: a constraint or fixed parameters hold the value there. Chosen.
const HELD_RATIO: f64 = 1e-6;

/// A quantity that follows from the estimated parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derived {
    /// Its value, in the unit that its function states.
    pub value: f64,
    /// 95 % interval; `None` where the data do not decide the value (parameters fixed, or held by a constraint).
    pub interval: Option<Interval>,
}

/// √(k/m) / 2π \[Hz\] of the hand–arm alone.
pub fn natural_frequency(estimate: &Estimate) -> Option<Derived> {
    let [m, _, k] = base(estimate);
    let value = natural_frequency_hz(m, k)?;
    let gradient = [-0.5 * value / m, 0.0, 0.5 * value / k];
    Some(with_interval(value, gradient, 0.0, estimate))
}

/// √(K/I − C²/4I²) / 2π \[Hz\] of tool and hand–arm together, with K = k l², C = c l², I = I_n + m l²; `None` when
/// overdamped.
pub fn damped_frequency(rig: &Rig, estimate: &Estimate) -> Option<Derived> {
    let [m, c, k] = base(estimate);
    let value = damped_frequency_hz(rig, m, c, k)?;
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let inertia = rig.known_inertia_kg_m2 + m * square;
    let (stiffness, damping) = (k * square, c * square);
    let per_square = 1.0 / (8.0 * PI * PI * value);
    let by_inertia = (0.5 * damping * damping / inertia - stiffness) / (inertia * inertia);
    let gradient = [
        per_square * square * by_inertia,
        -per_square * square * 0.5 * damping / (inertia * inertia),
        per_square * square / inertia,
    ];
    Some(with_interval(value, gradient, 0.0, estimate))
}

/// ζ = c l² / (2 √(k l² (I_n + m l²))) of tool and hand–arm together.
pub fn damping(rig: &Rig, estimate: &Estimate) -> Option<Derived> {
    let [m, c, k] = base(estimate);
    let value = damping_ratio(rig, m, c, k)?;
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let inertia = rig.known_inertia_kg_m2 + m * square;
    let gradient = [
        -0.5 * value * square / inertia,
        damping_ratio(rig, m, 1.0, k)?,
        -0.5 * value / k,
    ];
    Some(with_interval(value, gradient, f64::NEG_INFINITY, estimate))
}

/// m, c, k: an estimate's parameters begin with them.
fn base(estimate: &Estimate) -> [f64; 3] {
    std::array::from_fn(|index| estimate.parameters[index].value)
}

fn with_interval(value: f64, gradient: [f64; 3], least: f64, estimate: &Estimate) -> Derived {
    let half = half_width(gradient, estimate).filter(|half| *half > HELD_RATIO * value.abs());
    Derived {
        value,
        interval: half.map(|half| Interval {
            low: (value - half).max(least),
            high: value + half,
        }),
    }
}

/// 1.96 √(gᵀ C g); `None` where one of the parameters that matter is free, but has no interval.
fn half_width(gradient: [f64; 3], estimate: &Estimate) -> Option<f64> {
    let free: Vec<usize> = (0..estimate.parameters.len())
        .filter(|&index| !estimate.parameters[index].fixed)
        .collect();
    if estimate.covariance.len() != free.len() * free.len() {
        return None;
    }
    let derivative = |index: usize| gradient.get(index).copied().unwrap_or(0.0);
    let mut any = false;
    let mut variance = 0.0;
    for (row, &first) in free.iter().enumerate() {
        any |= derivative(first) != 0.0 && estimate.parameters[first].interval.is_some();
        for (column, &second) in free.iter().enumerate() {
            let covariance = estimate.covariance[row * free.len() + column];
            variance += derivative(first) * covariance * derivative(second);
        }
    }
    let half = NORMAL_95 * variance.max(0.0).sqrt();
    (any && half.is_finite()).then_some(half)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_campaign::{FitStatus, Identifiability, ParameterEstimate};

    const RIG: Rig = Rig {
        lever_arm_m: 0.33,
        known_inertia_kg_m2: 0.275,
    };

    fn estimate(fixed: [bool; 3], covariance: Vec<f64>) -> Estimate {
        let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
        let values = [2.1, 104.0, 2450.0];
        let parameters = (0..3)
            .map(|index| ParameterEstimate {
                name: names[index].into(),
                unit: String::new(),
                value: values[index],
                standard_error: None,
                interval: (!fixed[index]).then_some(Interval {
                    low: 0.0,
                    high: 1.0,
                }),
                fixed: fixed[index],
            })
            .collect();
        Estimate {
            parameters,
            covariance,
            status: FitStatus::Converged,
            active_constraints: vec![],
            identifiability: Identifiability {
                rank: 3,
                free: 3,
                condition: 1.0,
                strongest_correlation: None,
            },
            iterations: 1,
            evaluations: 1,
            conic_solves: 0,
        }
    }

    /// Half widths by complex-step differentiation in NumPy 2; four million draws of the parameters agree to 4e-4.
    #[test]
    fn intervals_agree_with_complex_step_and_monte_carlo() {
        let covariance = vec![
            0.0025, 0.0165, 0.78, 0.0165, 1.21, -5.72, 0.78, -5.72, 676.0,
        ];
        let estimate = estimate([false; 3], covariance);
        for (found, value, half) in [
            (
                natural_frequency(&estimate),
                5.43617622007251,
                0.1033432917105551,
            ),
            (
                damped_frequency(&RIG, &estimate),
                3.196218390608496,
                0.0480834653453951,
            ),
            (
                damping(&RIG, &estimate),
                0.4884865124799627,
                0.013259605806480081,
            ),
        ] {
            let found = found.unwrap();
            let interval = found.interval.unwrap();
            assert!((found.value / value - 1.0).abs() < 1e-12);
            assert!((interval.high - found.value - half).abs() < 1e-12 * value);
            assert!((found.value - interval.low - half).abs() < 1e-12 * value);
        }
    }

    #[test]
    fn what_the_data_do_not_decide_has_no_interval() {
        // Only c is free: √(k/m) is given, ζ is not. dζ = ζ dc/c.
        let only_damping = estimate([true, false, true], vec![1.21]);
        assert_eq!(natural_frequency(&only_damping).unwrap().interval, None);
        let ratio = damping(&RIG, &only_damping).unwrap();
        let half = NORMAL_95 * 1.1 * ratio.value / 104.0;
        assert!((ratio.interval.unwrap().high - ratio.value - half).abs() < 1e-12);
        // Along an active light damping the covariance leaves ζ no freedom.
        let held = estimate([false; 3], vec![0.0; 9]);
        assert_eq!(damping(&RIG, &held).unwrap().interval, None);
    }

    #[test]
    fn a_frequency_is_never_negative() {
        let vague = estimate([true, true, false], vec![1e8]);
        let interval = natural_frequency(&vague).unwrap().interval.unwrap();
        assert_eq!(interval.low, 0.0);
    }
}
