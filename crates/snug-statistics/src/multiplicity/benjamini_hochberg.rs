use super::step_up;
use crate::Result;

/// Benjamini–Hochberg (1995) adjusted p values in the order given.
///
/// `p̃₍ᵢ₎ = min over j ≥ i of m p₍ⱼ₎/j`, at most 1. An empty slice gives an empty answer.
///
/// # Errors
/// [`crate::StatisticsError::OutOfRange`] for a p value outside 0 to 1 or NaN.
pub fn benjamini_hochberg(p: &[f64]) -> Result<Vec<f64>> {
    step_up(p, 1.0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::StatisticsError;

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
