use serde::Serialize;

use crate::distributions::student_t_two_sided;
use crate::ranks::mid_ranks;
use crate::sample::check_sample;
use crate::{Result, StatisticsError, TestResult};

/// Result of [`brunner_munzel`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BrunnerMunzel {
    /// W, its t degrees of freedom and p. W is positive when `second` tends to be larger.
    pub test: TestResult,
    /// Estimate of `P(first > second) + ½ P(first = second)`; ½ under the null hypothesis.
    pub superiority: f64,
}

/// Brunner–Munzel test: does one of two samples tend to larger values, whatever their spreads?
///
/// Unlike Mann–Whitney it stays valid under unequal variances (Brunner and Munzel 2000,
/// t approximation; sound from about ten values per sample).
///
/// # Errors
/// [`StatisticsError::TooFew`] below two values per sample, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`] when the samples do not overlap at all, so that the
/// statistic's variance is zero.
pub fn brunner_munzel(first: &[f64], second: &[f64]) -> Result<BrunnerMunzel> {
    const METHOD: &str = "Brunner–Munzel test";
    check_sample("first", first, METHOD, 2)?;
    check_sample("second", second, METHOD, 2)?;
    let (n1, n2) = (first.len() as f64, second.len() as f64);
    let pooled: Vec<f64> = first.iter().chain(second).copied().collect();
    let ranks = mid_ranks(&pooled).ranks;
    let (mean1, spread1) = placements(&ranks[..first.len()], first);
    let (mean2, spread2) = placements(&ranks[first.len()..], second);
    let (part1, part2) = (n1 * spread1, n2 * spread2);
    let total = part1 + part2;
    if total <= 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "overlap of first and second".into(),
            method: METHOD,
        });
    }
    let statistic = n1 * n2 * (mean2 - mean1) / ((n1 + n2) * total.sqrt());
    let df = total * total / (part1 * part1 / (n1 - 1.0) + part2 * part2 / (n2 - 1.0));
    Ok(BrunnerMunzel {
        test: TestResult {
            method: METHOD,
            statistic_name: "W",
            statistic,
            degrees_of_freedom: vec![df],
            p: student_t_two_sided(statistic, df),
        },
        superiority: (mean1 - (n1 + 1.0) / 2.0) / n2,
    })
}

/// Mean pooled rank of one sample, and the variance of its pooled minus its own ranks.
fn placements(pooled_ranks: &[f64], own: &[f64]) -> (f64, f64) {
    let count = own.len() as f64;
    let mean = pooled_ranks.iter().sum::<f64>() / count;
    let own_ranks = mid_ranks(own).ranks;
    let square = |(pooled, own): (&f64, &f64)| (pooled - own - mean + (count + 1.0) / 2.0).powi(2);
    let squares: f64 = pooled_ranks.iter().zip(&own_ranks).map(square).sum();
    (mean, squares / (count - 1.0))
}
