//! Whether two groups that scatter alike have one mean.

use serde::Serialize;

use crate::descriptive::Moments;
use crate::distributions::student_t_quantile;
use crate::sample::{check_confidence, check_sample};
use crate::{Interval, Result, StatisticsError, TestResult};

/// Result of [`student_t`] and [`super::welch_t`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TwoSampleT {
    /// t, its degrees of freedom and p.
    pub test: TestResult,
    /// Mean of `first` − mean of `second`.
    pub mean_difference: f64,
    /// Standard error of the difference.
    pub standard_error: f64,
    /// Interval of the difference.
    pub interval: Interval,
}

/// Student's t test of two independent samples with a common variance (pooled).
///
/// `t = (x̄₁ − x̄₂)/(s_p √(1/n₁ + 1/n₂))` with `n₁ + n₂ − 2` degrees of freedom.
///
/// # Errors
/// [`StatisticsError::TooFew`] for an empty sample or fewer than three values in all,
/// [`StatisticsError::NotFinite`], [`StatisticsError::ZeroVariance`] when neither sample varies,
/// [`StatisticsError::OutOfRange`] for `confidence`.
pub fn student_t(first: &[f64], second: &[f64], confidence: f64) -> Result<TwoSampleT> {
    const METHOD: &str = "Student t test";
    check_sample("first", first, METHOD, 1)?;
    check_sample(
        "second",
        second,
        METHOD,
        if first.len() == 1 { 2 } else { 1 },
    )?;
    let (a, b) = (Moments::of(first), Moments::of(second));
    let df = a.count + b.count - 2.0;
    let pooled = (a.sum_of_squares + b.sum_of_squares) / df;
    t_test(
        METHOD,
        &a,
        &b,
        (pooled * (1.0 / a.count + 1.0 / b.count)).sqrt(),
        df,
        confidence,
    )
}

/// The t test once standard error and degrees of freedom are known.
pub(super) fn t_test(
    method: &'static str,
    first: &Moments,
    second: &Moments,
    standard_error: f64,
    df: f64,
    confidence: f64,
) -> Result<TwoSampleT> {
    check_confidence(confidence)?;
    if standard_error == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "first and second".into(),
            method,
        });
    }
    let mean_difference = first.difference(second);
    let t = mean_difference / standard_error;
    let reach = student_t_quantile(0.5 + 0.5 * confidence, df) * standard_error;
    Ok(TwoSampleT {
        test: TestResult::of_t(method, t, df),
        mean_difference,
        standard_error,
        interval: Interval {
            low: mean_difference - reach,
            high: mean_difference + reach,
            confidence,
        },
    })
}
