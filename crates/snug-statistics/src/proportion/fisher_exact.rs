use serde::Serialize;

use crate::{Result, StatisticsError, TestResult};

/// Result of [`fisher_exact`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FisherExact {
    /// The sample odds ratio as statistic, and p.
    pub test: TestResult,
    /// `ad/(bc)`; infinite when only the denominator is zero.
    pub odds_ratio: f64,
}

/// Tables less likely than this, relative to the most likely one, are left out.
const NEGLIGIBLE: f64 = 1e-300;

/// Tables whose probability is within this factor of the observed one count as equally likely.
const TIE: f64 = 1.0 + 1e-10;

/// Fisher's exact test of a 2×2 table `[[a, b], [c, d]]`, two-sided: the total probability, with
/// the margins fixed, of all tables no more likely than the observed one.
///
/// # Errors
/// [`StatisticsError::ZeroVariance`] when a row or column is empty.
pub fn fisher_exact(table: [[u32; 2]; 2]) -> Result<FisherExact> {
    const METHOD: &str = "Fisher exact test";
    let [[a, b], [c, d]] = table.map(|row| row.map(u64::from));
    let (row1, row2, column1, column2) = (a + b, c + d, a + c, b + d);
    if row1.min(row2).min(column1).min(column2) == 0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "table".into(),
            method: METHOD,
        });
    }
    let (least, most) = (column1.saturating_sub(row2), row1.min(column1));
    // Probabilities relative to the most likely table, by the ratio of neighbours, outwards
    // until they no longer count.
    let mode = ((row1 + 1) * (column1 + 1) / (row1 + row2 + 2)).clamp(least, most);
    let ratio = |x: u64| {
        (row1 - x) as f64 * (column1 - x) as f64
            / ((x + 1) as f64 * (row2 + x + 1 - column1) as f64)
    };
    let walk = |next: &dyn Fn(u64, f64) -> Option<(u64, f64)>| {
        std::iter::successors(next(mode, 1.0), |(x, weight)| next(*x, *weight))
            .take_while(|(_, weight)| *weight > NEGLIGIBLE)
            .collect::<Vec<_>>()
    };
    let mut tables = walk(&|x, weight| (x < most).then(|| (x + 1, weight * ratio(x))));
    tables.extend(walk(&|x, weight| {
        (x > least).then(|| (x - 1, weight / ratio(x - 1)))
    }));
    tables.push((mode, 1.0));
    let observed = tables
        .iter()
        .find(|(x, _)| *x == a)
        .map_or(0.0, |(_, weight)| weight * TIE);
    let mut weights: Vec<f64> = tables.into_iter().map(|(_, weight)| weight).collect();
    // Smallest first, so that tiny tails are not lost in the sum.
    weights.sort_by(f64::total_cmp);
    let total: f64 = weights.iter().sum();
    let extreme: f64 = weights
        .iter()
        .take_while(|weight| **weight <= observed)
        .sum();
    let odds_ratio = (a * d) as f64 / (b * c) as f64;
    Ok(FisherExact {
        test: TestResult {
            method: METHOD,
            statistic_name: "odds ratio",
            statistic: odds_ratio,
            degrees_of_freedom: vec![],
            p: (extreme / total).min(1.0),
        },
        odds_ratio,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_lady_tasting_tea() {
        let found = fisher_exact([[3, 1], [1, 3]]).unwrap();
        // 34 of C(8, 4) = 70 arrangements are no more likely.
        assert!((found.test.p - 34.0 / 70.0).abs() < 1e-15);
        assert_eq!(found.odds_ratio, 9.0);
    }

    #[test]
    fn an_empty_margin_is_an_error() {
        let found = fisher_exact([[0, 0], [3, 4]]);
        assert!(matches!(found, Err(StatisticsError::ZeroVariance { .. })));
    }
}
