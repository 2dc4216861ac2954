//! Mean, variance, skewness and kurtosis, accumulated without cancellation.

use crate::Result;
use crate::double_double::{self, DoubleDouble};
use crate::sample::{check_sample, is_constant};

/// Count, mean and sum of squared deviations, accumulated with 106 bits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moments {
    /// Number of values.
    pub count: f64,
    /// Mean.
    pub mean: DoubleDouble,
    /// `Σ(x − mean)²`; exactly 0 for constant samples.
    pub sum_of_squares: f64,
}

impl Moments {
    /// Two passes over a non-empty sample: the mean, then the deviations from it.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = double_double::sum(values.iter().copied()) / DoubleDouble::from(count);
        let sum_of_squares = if is_constant(values) {
            0.0
        } else {
            values
                .iter()
                .map(|value| {
                    let deviation = DoubleDouble::from(*value) - mean;
                    deviation * deviation
                })
                .sum::<DoubleDouble>()
                .to_f64()
        };
        Self {
            count,
            mean,
            sum_of_squares,
        }
    }

    /// `Σ(x − mean)²/(n − 1)`.
    pub fn variance(&self) -> f64 {
        self.sum_of_squares / (self.count - 1.0)
    }

    /// Difference of two means, subtracted before rounding.
    pub fn difference(&self, other: &Self) -> f64 {
        (self.mean - other.mean).to_f64()
    }
}

/// Arithmetic mean, rounded once.
///
/// # Errors
/// [`crate::StatisticsError::TooFew`] for an empty sample, [`crate::StatisticsError::NotFinite`].
pub fn mean(values: &[f64]) -> Result<f64> {
    check_sample("values", values, "mean", 1)?;
    Ok(Moments::of(values).mean.to_f64())
}

/// Standard deviation with divisor n − 1.
///
/// # Errors
/// [`crate::StatisticsError::TooFew`] below two values, [`crate::StatisticsError::NotFinite`].
pub fn standard_deviation(values: &[f64]) -> Result<f64> {
    check_sample("values", values, "standard deviation", 2)?;
    Ok(Moments::of(values).variance().sqrt())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::StatisticsError;

    #[test]
    fn textbook_values() {
        let sample = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        assert_eq!(mean(&sample).unwrap(), 5.0);
        assert_eq!(
            standard_deviation(&sample).unwrap(),
            (32.0_f64 / 7.0).sqrt()
        );
    }

    #[test]
    fn a_large_common_offset_costs_no_digits() {
        let sample = [1e15 + 1.0, 1e15 + 2.0, 1e15 + 3.0];
        assert_eq!(standard_deviation(&sample).unwrap(), 1.0);
        assert_eq!(mean(&sample).unwrap(), 1e15 + 2.0);
    }

    #[test]
    fn degenerate_samples_are_named() {
        assert!(matches!(
            mean(&[]),
            Err(StatisticsError::TooFew {
                required: 1,
                found: 0,
                ..
            })
        ));
        assert!(matches!(
            standard_deviation(&[1.0, f64::NAN]),
            Err(StatisticsError::NotFinite { index: 1, .. })
        ));
    }
}
