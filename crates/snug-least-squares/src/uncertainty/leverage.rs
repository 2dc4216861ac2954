//! What an estimate owes to single samples.
//!
//! Where an effect lets go, the acceleration jumps at every contact. A sample that happens to lie within the instant in which
//! the law lets contact set in would, to first order, tell the time of contact a thousand times better than all others do
//! together; one beside it tells nothing. How quickly contact sets in is a choice of the law, not a property of the grip, so
//! what such samples seem to tell is left out of the uncertainty.

use crate::matrix::{dot, solve_upper_transposed, triangularize};
use crate::uncertainty::thresholds::MOST_LEVERAGE;

/// M for which (JᵀJ)⁻¹ M (JᵀJ)⁻¹ = (J'ᵀJ')⁻¹, J' being J without the rows that determine the estimate by themselves; row-major.
/// `None` where there are none, or nothing is left without them.
///
/// `jacobian` is column-major, `columns` wide; `matrix` is JᵀJ.
pub fn without_high_leverage(jacobian: &[f64], columns: usize, matrix: &[f64]) -> Option<Vec<f64>> {
    let rows = jacobian.len() / columns.max(1);
    let all = factor(jacobian, rows, columns);
    let row = |index: usize| -> Vec<f64> {
        let entries = (0..columns).map(|column| jacobian[column * rows + index]);
        entries.collect()
    };
    let kept: Vec<usize> = (0..rows)
        .filter(|&index| {
            let mut share = row(index);
            solve_upper_transposed(&all, columns, &mut share);
            dot(&share, &share) <= MOST_LEVERAGE
        })
        .collect();
    if kept.len() == rows || kept.len() <= columns {
        return None;
    }
    let left: Vec<f64> = jacobian
        .chunks_exact(rows)
        .flat_map(|column| kept.iter().map(|&index| column[index]))
        .collect();
    let left = factor(&left, kept.len(), columns);
    let taken_back: Vec<Vec<f64>> = matrix
        .chunks_exact(columns)
        .map(|row| {
            let mut row = row.to_vec();
            solve_upper_transposed(&left, columns, &mut row);
            row
        })
        .collect();
    let products = taken_back
        .iter()
        .flat_map(|a| taken_back.iter().map(move |b| dot(a, b)));
    let meat: Vec<f64> = products.collect();
    meat.iter().all(|value| value.is_finite()).then_some(meat)
}

/// R of the factorisation QR of a column-major matrix; column-major, `columns` × `columns`.
fn factor(matrix: &[f64], rows: usize, columns: usize) -> Vec<f64> {
    let mut matrix = matrix.to_vec();
    triangularize(&mut matrix, &mut vec![0.0; rows], rows, columns);
    let tops = matrix.chunks_exact(rows);
    tops.flat_map(|column| column[..columns].to_vec()).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Two independent columns: 400 samples tell the one, 400 others the other, and one sample more tells both far better.
    #[test]
    fn a_sample_that_tells_more_than_all_others_counts_for_nothing() {
        let told = |here: std::ops::Range<usize>, by_one: f64| -> Vec<f64> {
            (0..801)
                .map(|row| match row {
                    800 => by_one,
                    row if here.contains(&row) => 1.0,
                    _ => 0.0,
                })
                .collect()
        };
        let jacobian = [told(0..400, 30.0), told(400..800, -50.0)].concat();
        let matrix = [400.0 + 900.0, -1500.0, -1500.0, 400.0 + 2500.0];
        let meat = without_high_leverage(&jacobian, 2, &matrix).unwrap();
        // (J'ᵀJ')⁻¹ is 1/400 for each, so M = (JᵀJ)²/400.
        let square = [
            1300.0 * 1300.0 + 1500.0 * 1500.0,
            -1500.0 * (1300.0 + 2900.0),
            -1500.0 * (1300.0 + 2900.0),
            1500.0 * 1500.0 + 2900.0 * 2900.0,
        ];
        for (found, expected) in meat.iter().zip(square) {
            assert!((found / (expected / 400.0) - 1.0).abs() < 1e-12);
        }
        let even = [told(0..400, 1.0), told(400..800, 1.0)].concat();
        assert_eq!(
            without_high_leverage(&even, 2, &[401.0, 1.0, 1.0, 401.0]),
            None
        );
    }
}
