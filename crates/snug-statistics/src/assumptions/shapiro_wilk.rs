//! Whether values may come from a normal distribution, as t and F tests presume of small samples.

use crate::descriptive::Moments;
use crate::distributions::{normal_quantile, normal_upper};
use crate::sample::check_sample;
use crate::{Result, StatisticsError, TestResult};

/// Largest sample the p value's approximation was fitted to.
const LARGEST: usize = 5000;

/// Shapiro–Wilk test of normality, 3 to 5000 values.
///
/// W and its p value by Royston's approximation (Algorithm AS R94, Applied Statistics 44,
/// 1995): weights from normal scores with polynomial corrections of the two outermost, and a
/// normalising transform of `ln(1 − W)`.
///
/// # Errors
/// [`StatisticsError::TooFew`], [`StatisticsError::TooMany`], [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`].
pub fn shapiro_wilk(values: &[f64]) -> Result<TestResult> {
    const METHOD: &str = "Shapiro–Wilk test";
    check_sample("values", values, METHOD, 3)?;
    if values.len() > LARGEST {
        return Err(StatisticsError::TooMany {
            sample: "values".into(),
            method: METHOD,
            limit: LARGEST,
            found: values.len(),
        });
    }
    let moments = Moments::of(values);
    if moments.sum_of_squares <= 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "values".into(),
            method: METHOD,
        });
    }
    let mut ordered = values.to_vec();
    ordered.sort_by(f64::total_cmp);
    let weights = weights(values.len());
    // The weights are antisymmetric: pairs from both ends, scaled by the standard deviation.
    let scale = moments.sum_of_squares.sqrt();
    let score: f64 = weights
        .iter()
        .zip(ordered.iter().rev().zip(&ordered))
        .map(|(weight, (high, low))| weight * ((high - low) / scale))
        .sum();
    let complement = ((1.0 - score) * (1.0 + score)).max(0.0);
    let w = 1.0 - complement;
    Ok(TestResult {
        method: METHOD,
        statistic_name: "W",
        statistic: w,
        degrees_of_freedom: vec![],
        p: p_value(complement, values.len()),
    })
}

/// Weights of the upper half of the ordered sample, largest value first.
fn weights(count: usize) -> Vec<f64> {
    if count == 3 {
        return vec![std::f64::consts::FRAC_1_SQRT_2];
    }
    let n = count as f64;
    let scores: Vec<f64> = (1..=count / 2)
        .map(|i| -normal_quantile((i as f64 - 0.375) / (n + 0.25)))
        .collect();
    let square_sum = 2.0 * scores.iter().map(|score| score * score).sum::<f64>();
    let norm = square_sum.sqrt();
    let u = 1.0 / n.sqrt();
    let first = scores[0] / norm
        + polynomial(
            &[0.0, 0.221_157, -0.147_981, -2.071_19, 4.434_685, -2.706_056],
            u,
        );
    let mut outer = vec![first];
    if count > 5 {
        outer.push(
            scores[1] / norm
                + polynomial(
                    &[
                        0.0, 0.042_981, -0.293_762, -1.752_461, 5.682_633, -3.582_633,
                    ],
                    u,
                ),
        );
    }
    let taken: f64 = scores
        .iter()
        .take(outer.len())
        .map(|score| 2.0 * score * score)
        .sum();
    let given: f64 = outer.iter().map(|weight| 2.0 * weight * weight).sum();
    let factor = ((square_sum - taken) / (1.0 - given)).sqrt();
    let inner = scores.iter().skip(outer.len()).map(|score| score / factor);
    outer.iter().copied().chain(inner).collect()
}

/// p value from `1 − W`.
fn p_value(complement: f64, count: usize) -> f64 {
    let n = count as f64;
    if count == 3 {
        let root = (1.0 - complement).max(0.0).sqrt();
        let exact = 6.0 / std::f64::consts::PI * (root.asin() - 0.75_f64.sqrt().asin());
        return exact.clamp(0.0, 1.0);
    }
    let transformed = complement.ln();
    let ln_n = n.ln();
    let (transformed, mean, deviation) = if count <= 11 {
        let bound = polynomial(&[-2.273, 0.459], n);
        if transformed >= bound {
            return 0.0;
        }
        (
            -(bound - transformed).ln(),
            polynomial(&[0.544, -0.399_78, 0.025_054, -6.714e-4], n),
            polynomial(&[1.3822, -0.778_57, 0.062_767, -0.002_032_2], n).exp(),
        )
    } else {
        (
            transformed,
            polynomial(&[-1.5861, -0.310_82, -0.083_751, 0.003_891_5], ln_n),
            polynomial(&[-0.4803, -0.082_676, 0.003_030_2], ln_n).exp(),
        )
    };
    normal_upper((transformed - mean) / deviation)
}

/// `c₀ + c₁ x + c₂ x² + …`
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients
        .iter()
        .rev()
        .fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn three_equidistant_values_are_as_normal_as_can_be() {
        let found = shapiro_wilk(&[1.0, 2.0, 3.0]).unwrap();
        assert!((found.statistic - 1.0).abs() < 1e-15 && (found.p - 1.0).abs() < 1e-7);
        // Two alike of three: W = 3/4, its smallest value.
        let found = shapiro_wilk(&[1.0, 1.0, 3.0]).unwrap();
        assert!((found.statistic - 0.75).abs() < 1e-15 && found.p < 1e-7);
    }

    #[test]
    fn limits_are_named() {
        assert!(matches!(
            shapiro_wilk(&[1.0, 2.0]),
            Err(StatisticsError::TooFew { .. })
        ));
        assert!(matches!(
            shapiro_wilk(&[0.3; 9]),
            Err(StatisticsError::ZeroVariance { .. })
        ));
        let many: Vec<f64> = (0..5001).map(f64::from).collect();
        assert!(matches!(
            shapiro_wilk(&many),
            Err(StatisticsError::TooMany { .. })
        ));
    }
}
