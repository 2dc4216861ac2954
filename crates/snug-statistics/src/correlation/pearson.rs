use serde::Serialize;

use super::{check_pair, fisher_interval, t_test};
use crate::descriptive::Moments;
use crate::double_double::DoubleDouble;
use crate::sample::check_confidence;
use crate::{Interval, Result, StatisticsError, TestResult};

/// A correlation coefficient with its test.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Correlation {
    /// The coefficient as statistic, degrees of freedom n − 2, and p.
    pub test: TestResult,
    /// Interval by Fisher's transform; from four pairs on.
    pub interval: Option<Interval>,
}

/// Pearson's product-moment correlation, tested by Student's t.
///
/// Interval `tanh(atanh r ± z/√(n − 3))`.
///
/// # Errors
/// [`StatisticsError::LengthMismatch`], [`StatisticsError::TooFew`] below three pairs,
/// [`StatisticsError::NotFinite`], [`StatisticsError::ZeroVariance`] naming the sample,
/// [`StatisticsError::OutOfRange`] for `confidence`.
pub fn pearson(first: &[f64], second: &[f64], confidence: f64) -> Result<Correlation> {
    const METHOD: &str = "Pearson correlation";
    check_pair(first, second, METHOD)?;
    check_confidence(confidence)?;
    let r = coefficient(first, second, METHOD)?;
    let free = first.len() as f64 - 3.0;
    Ok(Correlation {
        test: t_test(METHOD, "r", r, first.len()),
        interval: (free > 0.0).then(|| fisher_interval(r, free.sqrt().recip(), confidence)),
    })
}

/// Product-moment coefficient of two checked samples.
pub(super) fn coefficient(first: &[f64], second: &[f64], method: &'static str) -> Result<f64> {
    let (a, b) = (Moments::of(first), Moments::of(second));
    for (moments, sample) in [(&a, "first"), (&b, "second")] {
        if moments.sum_of_squares <= 0.0 {
            return Err(StatisticsError::ZeroVariance {
                sample: sample.into(),
                method,
            });
        }
    }
    let product: DoubleDouble = first
        .iter()
        .zip(second)
        .map(|(x, y)| (DoubleDouble::from(*x) - a.mean) * (DoubleDouble::from(*y) - b.mean))
        .sum();
    Ok((product.to_f64() / a.sum_of_squares.sqrt() / b.sum_of_squares.sqrt()).clamp(-1.0, 1.0))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_straight_line_correlates_fully() {
        let x = [1.0, 2.0, 3.0, 5.0];
        let y = x.map(|x| 7.0 - 2.0 * x);
        let found = pearson(&x, &y, 0.95).unwrap();
        assert!((found.test.statistic + 1.0).abs() < 1e-15 && found.test.p < 1e-7);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let wrong = pearson(&[1.0, 2.0, 3.0], &[1.0, 2.0], 0.95);
        assert!(matches!(
            wrong,
            Err(StatisticsError::LengthMismatch {
                right_length: 2,
                ..
            })
        ));
        let flat = pearson(&[1.0, 2.0, 3.0], &[0.7; 3], 0.95);
        let second = crate::Sample::Named("second");
        assert!(
            matches!(flat, Err(StatisticsError::ZeroVariance { sample, .. }) if sample == second)
        );
    }
}
