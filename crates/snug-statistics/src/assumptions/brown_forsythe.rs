//! Whether groups scatter alike, as analysis of variance presumes.

use crate::descriptive::median;
use crate::k_sample::one_way_anova;
use crate::sample::check_groups;
use crate::{Result, StatisticsError, TestResult};

/// Brown–Forsythe test of equal variances (1974): Levene's test about the medians, which skewed
/// samples do not mislead. It is the one-way analysis of variance of `|x − median of its group|`.
///
/// # Errors
/// [`StatisticsError::TooFewGroups`] below two groups; [`StatisticsError::TooFew`] for a group
/// below two values; [`StatisticsError::NotFinite`]; [`StatisticsError::ZeroVariance`] when
/// within every group all values lie equally far from the median.
pub fn brown_forsythe<G: AsRef<[f64]>>(groups: &[G]) -> Result<TestResult> {
    const METHOD: &str = "Brown–Forsythe test";
    check_groups(groups, METHOD, 2)?;
    let deviations: Vec<Vec<f64>> = groups
        .iter()
        .map(|group| {
            let group = group.as_ref();
            let centre = median(group)?;
            Ok(group.iter().map(|value| (value - centre).abs()).collect())
        })
        .collect::<Result<_>>()?;
    // Finite values in groups of two or more leave one way to fail.
    let test = one_way_anova(&deviations)
        .map_err(|_| StatisticsError::ZeroVariance {
            sample: "deviations within every group".into(),
            method: METHOD,
        })?
        .test;
    Ok(TestResult {
        method: METHOD,
        ..test
    })
}
