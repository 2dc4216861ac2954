//! Whether groups that scatter differently have one mean.

use crate::descriptive::Moments;
use crate::distributions::f_upper;
use crate::double_double::DoubleDouble;
use crate::sample::{Sample, check_groups};
use crate::{Result, StatisticsError, TestResult};

/// Welch's analysis of variance: equal means of `k` groups whose variances may differ.
///
/// With weights `wⱼ = nⱼ/sⱼ²`, `W = Σwⱼ`, weighted mean x̃ and
/// `Λ = Σ (1 − wⱼ/W)²/(nⱼ − 1)`:
/// `F = [Σ wⱼ(x̄ⱼ − x̃)²/(k − 1)] / [1 + 2(k − 2)Λ/(k² − 1)]` on `k − 1` and
/// `(k² − 1)/(3Λ)` degrees of freedom (Welch 1951).
///
/// # Errors
/// [`StatisticsError::TooFewGroups`] below two groups; [`StatisticsError::TooFew`] for a group
/// below two values; [`StatisticsError::NotFinite`]; [`StatisticsError::ZeroVariance`] naming
/// the group that does not vary.
pub fn welch_anova<G: AsRef<[f64]>>(groups: &[G]) -> Result<TestResult> {
    const METHOD: &str = "Welch analysis of variance";
    check_groups(groups, METHOD, 2)?;
    let moments: Vec<Moments> = groups
        .iter()
        .map(|group| Moments::of(group.as_ref()))
        .collect();
    if let Some(index) = moments.iter().position(|m| m.sum_of_squares <= 0.0) {
        return Err(StatisticsError::ZeroVariance {
            sample: Sample::Group(index),
            method: METHOD,
        });
    }
    let k = moments.len() as f64;
    let weights: Vec<f64> = moments.iter().map(|m| m.count / m.variance()).collect();
    let total: f64 = weights.iter().sum();
    // Distances from the first mean, so that a common offset costs no digits.
    let shifts: Vec<f64> = moments.iter().map(|m| m.difference(&moments[0])).collect();
    let centre = weights
        .iter()
        .zip(&shifts)
        .map(|(weight, shift)| DoubleDouble::from(weight / total) * DoubleDouble::from(*shift))
        .sum::<DoubleDouble>()
        .to_f64();
    let between: f64 = weights
        .iter()
        .zip(&shifts)
        .map(|(weight, shift)| weight * (shift - centre).powi(2))
        .sum();
    let lambda: f64 = weights
        .iter()
        .zip(&moments)
        .map(|(w, m)| (1.0 - w / total).powi(2) / (m.count - 1.0))
        .sum();
    let f = between / (k - 1.0) / (1.0 + 2.0 * (k - 2.0) * lambda / (k * k - 1.0));
    let df2 = (k * k - 1.0) / (3.0 * lambda);
    Ok(TestResult {
        method: METHOD,
        statistic_name: "F",
        statistic: f,
        degrees_of_freedom: vec![k - 1.0, df2],
        p: f_upper(f, k - 1.0, df2),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn two_groups_give_the_square_of_welch_t() {
        let (a, b) = ([1.0, 2.5, 3.0, 2.0], [4.0, 3.5, 9.0]);
        let t = crate::two_sample::welch_t(&a, &b, 0.95).unwrap().test;
        let f = welch_anova(&[&a[..], &b[..]]).unwrap();
        assert!((f.statistic / t.statistic.powi(2) - 1.0).abs() < 1e-14);
        assert!((f.degrees_of_freedom[1] / t.degrees_of_freedom[0] - 1.0).abs() < 1e-14);
        assert!((f.p / t.p - 1.0).abs() < 1e-11);
    }

    #[test]
    fn the_constant_group_is_named() {
        let found = welch_anova(&[vec![1.0, 2.0], vec![0.3; 4]]);
        assert!(matches!(
            found,
            Err(StatisticsError::ZeroVariance {
                sample: Sample::Group(1),
                ..
            })
        ));
    }
}
