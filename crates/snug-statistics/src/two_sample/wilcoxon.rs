use serde::Serialize;

use crate::distributions::normal_two_sided;
use crate::ranks::mid_ranks;
use crate::sample::check_sample;
use crate::{Result, StatisticsError, TestResult};

/// Up to this many nonzero differences, and without ties, the p value is exact.
const EXACT_LIMIT: usize = 50;

/// Result of [`wilcoxon_signed_rank`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WilcoxonSignedRank {
    /// W⁺, the rank sum of the positive differences, and p.
    pub test: TestResult,
    /// Nonzero differences that were ranked.
    pub ranked: usize,
    /// Zero differences, which are left out (Wilcoxon's rule).
    pub zeros: usize,
    /// Whether p is exact or the tie- and continuity-corrected normal approximation.
    pub exact: bool,
}

/// Wilcoxon signed-rank test that paired differences are symmetric about zero.
///
/// Exact with at most 50 nonzero differences, no two of them equally large and no zero;
/// otherwise normal with
/// `σ² = n(n+1)(2n+1)/24 − Σ(t³ − t)/48` and continuity correction.
///
/// # Errors
/// [`StatisticsError::TooFew`] for an empty sample, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`] when every difference is zero.
pub fn wilcoxon_signed_rank(differences: &[f64]) -> Result<WilcoxonSignedRank> {
    const METHOD: &str = "Wilcoxon signed-rank test";
    check_sample("differences", differences, METHOD, 1)?;
    let nonzero: Vec<f64> = differences.iter().copied().filter(|d| *d != 0.0).collect();
    if nonzero.is_empty() {
        return Err(StatisticsError::ZeroVariance {
            sample: "differences".into(),
            method: METHOD,
        });
    }
    let sizes: Vec<f64> = nonzero.iter().map(|d| d.abs()).collect();
    let ranked = mid_ranks(&sizes);
    let positive: f64 = nonzero
        .iter()
        .zip(&ranked.ranks)
        .filter(|(d, _)| **d > 0.0)
        .map(|(_, rank)| rank)
        .sum();
    let n = nonzero.len() as f64;
    let centre = n * (n + 1.0) / 4.0;
    let zeros = differences.len() - nonzero.len();
    let exact = ranked.tie_term == 0.0 && zeros == 0 && nonzero.len() <= EXACT_LIMIT;
    let p = if exact {
        let extreme = positive.max(2.0 * centre - positive);
        // Without ties the rank sum is whole.
        exact_two_sided(nonzero.len(), extreme as usize)
    } else {
        let variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranked.tie_term / 48.0;
        let z = (((positive - centre).abs() - 0.5) / variance.sqrt()).max(0.0);
        normal_two_sided(z)
    };
    Ok(WilcoxonSignedRank {
        test: TestResult {
            method: METHOD,
            statistic_name: "W",
            statistic: positive,
            degrees_of_freedom: vec![],
            p,
        },
        ranked: nonzero.len(),
        zeros,
        exact,
    })
}

/// `2 P(W⁺ ≥ w)`, at most 1, over all 2ⁿ sign patterns.
fn exact_two_sided(n: usize, w: usize) -> f64 {
    let most = n * (n + 1) / 2;
    let mut patterns = vec![0_u64; most + 1];
    patterns[0] = 1;
    for rank in 1..=n {
        for sum in (rank..=most).rev() {
            patterns[sum] += patterns[sum - rank];
        }
    }
    let upper: u64 = patterns[w..].iter().sum();
    (2.0 * upper as f64 / 2.0_f64.powi(n as i32)).min(1.0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn six_differences_of_one_sign() {
        let found = wilcoxon_signed_rank(&[0.3, 1.0, 2.0, 0.1, 5.0, 4.0]).unwrap();
        assert_eq!(found.test.statistic, 21.0);
        assert_eq!(found.test.p, 2.0 / 64.0);
    }

    #[test]
    fn zeros_are_left_out_and_counted() {
        let found = wilcoxon_signed_rank(&[0.0, 1.0, -2.0, 3.0]).unwrap();
        assert_eq!((found.ranked, found.zeros, found.exact), (3, 1, false));
        let found = wilcoxon_signed_rank(&[0.0; 3]);
        assert!(matches!(found, Err(StatisticsError::ZeroVariance { .. })));
    }
}
