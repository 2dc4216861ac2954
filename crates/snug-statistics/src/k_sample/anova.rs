//! One-way analysis of variance: whether groups have one mean.

use serde::Serialize;

use crate::distributions::f_upper;
use crate::double_double::DoubleDouble;
use crate::sample::{Sample, check_groups};
use crate::{Result, StatisticsError, TestResult};

/// Analysis of variance table of one factor.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OneWayAnova {
    /// F, its numerator and denominator degrees of freedom, p.
    pub test: TestResult,
    /// `Σ nⱼ(x̄ⱼ − x̄)²`.
    pub between_sum_of_squares: f64,
    /// `ΣΣ (xᵢⱼ − x̄ⱼ)²`.
    pub within_sum_of_squares: f64,
    /// Root of the within mean square.
    pub residual_standard_deviation: f64,
    /// η²: share of the sum of squares between the groups (R² of the group means).
    pub eta_squared: f64,
}

/// One-way analysis of variance of `k` groups with a common variance.
///
/// `F = (SSB/(k − 1))/(SSW/(N − k))`. Two passes, centred, accumulated with 106 bits: what the
/// readings hold is what comes out, however many leading digits they share. Readings are `f64`, or
/// [`DoubleDouble`] for decimals with a large constant part: rounded to `f64`, `1000000000000.4`
/// is off by 2e-5 before any statistic sees it.
///
/// # Errors
/// [`StatisticsError::TooFewGroups`] below two groups; [`StatisticsError::TooFew`] for an empty
/// group or no group with two values; [`StatisticsError::NotFinite`];
/// [`StatisticsError::ZeroVariance`] when no group varies.
pub fn one_way_anova<T, G>(groups: &[G]) -> Result<OneWayAnova>
where
    T: Copy + Into<DoubleDouble>,
    G: AsRef<[T]>,
{
    let groups: Vec<Vec<DoubleDouble>> = groups
        .iter()
        .map(|group| {
            group
                .as_ref()
                .iter()
                .map(|&reading| reading.into())
                .collect()
        })
        .collect();
    let leading: Vec<Vec<f64>> = groups
        .iter()
        .map(|group| group.iter().map(|x| x.to_f64()).collect())
        .collect();
    check_groups(&leading, METHOD, 1)?;
    let sizes: Vec<f64> = leading.iter().map(|group| group.len() as f64).collect();
    let total: f64 = sizes.iter().sum();
    let (df_between, df_within) = (sizes.len() as f64 - 1.0, total - sizes.len() as f64);
    if df_within < 1.0 {
        return Err(StatisticsError::TooFew {
            sample: Sample::Named("largest group"),
            method: METHOD,
            required: 2,
            found: 1,
        });
    }
    let constant = |group: &Vec<DoubleDouble>| group.windows(2).all(|pair| pair[0] == pair[1]);
    let (between, within) = sums_of_squares(&groups, total);
    // Spreads below 1e-162 have squares that underflow.
    if groups.iter().all(constant) || within <= 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: Sample::Named("every group"),
            method: METHOD,
        });
    }
    let mean_square = within / df_within;
    let f = between / df_between / mean_square;
    Ok(OneWayAnova {
        test: TestResult {
            method: METHOD,
            statistic_name: "F",
            statistic: f,
            degrees_of_freedom: vec![df_between, df_within],
            p: f_upper(f, df_between, df_within),
        },
        between_sum_of_squares: between,
        within_sum_of_squares: within,
        residual_standard_deviation: mean_square.sqrt(),
        eta_squared: between / (between + within),
    })
}

const METHOD: &str = "one-way analysis of variance";

/// Sums of squares between and within the groups.
fn sums_of_squares(groups: &[Vec<DoubleDouble>], total: f64) -> (f64, f64) {
    let sum = |group: &Vec<DoubleDouble>| group.iter().copied().sum::<DoubleDouble>();
    let size = |group: &Vec<DoubleDouble>| DoubleDouble::from(group.len() as f64);
    let grand_mean = groups.iter().map(sum).sum::<DoubleDouble>() / DoubleDouble::from(total);
    let (mut between, mut within) = (DoubleDouble::default(), DoubleDouble::default());
    for group in groups {
        let mean = sum(group) / size(group);
        let shift = mean - grand_mean;
        between = between + size(group) * shift * shift;
        for value in group {
            let deviation = *value - mean;
            within = within + deviation * deviation;
        }
    }
    (between.to_f64(), within.to_f64())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn two_groups_give_the_square_of_student_t() {
        let (a, b) = ([1.0, 2.5, 3.0, 2.0], [4.0, 3.5, 6.0]);
        let t = crate::two_sample::student_t(&a, &b, 0.95).unwrap().test;
        let f = one_way_anova(&[&a[..], &b[..]]).unwrap().test;
        assert!((f.statistic / t.statistic.powi(2) - 1.0).abs() < 1e-14);
        assert!((f.p / t.p - 1.0).abs() < 1e-12);
    }

    #[test]
    fn degenerate_groups_are_named() {
        let none: [&[f64]; 0] = [];
        assert!(matches!(
            one_way_anova(&none),
            Err(StatisticsError::TooFewGroups { .. })
        ));
        assert!(matches!(
            one_way_anova(&[vec![1.0, 2.0], vec![]]),
            Err(StatisticsError::TooFew {
                sample: Sample::Group(1),
                ..
            })
        ));
        assert!(matches!(
            one_way_anova(&[vec![1.0], vec![2.0]]),
            Err(StatisticsError::TooFew { .. })
        ));
        assert!(matches!(
            one_way_anova(&[vec![0.1, 0.1], vec![0.7, 0.7, 0.7]]),
            Err(StatisticsError::ZeroVariance { .. })
        ));
        assert!(matches!(
            one_way_anova(&[vec![0.1, 0.2], vec![f64::INFINITY]]),
            Err(StatisticsError::NotFinite {
                sample: Sample::Group(1),
                index: 0,
                ..
            })
        ));
    }
}
