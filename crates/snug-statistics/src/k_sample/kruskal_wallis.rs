//! Whether groups have one location, by ranks.

use serde::Serialize;

use crate::distributions::chi_squared_upper;
use crate::ranks::mid_ranks;
use crate::sample::check_groups;
use crate::{Result, StatisticsError, TestResult};

/// Result of [`kruskal_wallis`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KruskalWallis {
    /// H, its chi-squared degrees of freedom and p.
    pub test: TestResult,
    /// `ε² = H/(N − 1)`: share of the ranks' variance between the groups, 0 to 1.
    pub epsilon_squared: f64,
}

/// Kruskal–Wallis rank test of `k` groups, corrected for ties.
///
/// `H = [12/(N(N+1)) Σ nⱼ(R̄ⱼ − (N+1)/2)²] / [1 − Σ(t³ − t)/(N³ − N)]`, chi-squared with
/// `k − 1` degrees of freedom (sound from about five values per group).
///
/// # Errors
/// [`StatisticsError::TooFewGroups`] below two groups; [`StatisticsError::TooFew`] for an empty
/// group; [`StatisticsError::NotFinite`]; [`StatisticsError::ZeroVariance`] when all values of
/// all groups are the same.
pub fn kruskal_wallis<G: AsRef<[f64]>>(groups: &[G]) -> Result<KruskalWallis> {
    const METHOD: &str = "Kruskal–Wallis test";
    check_groups(groups, METHOD, 1)?;
    let pooled: Vec<f64> = groups
        .iter()
        .flat_map(|group| group.as_ref())
        .copied()
        .collect();
    let ranked = mid_ranks(&pooled);
    let n = pooled.len() as f64;
    let untied = 1.0 - ranked.tie_term / (n * n * n - n);
    if untied <= 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "all groups".into(),
            method: METHOD,
        });
    }
    let mut rest = ranked.ranks.as_slice();
    let mut between = 0.0;
    for group in groups {
        let (own, others) = rest.split_at(group.as_ref().len());
        let count = own.len() as f64;
        between += count * (own.iter().sum::<f64>() / count - (n + 1.0) / 2.0).powi(2);
        rest = others;
    }
    let h = 12.0 / (n * (n + 1.0)) * between / untied;
    let df = groups.len() as f64 - 1.0;
    Ok(KruskalWallis {
        test: TestResult {
            method: METHOD,
            statistic_name: "H",
            statistic: h,
            degrees_of_freedom: vec![df],
            p: chi_squared_upper(h, df),
        },
        epsilon_squared: h / (n - 1.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_values_alike_is_an_error() {
        let found = kruskal_wallis(&[vec![1.0, 1.0], vec![1.0]]);
        assert!(matches!(found, Err(StatisticsError::ZeroVariance { .. })));
    }
}
