use serde::{Deserialize, Serialize};

use crate::descriptive::{Moments, median};
use crate::k_sample::one_way_anova;
use crate::sample::check_groups;
use crate::{Result, StatisticsError, TestResult};

/// What deviations are taken from in [`levene`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Center {
    /// The group's median (Brown and Forsythe 1974): robust against skewed samples.
    #[default]
    Median,
    /// The group's mean (Levene 1960).
    Mean,
}

/// Levene's test of equal variances: one-way analysis of variance of `|x − centre|`.
///
/// # Errors
/// [`crate::StatisticsError::TooFewGroups`] below two groups;
/// [`crate::StatisticsError::TooFew`] for a group below two values;
/// [`crate::StatisticsError::NotFinite`]; [`crate::StatisticsError::ZeroVariance`] when within
/// every group all values lie equally far from the centre.
pub fn levene<G: AsRef<[f64]>>(groups: &[G], center: Center) -> Result<TestResult> {
    let method = match center {
        Center::Median => "Brown–Forsythe test",
        Center::Mean => "Levene test",
    };
    check_groups(groups, method, 2)?;
    let deviations: Vec<Vec<f64>> = groups
        .iter()
        .map(|group| {
            let group = group.as_ref();
            let centre = match center {
                Center::Median => median(group)?,
                Center::Mean => Moments::of(group).mean.to_f64(),
            };
            Ok(group.iter().map(|value| (value - centre).abs()).collect())
        })
        .collect::<Result<_>>()?;
    // Finite values in groups of two or more leave one way to fail.
    let test = one_way_anova(&deviations)
        .map_err(|_| StatisticsError::ZeroVariance {
            sample: "deviations within every group".into(),
            method,
        })?
        .test;
    Ok(TestResult { method, ..test })
}
