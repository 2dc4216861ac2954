use super::pearson::{Correlation, coefficient};
use super::{check_pair, fisher_interval, t_test};
use crate::Result;
use crate::ranks::mid_ranks;
use crate::sample::check_confidence;

/// Spearman's rank correlation (mid-ranks for ties), tested by Student's t on n − 2 degrees of
/// freedom.
///
/// Interval `tanh(atanh ρ ± z √((1 + ρ²/2)/(n − 3)))` (Bonett and Wright 2000).
///
/// # Errors
/// As [`super::pearson`].
pub fn spearman(first: &[f64], second: &[f64], confidence: f64) -> Result<Correlation> {
    const METHOD: &str = "Spearman rank correlation";
    check_pair(first, second, METHOD)?;
    check_confidence(confidence)?;
    let rho = coefficient(&mid_ranks(first).ranks, &mid_ranks(second).ranks, METHOD)?;
    let free = first.len() as f64 - 3.0;
    let width = ((1.0 + rho * rho / 2.0) / free).sqrt();
    Ok(Correlation {
        test: t_test(METHOD, "ρ", rho, first.len()),
        interval: (free > 0.0).then(|| fisher_interval(rho, width, confidence)),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn any_monotone_map_leaves_it_alone() {
        let x = [0.3, 1.2, -0.7, 2.5, 0.9];
        let y = [1.0, 3.0, 0.5, 2.0, 2.5];
        let plain = spearman(&x, &y, 0.95).unwrap();
        let bent = spearman(&x.map(f64::exp), &y.map(|y| y.powi(3)), 0.95).unwrap();
        assert_eq!(plain, bent);
        // Ranks 2 4 1 5 3 and 2 5 1 3 4: ρ = 1 − 6·6/(5·24).
        assert!((plain.test.statistic - 0.7).abs() < 1e-15);
    }
}
