//! Whether two groups have one location, by ranks.

use serde::Serialize;

use crate::distributions::normal_two_sided;
use crate::ranks::mid_ranks;
use crate::sample::check_sample;
use crate::{Result, StatisticsError, TestResult};

/// Up to this many values per sample, and without ties, the p value is exact.
const EXACT_LIMIT: usize = 49;

/// Result of [`mann_whitney`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MannWhitney {
    /// U of the first sample, and p.
    pub test: TestResult,
    /// `U/(n₁ n₂)`: share of pairs in which the first sample's value is the larger, ties half.
    pub superiority: f64,
    /// Whether p is exact or the tie- and continuity-corrected normal approximation.
    pub exact: bool,
}

/// Mann–Whitney U test (Wilcoxon rank sum) of two independent samples.
///
/// Exact without ties and with at most 49 values in each sample; otherwise
/// `z = (max(U₁, U₂) − n₁n₂/2 − ½)/σ` with
/// `σ² = n₁n₂/12 · (N + 1 − Σ(t³ − t)/(N(N − 1)))`.
///
/// # Errors
/// [`StatisticsError::TooFew`] for an empty sample, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`] when all values of both samples are the same.
pub fn mann_whitney(first: &[f64], second: &[f64]) -> Result<MannWhitney> {
    const METHOD: &str = "Mann–Whitney U test";
    check_sample("first", first, METHOD, 1)?;
    check_sample("second", second, METHOD, 1)?;
    let pooled: Vec<f64> = first.iter().chain(second).copied().collect();
    let ranked = mid_ranks(&pooled);
    let (n1, n2) = (first.len() as f64, second.len() as f64);
    let rank_sum: f64 = ranked.ranks[..first.len()].iter().sum();
    let u = rank_sum - n1 * (n1 + 1.0) / 2.0;
    let extreme = u.max(n1 * n2 - u);
    let exact = ranked.tie_term == 0.0 && first.len().max(second.len()) <= EXACT_LIMIT;
    let p = if exact {
        // Without ties U is whole.
        exact_two_sided(first.len(), second.len(), extreme as usize)
    } else {
        let n = n1 + n2;
        let variance = n1 * n2 / 12.0 * (n + 1.0 - ranked.tie_term / (n * (n - 1.0)));
        if variance <= 0.0 {
            return Err(StatisticsError::ZeroVariance {
                sample: "first and second".into(),
                method: METHOD,
            });
        }
        normal_two_sided(((extreme - n1 * n2 / 2.0 - 0.5) / variance.sqrt()).max(0.0))
    };
    Ok(MannWhitney {
        test: TestResult {
            method: METHOD,
            statistic_name: "U",
            statistic: u,
            degrees_of_freedom: vec![],
            p,
        },
        superiority: u / (n1 * n2),
        exact,
    })
}

/// `2 P(U ≥ u)`, at most 1, from the exact distribution.
///
/// Its generating function is the Gaussian binomial `Π (1 − q^{n₂+i})/(1 − q^i)`. Counts are
/// taken modulo 2¹²⁸, which is exact because the largest, C(98, 49), is below that.
fn exact_two_sided(n1: usize, n2: usize, u: usize) -> f64 {
    let most = n1 * n2;
    let mut counts = vec![0_u128; most + 1];
    counts[0] = 1;
    for i in 1..=n1 {
        for index in (n2 + i..=most).rev() {
            counts[index] = counts[index].wrapping_sub(counts[index - n2 - i]);
        }
        for index in i..=most {
            counts[index] = counts[index].wrapping_add(counts[index - i]);
        }
    }
    let total: u128 = counts.iter().sum();
    let upper: u128 = counts[u..].iter().sum();
    (2.0 * upper as f64 / total as f64).min(1.0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn complete_separation_of_three_and_four() {
        // One arrangement of C(7, 3) = 35 on each side.
        let found = mann_whitney(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0, 7.0]).unwrap();
        assert_eq!(found.test.statistic, 0.0);
        assert!((found.test.p - 2.0 / 35.0).abs() < 1e-15);
        assert_eq!((found.superiority, found.exact), (0.0, true));
    }

    #[test]
    fn exact_counts_sum_to_the_largest_binomial() {
        // P(U ≥ 0) = 1 needs every count right modulo 2¹²⁸; half the mass lies at or above 1201.
        assert_eq!(exact_two_sided(49, 49, 0), 1.0);
        let half = exact_two_sided(49, 49, 1201);
        assert!((half - 1.0).abs() < 1e-15);
    }

    #[test]
    fn all_values_alike_is_an_error() {
        let found = mann_whitney(&[1.0, 1.0], &[1.0]);
        assert!(matches!(found, Err(StatisticsError::ZeroVariance { .. })));
    }
}
