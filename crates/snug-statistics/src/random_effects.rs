//! Groups that were each estimated by themselves: their mean, and how much they differ beyond their own errors.

use crate::distributions::student_t_quantile;
use crate::{Interval, Result, Sample, StatisticsError};

/// Scoring steps before the spread counts as found. Chosen: it takes about ten.
const MOST_STEPS: usize = 200;
/// Share of a step in the spread's variance below which it has arrived \[–\]. Chosen.
const ARRIVED: f64 = 1e-10;

/// What groups have in common; values have the estimates' unit.
#[derive(Debug, Clone, PartialEq)]
pub struct RandomEffects {
    /// Mean of the population that the groups are drawn from.
    pub mean: f64,
    /// Its standard error (Knapp & Hartung 2003, never below that of a known spread).
    pub standard_error: f64,
    /// 95 % interval of the mean, Student's t with one degree of freedom less than there are groups.
    pub interval: Interval,
    /// Standard deviation τ between groups, beyond their own errors.
    pub spread: f64,
    /// Every group's estimate, shrunk towards the mean as far as its own error asks: μ + τ²/(τ² + v) · (y − μ).
    pub shrunk: Vec<f64>,
}

/// Fits `y_g = μ + u_g + e_g`, `u_g ~ N(0, τ²)`, `e_g ~ N(0, v_g)` with known v, by restricted maximum likelihood (Fisher
/// scoring, as metafor's `rma`).
///
/// # Errors
/// [`StatisticsError::TooFew`] with fewer than two groups, [`StatisticsError::NotFinite`] for an estimate that is none,
/// [`StatisticsError::OutOfRange`] for a variance that is not positive.
pub fn random_effects(estimates: &[f64], variances: &[f64]) -> Result<RandomEffects> {
    check(estimates, variances)?;
    let mut tau2 = 0.0_f64;
    for _ in 0..MOST_STEPS {
        let weights = weights(variances, tau2);
        let [one, two, three] =
            [1, 2, 3].map(|power| weights.iter().map(|w| w.powi(power)).sum::<f64>());
        let mean = weighted_mean(estimates, &weights);
        let squares = weights
            .iter()
            .zip(estimates)
            .map(|(w, y)| (w * (y - mean)).powi(2));
        let trace = one - two / one;
        let trace_of_square = two - 2.0 * three / one + (two / one).powi(2);
        let next = (tau2 + (squares.sum::<f64>() - trace) / trace_of_square).max(0.0);
        let moved = (next - tau2).abs();
        tau2 = next;
        if moved <= ARRIVED * (tau2 + 1.0 / one) {
            break;
        }
    }
    let weights = weights(variances, tau2);
    let sum: f64 = weights.iter().sum();
    let mean = weighted_mean(estimates, &weights);
    let freedom = (estimates.len() - 1) as f64;
    let squares: f64 = (weights.iter().zip(estimates))
        .map(|(w, y)| w * (y - mean).powi(2))
        .sum();
    let standard_error = ((squares / freedom).max(1.0) / sum).sqrt();
    let reach = student_t_quantile(0.975, freedom) * standard_error;
    Ok(RandomEffects {
        mean,
        standard_error,
        interval: Interval {
            low: mean - reach,
            high: mean + reach,
            confidence: 0.95,
        },
        spread: tau2.sqrt(),
        shrunk: (estimates.iter().zip(variances))
            .map(|(y, v)| mean + tau2 / (tau2 + v) * (y - mean))
            .collect(),
    })
}

fn weights(variances: &[f64], tau2: f64) -> Vec<f64> {
    variances.iter().map(|v| 1.0 / (v + tau2)).collect()
}

fn weighted_mean(values: &[f64], weights: &[f64]) -> f64 {
    let sum: f64 = values.iter().zip(weights).map(|(y, w)| w * y).sum();
    sum / weights.iter().sum::<f64>()
}

fn check(estimates: &[f64], variances: &[f64]) -> Result<()> {
    let (sample, method) = (Sample::Named("estimates"), "random effects");
    let found = estimates.len().min(variances.len());
    if found < 2 || estimates.len() != variances.len() {
        return Err(StatisticsError::TooFew {
            sample,
            method,
            required: 2,
            found,
        });
    }
    if let Some(index) = estimates.iter().position(|y| !y.is_finite()) {
        let value = estimates[index];
        return Err(StatisticsError::NotFinite {
            sample,
            index,
            value,
        });
    }
    match variances.iter().find(|v| !(v.is_finite() && **v > 0.0)) {
        Some(&value) => Err(StatisticsError::OutOfRange {
            argument: "variances",
            value,
            allowed: "positive",
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// The BCG vaccine trials (Colditz et al. 1994), as metafor documents them: τ² 0.3132, mean −0.7145, error 0.1798.
    #[test]
    fn metafor_s_bcg_example() {
        let estimates = [
            -0.8893, -1.5854, -1.3481, -1.4416, -0.2175, -0.7861, -1.6209, 0.0120, -0.4694,
            -1.3713, -0.3394, 0.4459, -0.0173,
        ];
        let variances = [
            0.3256, 0.1946, 0.4154, 0.0200, 0.0512, 0.0069, 0.2230, 0.0040, 0.0564, 0.0730, 0.0124,
            0.5325, 0.0714,
        ];
        let found = random_effects(&estimates, &variances).unwrap();
        assert!((found.spread.powi(2) - 0.3132).abs() < 2e-4, "{found:?}");
        assert!((found.mean + 0.7145).abs() < 2e-4, "{found:?}");
        // Knapp and Hartung's error there is 0.1807.
        assert!((found.standard_error - 0.1807).abs() < 1.5e-3, "{found:?}");
    }

    /// Equal values: no spread, the mean as exact as all together, every group shrunk onto it.
    #[test]
    fn groups_that_agree_have_no_spread() {
        let found = random_effects(&[2.0; 4], &[0.04; 4]).unwrap();
        assert_eq!((found.mean, found.spread), (2.0, 0.0));
        assert!((found.standard_error - 0.1).abs() < 1e-15);
        assert_eq!(found.shrunk, [2.0; 4]);
    }

    /// Equal variances: REML's τ² is the sample variance less v, here 4 − 1.
    #[test]
    fn equal_errors_leave_the_sample_variance_less_theirs() {
        let found = random_effects(&[1.0, 3.0, 5.0], &[1.0; 3]).unwrap();
        assert!((found.spread.powi(2) - 3.0).abs() < 1e-9, "{found:?}");
        assert!((found.shrunk[0] - 1.5).abs() < 1e-9);
    }

    #[test]
    fn one_group_or_no_error_is_refused() {
        assert!(random_effects(&[1.0], &[1.0]).is_err());
        assert!(random_effects(&[1.0, 2.0], &[1.0]).is_err());
        assert!(random_effects(&[1.0, f64::NAN], &[1.0; 2]).is_err());
        for bad in [0.0, -1.0, f64::NAN] {
            assert!(random_effects(&[1.0, 2.0], &[1.0, bad]).is_err());
        }
    }
}
