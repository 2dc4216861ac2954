use serde::Serialize;

use crate::distributions::chi_squared_upper;
use crate::sample::check_lengths;
use crate::{Result, StatisticsError, TestResult};

/// Result of [`chi_squared`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChiSquared {
    /// χ², its degrees of freedom and p.
    pub test: TestResult,
    /// Cramér's V: 0 for independence, 1 for full association.
    pub cramers_v: f64,
    /// Smallest expected count; the approximation is sound from about five on.
    pub smallest_expected: f64,
}

/// Pearson's chi-squared test that rows and columns of a table of counts are independent.
///
/// `χ² = Σ (O − E)²/E` on `(r − 1)(c − 1)` degrees of freedom, without continuity correction.
///
/// # Errors
/// [`StatisticsError::TooFewGroups`] below two rows or columns;
/// [`StatisticsError::LengthMismatch`] for ragged rows; [`StatisticsError::ZeroVariance`] when a
/// row or column is empty.
pub fn chi_squared<R: AsRef<[usize]>>(table: &[R]) -> Result<ChiSquared> {
    const METHOD: &str = "chi-squared test of independence";
    let columns = table.first().map_or(0, |row| row.as_ref().len());
    for (what, found) in [("rows", table.len()), ("columns", columns)] {
        if found < 2 {
            return Err(StatisticsError::TooFewGroups {
                method: METHOD,
                what,
                required: 2,
                found,
            });
        }
    }
    for row in table {
        check_lengths(("first row", columns), ("a later row", row.as_ref().len()))?;
    }
    let row_sums: Vec<f64> = table
        .iter()
        .map(|row| row.as_ref().iter().sum::<usize>() as f64)
        .collect();
    let column_sums: Vec<f64> = (0..columns)
        .map(|column| table.iter().map(|row| row.as_ref()[column]).sum::<usize>() as f64)
        .collect();
    if row_sums.iter().chain(&column_sums).any(|sum| *sum == 0.0) {
        return Err(StatisticsError::ZeroVariance {
            sample: "table".into(),
            method: METHOD,
        });
    }
    let total: f64 = row_sums.iter().sum();
    let mut statistic = 0.0;
    let mut smallest_expected = f64::INFINITY;
    for (row, row_sum) in table.iter().zip(&row_sums) {
        for (count, column_sum) in row.as_ref().iter().zip(&column_sums) {
            let expected = row_sum * column_sum / total;
            statistic += (*count as f64 - expected).powi(2) / expected;
            smallest_expected = smallest_expected.min(expected);
        }
    }
    let (rows, columns) = (table.len() as f64, columns as f64);
    let df = (rows - 1.0) * (columns - 1.0);
    Ok(ChiSquared {
        test: TestResult {
            method: METHOD,
            statistic_name: "χ²",
            statistic,
            degrees_of_freedom: vec![df],
            p: chi_squared_upper(statistic, df),
        },
        cramers_v: (statistic / (total * (rows.min(columns) - 1.0))).sqrt(),
        smallest_expected,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn proportional_rows_are_independent_and_a_diagonal_is_not() {
        let found = chi_squared(&[[10, 20, 30], [20, 40, 60]]).unwrap();
        assert!(found.test.statistic < 1e-12 && found.test.p > 1.0 - 1e-9);
        let found = chi_squared(&[[7, 0], [0, 5]]).unwrap();
        assert!((found.cramers_v - 1.0).abs() < 1e-15);
        assert!((found.test.statistic - 12.0).abs() < 1e-12);
    }

    #[test]
    fn unusable_tables_are_named() {
        let ragged = chi_squared(&[vec![1, 2], vec![3]]);
        assert!(matches!(
            ragged,
            Err(StatisticsError::LengthMismatch { .. })
        ));
        let thin = chi_squared(&[[1, 2]]);
        assert!(matches!(
            thin,
            Err(StatisticsError::TooFewGroups { what: "rows", .. })
        ));
        let empty = chi_squared(&[[1, 0], [3, 0]]);
        assert!(matches!(empty, Err(StatisticsError::ZeroVariance { .. })));
    }
}
