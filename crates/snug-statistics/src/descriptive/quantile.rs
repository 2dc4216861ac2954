//! Quantiles and the median, by linear interpolation between order statistics.

use crate::sample::check_sample;
use crate::{Result, StatisticsError};

/// Median absolute deviation of a normal variable, as a share of its standard deviation \[–\]: Φ⁻¹(3/4).
pub const MAD_OF_NORMAL: f64 = 0.674_489_750_196_081_7;

/// Quantile by linear interpolation between order statistics at `h = (n − 1) q` (Hyndman and
/// Fan's type 7: the default of R and NumPy). `q` from 0 to 1.
///
/// # Errors
/// [`StatisticsError::TooFew`] for an empty sample, [`StatisticsError::NotFinite`],
/// [`StatisticsError::OutOfRange`] for `q`.
pub fn quantile(values: &[f64], q: f64) -> Result<f64> {
    check_sample("values", values, "quantile", 1)?;
    if !(0.0..=1.0).contains(&q) {
        return Err(StatisticsError::OutOfRange {
            argument: "q",
            value: q,
            allowed: "0 to 1",
        });
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let position = (sorted.len() - 1) as f64 * q;
    let below = position.floor();
    let index = below as usize;
    let next = sorted[(index + 1).min(sorted.len() - 1)];
    Ok(sorted[index] + (position - below) * (next - sorted[index]))
}

/// The middle value, or the mean of the two middle ones.
///
/// # Errors
/// As [`quantile`].
pub fn median(values: &[f64]) -> Result<f64> {
    quantile(values, 0.5)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn interpolates_as_type_seven_does() {
        let sample = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(quantile(&sample, 0.0).unwrap(), 1.0);
        assert_eq!(quantile(&sample, 0.25).unwrap(), 1.75);
        assert_eq!(median(&sample).unwrap(), 2.5);
        assert_eq!(quantile(&sample, 1.0).unwrap(), 4.0);
        assert_eq!(quantile(&[7.0], 0.3).unwrap(), 7.0);
    }

    #[test]
    fn refuses_a_level_outside_zero_to_one() {
        for q in [-0.1, 1.1, f64::NAN] {
            assert!(matches!(
                quantile(&[1.0], q),
                Err(StatisticsError::OutOfRange { .. })
            ));
        }
    }
}
