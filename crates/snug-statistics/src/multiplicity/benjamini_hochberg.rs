//! p values of many tests, adjusted so that the share of false discoveries stays below a level.

use crate::{Result, StatisticsError};

/// Benjamini–Hochberg (1995) adjusted p values in the order given.
///
/// `p̃₍ᵢ₎ = min over j ≥ i of m p₍ⱼ₎/j`, at most 1: below α they keep the false-discovery rate at
/// α for independent or positively dependent tests. An empty slice gives an empty answer.
///
/// # Errors
/// [`StatisticsError::OutOfRange`] for a p value outside 0 to 1 or NaN.
pub fn benjamini_hochberg(p: &[f64]) -> Result<Vec<f64>> {
    if let Some(value) = p.iter().find(|value| !(0.0..=1.0).contains(*value)) {
        return Err(StatisticsError::OutOfRange {
            argument: "p",
            value: *value,
            allowed: "0 to 1",
        });
    }
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    let count = p.len() as f64;
    let mut adjusted = vec![0.0; p.len()];
    let mut smallest = 1.0_f64;
    for (position, index) in order.iter().enumerate().rev() {
        smallest = smallest.min(count / (position + 1) as f64 * p[*index]);
        adjusted[*index] = smallest;
    }
    Ok(adjusted)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn worked_by_hand() {
        let found = benjamini_hochberg(&[0.04, 0.01, 0.03, 0.5]).unwrap();
        // Ascending: 0.01·4/1, 0.03·4/2, 0.04·4/3, 0.5; then the minimum from the right.
        let exact = [0.04 * 4.0 / 3.0, 0.04, 0.04 * 4.0 / 3.0, 0.5];
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).abs() < 1e-15);
        }
    }

    #[test]
    fn refuses_what_is_not_a_probability() {
        for bad in [-0.1, 1.1, f64::NAN] {
            let found = benjamini_hochberg(&[0.5, bad]);
            assert!(matches!(found, Err(StatisticsError::OutOfRange { .. })));
        }
        assert!(benjamini_hochberg(&[]).unwrap().is_empty());
    }
}
