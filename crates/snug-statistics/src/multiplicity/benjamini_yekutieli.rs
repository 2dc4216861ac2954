use super::step_up;
use crate::Result;

/// Benjamini–Yekutieli (2001) adjusted p values in the order given: Benjamini–Hochberg times
/// `Σ 1/i`, valid whatever the dependence between the tests.
///
/// # Errors
/// [`crate::StatisticsError::OutOfRange`] for a p value outside 0 to 1 or NaN.
pub fn benjamini_yekutieli(p: &[f64]) -> Result<Vec<f64>> {
    let harmonic: f64 = (1..=p.len()).rev().map(|i| 1.0 / i as f64).sum();
    step_up(p, harmonic)
}
