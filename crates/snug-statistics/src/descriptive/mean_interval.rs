//! The confidence interval of a mean by Student's t.

use serde::Serialize;

use super::Moments;
use crate::distributions::student_t_quantile;
use crate::sample::{check_confidence, check_sample};
use crate::{Interval, Result, StatisticsError, TestResult};

/// Result of [`one_sample_t`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OneSampleT {
    /// t, its degrees of freedom n − 1 and p.
    pub test: TestResult,
    /// Mean of the sample.
    pub mean: f64,
    /// `s/√n`.
    pub standard_error: f64,
    /// t interval of the mean.
    pub interval: Interval,
}

/// One-sample t test of `mean = null_mean`, with the t interval of the mean.
///
/// `t = (x̄ − μ₀)/(s/√n)`, interval `x̄ ± t_{n−1} s/√n`. For differences of pairs, or one value
/// per cluster, it is the paired t test.
///
/// # Errors
/// [`StatisticsError::TooFew`] below two values, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`], [`StatisticsError::OutOfRange`] for `confidence`.
pub fn one_sample_t(values: &[f64], null_mean: f64, confidence: f64) -> Result<OneSampleT> {
    const METHOD: &str = "one-sample t test";
    check_sample("values", values, METHOD, 2)?;
    crate::sample::check_finite("null_mean", &[null_mean])?;
    check_confidence(confidence)?;
    let moments = Moments::of(values);
    let df = moments.count - 1.0;
    let standard_error = (moments.variance() / moments.count).sqrt();
    if standard_error == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "values".into(),
            method: METHOD,
        });
    }
    let mean = moments.mean.to_f64();
    let t = (moments.mean - null_mean.into()).to_f64() / standard_error;
    let reach = student_t_quantile(0.5 + 0.5 * confidence, df) * standard_error;
    Ok(OneSampleT {
        test: TestResult::of_t(METHOD, t, df),
        mean,
        standard_error,
        interval: Interval {
            low: mean - reach,
            high: mean + reach,
            confidence,
        },
    })
}
