//! How clearly a sum over units differs from zero, when a few loud units may carry most of it.

use crate::dense::dot;

/// Standard error of Σ x over independent units.
pub(crate) fn spread_of_sum(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    if n < 2.0 {
        return f64::INFINITY;
    }
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    (squares * n / (n - 1.0)).sqrt()
}

/// Squared residuals, in units of the noise, below which a unit's difference is within chance.
const CHANCE: f64 = 4.0;

/// Standard deviations by which Σ x exceeds 0: the larger of the plain one and that of x bounded at `CHANCE` times
/// `scale`, which one loud unit cannot hide. Vuong's statistic where x are differences between two models.
pub(crate) fn clearness(values: &[f64], scale: f64) -> f64 {
    let sum: f64 = values.iter().sum();
    if sum == 0.0 {
        return 0.0;
    }
    let plain = sum / spread_of_sum(values);
    let chance = CHANCE * scale;
    let bounded: Vec<f64> = values
        .iter()
        .map(|x| x / (x * x + chance * chance).sqrt())
        .collect();
    let length = dot(&bounded, &bounded).sqrt();
    if sum > 0.0 && length > 0.0 {
        plain.max(bounded.iter().sum::<f64>() / length)
    } else {
        plain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_loud_unit_does_not_hide_what_all_agree_on() {
        let mut values = vec![20.0; 20];
        values[0] = 1e5;
        assert!(
            spread_of_sum(&values) > 9e4,
            "the plain statistic sees one unit only"
        );
        assert!(clearness(&values, 1.0) > 4.0);
    }

    #[test]
    fn one_loud_unit_alone_is_no_evidence() {
        let mut values: Vec<f64> = (0..20)
            .map(|i| if i % 2 == 0 { 9.0 } else { -9.0 })
            .collect();
        values[0] = 1e5;
        assert!(clearness(&values, 1.0) < 1.5);
    }
}
