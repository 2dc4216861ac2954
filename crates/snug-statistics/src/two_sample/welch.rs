//! Whether two groups that scatter differently have one mean.

use super::student::{TwoSampleT, t_test};
use crate::descriptive::Moments;
use crate::sample::check_sample;
use crate::{Result, StatisticsError};

/// Welch's t test of two independent samples with unequal variances.
///
/// `t = (x̄₁ − x̄₂)/√(s₁²/n₁ + s₂²/n₂)`, degrees of freedom after Welch and Satterthwaite.
///
/// # Errors
/// [`StatisticsError::TooFew`] below two values per sample, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`] when neither sample varies,
/// [`StatisticsError::OutOfRange`] for `confidence`.
pub fn welch_t(first: &[f64], second: &[f64], confidence: f64) -> Result<TwoSampleT> {
    const METHOD: &str = "Welch t test";
    check_sample("first", first, METHOD, 2)?;
    check_sample("second", second, METHOD, 2)?;
    let (a, b) = (Moments::of(first), Moments::of(second));
    let (part_a, part_b) = (a.variance() / a.count, b.variance() / b.count);
    let total = part_a + part_b;
    if total == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "first and second".into(),
            method: METHOD,
        });
    }
    // Shares instead of squares, so that tiny variances do not underflow.
    let (share_a, share_b) = (part_a / total, part_b / total);
    let df = (share_a * share_a / (a.count - 1.0) + share_b * share_b / (b.count - 1.0)).recip();
    t_test(METHOD, &a, &b, total.sqrt(), df, confidence)
}
