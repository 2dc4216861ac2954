use serde::Serialize;

use super::mean_interval::t_interval;
use super::quantile::{sorted, sorted_quantile};
use super::{Moments, skewness};
use crate::sample::{check_confidence, check_sample};
use crate::{Interval, Result};

/// A sample in numbers, in the sample's unit. What too small a sample cannot have is `None`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Number of values.
    pub count: usize,
    /// Arithmetic mean.
    pub mean: f64,
    /// Standard deviation, divisor n − 1; from two values on.
    pub standard_deviation: Option<f64>,
    /// t interval of the mean as if the values were independent; from two values on.
    pub mean_interval: Option<Interval>,
    /// Smallest value.
    pub minimum: f64,
    /// First quartile (type 7).
    pub lower_quartile: f64,
    /// Median.
    pub median: f64,
    /// Third quartile (type 7).
    pub upper_quartile: f64,
    /// Largest value.
    pub maximum: f64,
    /// Adjusted Fisher–Pearson skewness; from three values on that are not all the same.
    pub skewness: Option<f64>,
}

/// Describes a sample.
///
/// # Errors
/// [`crate::StatisticsError::TooFew`] for an empty sample, [`crate::StatisticsError::NotFinite`],
/// [`crate::StatisticsError::OutOfRange`] for `confidence`.
pub fn summarize(values: &[f64], confidence: f64) -> Result<Summary> {
    check_sample("values", values, "summary", 1)?;
    check_confidence(confidence)?;
    let ordered = sorted(values);
    let moments = Moments::of(values);
    let mean = moments.mean.to_f64();
    let spread = (values.len() >= 2).then(|| moments.variance().sqrt());
    Ok(Summary {
        count: values.len(),
        mean,
        standard_deviation: spread,
        mean_interval: spread.map(|sd| {
            t_interval(
                mean,
                sd / moments.count.sqrt(),
                moments.count - 1.0,
                confidence,
            )
        }),
        minimum: ordered[0],
        lower_quartile: sorted_quantile(&ordered, 0.25),
        median: sorted_quantile(&ordered, 0.5),
        upper_quartile: sorted_quantile(&ordered, 0.75),
        maximum: ordered[ordered.len() - 1],
        // Its errors are exactly the samples that have no skewness.
        skewness: skewness(values).ok(),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_single_value_has_no_spread() {
        let found = summarize(&[2.5], 0.95).unwrap();
        assert_eq!((found.mean, found.median, found.maximum), (2.5, 2.5, 2.5));
        assert_eq!(
            (found.standard_deviation, found.mean_interval),
            (None, None)
        );
    }

    #[test]
    fn constant_values_have_a_point_interval() {
        let found = summarize(&[0.1; 3], 0.95).unwrap();
        assert_eq!(found.standard_deviation, Some(0.0));
        let interval = found.mean_interval.unwrap();
        assert_eq!(
            (interval.low, interval.high, found.skewness),
            (0.1, 0.1, None)
        );
    }
}
