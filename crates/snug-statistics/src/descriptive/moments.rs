use crate::double_double::{self, DoubleDouble};
use crate::sample::{check_sample, is_constant};
use crate::{Result, StatisticsError};

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
/// [`StatisticsError::TooFew`] for an empty sample, [`StatisticsError::NotFinite`].
pub fn mean(values: &[f64]) -> Result<f64> {
    check_sample("values", values, "mean", 1)?;
    Ok(Moments::of(values).mean.to_f64())
}

/// Standard deviation with divisor n − 1.
///
/// # Errors
/// [`StatisticsError::TooFew`] below two values, [`StatisticsError::NotFinite`].
pub fn standard_deviation(values: &[f64]) -> Result<f64> {
    check_sample("values", values, "standard deviation", 2)?;
    Ok(Moments::of(values).variance().sqrt())
}

/// Adjusted Fisher–Pearson skewness `G₁ = √(n(n−1))/(n−2) · m₃/m₂^{3/2}`.
///
/// # Errors
/// [`StatisticsError::TooFew`] below three values, [`StatisticsError::NotFinite`],
/// [`StatisticsError::ZeroVariance`].
pub fn skewness(values: &[f64]) -> Result<f64> {
    const METHOD: &str = "skewness";
    check_sample("values", values, METHOD, 3)?;
    let moments = Moments::of(values);
    // Scaled by the standard deviation first, so that neither the cube nor the root underflows.
    let scale = (moments.sum_of_squares / moments.count).sqrt();
    if scale == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "values".into(),
            method: METHOD,
        });
    }
    let n = moments.count;
    let third = double_double::sum(
        values
            .iter()
            .map(|value| ((DoubleDouble::from(*value) - moments.mean).to_f64() / scale).powi(3)),
    );
    Ok((n * (n - 1.0)).sqrt() / (n - 2.0) * third.to_f64() / n)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn textbook_values() {
        let sample = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        assert_eq!(mean(&sample).unwrap(), 5.0);
        assert_eq!(
            standard_deviation(&sample).unwrap(),
            (32.0_f64 / 7.0).sqrt()
        );
        // m₃ = 42/8 = 5.25, m₂ = 4.
        let exact = 56.0_f64.sqrt() / 6.0 * 5.25 / 8.0;
        assert!((skewness(&sample).unwrap() - exact).abs() < 1e-15);
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
        assert!(matches!(
            skewness(&[0.1; 5]),
            Err(StatisticsError::ZeroVariance { .. })
        ));
    }
}
