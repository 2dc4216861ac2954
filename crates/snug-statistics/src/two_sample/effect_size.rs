//! How far apart two groups are, in standard deviations, with its confidence interval.

use serde::Serialize;
use statrs::function::gamma::ln_gamma;

use crate::descriptive::Moments;
use crate::distributions::noncentrality_interval;
use crate::sample::{check_confidence, check_sample};
use crate::{Interval, Result, StatisticsError};

/// Difference of two means in units of the pooled standard deviation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StandardizedDifference {
    /// Cohen's d: `(x̄₁ − x̄₂)/s_p`.
    pub cohens_d: f64,
    /// Hedges' g: d without its small-sample bias.
    pub hedges_g: f64,
    /// Interval of g.
    pub interval: Interval,
}

/// Cohen's d and Hedges' g of two independent samples.
///
/// `g = J d` with the exact `J = Γ(ν/2)/(√(ν/2) Γ((ν−1)/2))`, `ν = n₁ + n₂ − 2`. The interval
/// inverts the noncentral t distribution of `d/√(1/n₁ + 1/n₂)` (Steiger and Fouladi 1997) and
/// scales its limits by J; like d itself it presumes normal samples of equal variance.
///
/// # Errors
/// [`StatisticsError::TooFew`] below two values per sample, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`] when neither sample varies,
/// [`StatisticsError::OutOfRange`] for `confidence`.
pub fn standardized_difference(
    first: &[f64],
    second: &[f64],
    confidence: f64,
) -> Result<StandardizedDifference> {
    const METHOD: &str = "standardized difference";
    check_sample("first", first, METHOD, 2)?;
    check_sample("second", second, METHOD, 2)?;
    check_confidence(confidence)?;
    let (a, b) = (Moments::of(first), Moments::of(second));
    let df = a.count + b.count - 2.0;
    let pooled = ((a.sum_of_squares + b.sum_of_squares) / df).sqrt();
    if pooled == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "first and second".into(),
            method: METHOD,
        });
    }
    let cohens_d = a.difference(&b) / pooled;
    let bias = (ln_gamma(df / 2.0) - ln_gamma((df - 1.0) / 2.0)).exp() / (df / 2.0).sqrt();
    let unit = (1.0 / a.count + 1.0 / b.count).sqrt();
    let (low, high) = noncentrality_interval(cohens_d / unit, df, confidence);
    Ok(StandardizedDifference {
        cohens_d,
        hedges_g: bias * cohens_d,
        interval: Interval {
            low: bias * unit * low,
            high: bias * unit * high,
            confidence,
        },
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn swapping_the_samples_mirrors_everything() {
        let (a, b) = ([1.0, 2.0, 4.0, 3.5], [2.0, 5.0, 6.5]);
        let one = standardized_difference(&a, &b, 0.9).unwrap();
        let two = standardized_difference(&b, &a, 0.9).unwrap();
        assert_eq!(one.hedges_g, -two.hedges_g);
        assert!((one.interval.low + two.interval.high).abs() < 1e-10);
    }

    #[test]
    fn a_huge_effect_keeps_a_finite_interval_around_it() {
        let a: Vec<f64> = (0..40).map(|i| f64::from(i % 5)).collect();
        let b: Vec<f64> = a.iter().map(|x| x + 60.0).collect();
        let found = standardized_difference(&b, &a, 0.95).unwrap();
        assert!(found.interval.low < found.hedges_g && found.hedges_g < found.interval.high);
        // Large-sample variance of g at this size: (1/20 + d²/160).
        let width = 2.0 * 1.96 * (0.05 + found.cohens_d.powi(2) / 160.0).sqrt();
        assert!(((found.interval.high - found.interval.low) / width - 1.0).abs() < 0.05);
    }
}
