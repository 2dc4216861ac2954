use super::ascending;
use crate::Result;

/// Holm (1979) adjusted p values in the order given: family-wise error under any dependence.
///
/// `p̃₍ᵢ₎ = max over j ≤ i of (m − j + 1) p₍ⱼ₎`, at most 1.
///
/// # Errors
/// [`crate::StatisticsError::OutOfRange`] for a p value outside 0 to 1 or NaN.
pub fn holm(p: &[f64]) -> Result<Vec<f64>> {
    let order = ascending(p)?;
    let mut adjusted = vec![0.0; p.len()];
    let mut largest = 0.0_f64;
    for (position, index) in order.iter().enumerate() {
        largest = largest
            .max((p.len() - position) as f64 * p[*index])
            .min(1.0);
        adjusted[*index] = largest;
    }
    Ok(adjusted)
}
