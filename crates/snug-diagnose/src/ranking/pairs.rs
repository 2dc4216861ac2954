//! Two effects that explain much together, though neither does alone: how much, to first order.
//!
//! With scores s = (s_a, s_b) and the Gram matrix G of the two projected signatures, both decrease Σ r² by sᵀ G⁻¹ s with sizes
//! G⁻¹ s. A drive turned one way in one record and the other way in another needs dry friction and an offset of its torque; one
//! of them alone helps half of the records and harms the rest.

use crate::library::is_unlisted;
use crate::ranking::sensitivity::Column;
use crate::ranking::thresholds::{BEYOND_BOTH, PAIRS, UNLIKE};
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::Effect;

/// Inner products of all columns' projected signatures, summed over tightenings.
pub(crate) fn gram(signatures: &[Vec<f64>]) -> SymmetricMatrix {
    let size = signatures.len();
    let mut gram = SymmetricMatrix::zero(size);
    for i in 0..size {
        for j in 0..=i {
            gram.set(i, j, dot(&signatures[i], &signatures[j]));
        }
    }
    gram
}

/// The pairs of catalogue effects that are predicted to explain most, and more than the best of all alone; best first.
pub(crate) fn promising_pairs(columns: &[Column], gram: &SymmetricMatrix) -> Vec<[Effect; 2]> {
    let alone = |column: &Column| column.predicted_gain();
    let best_alone = columns.iter().map(alone).fold(0.0, f64::max);
    let mut pairs: Vec<(f64, [Effect; 2])> = Vec::new();
    for (i, a) in columns.iter().enumerate() {
        for (j, b) in columns.iter().enumerate().take(i) {
            if a.effect == b.effect || is_unlisted(a.effect) || is_unlisted(b.effect) {
                continue;
            }
            let gain = together([a, b], [gram.at(i, i), gram.at(i, j), gram.at(j, j)]);
            if gain > BEYOND_BOTH * best_alone {
                pairs.push((gain, [b.effect, a.effect]));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best: Vec<[Effect; 2]> = Vec::new();
    for (_, pair) in pairs {
        if !best.contains(&pair) && best.len() < PAIRS {
            best.push(pair);
        }
    }
    best
}

/// sᵀ G⁻¹ s; 0 for signatures that are hardly two, and where a size would have a sign that physics does not know.
fn together(columns: [&Column; 2], [aa, ab, bb]: [f64; 3]) -> f64 {
    let determinant = aa * bb - ab * ab;
    if determinant.is_nan() || determinant <= UNLIKE * aa * bb {
        return 0.0;
    }
    let [a, b] = columns.map(|column| column.scores.iter().sum::<f64>());
    let sizes = [
        (bb * a - ab * b) / determinant,
        (aa * b - ab * a) / determinant,
    ];
    let possible = columns.iter().zip(sizes);
    match possible
        .into_iter()
        .all(|(column, size)| column.may_be(size))
    {
        true => sizes[0] * a + sizes[1] * b,
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::close;
    use snug_model::Effect::{Backlash, CoulombFriction, CubicStiffness, TorqueOffset};

    /// Columns whose signatures and residual are given sample by sample.
    fn columns(
        signatures: &[(Effect, Vec<f64>)],
        residual: &[f64],
    ) -> (Vec<Column>, SymmetricMatrix) {
        let columns = signatures.iter().map(|(effect, z)| {
            let mut column = Column::with_scores(*effect, vec![dot(z, residual)]);
            column.information = dot(z, z);
            column
        });
        let signatures: Vec<Vec<f64>> = signatures.iter().map(|(_, z)| z.clone()).collect();
        (columns.collect(), gram(&signatures))
    }

    /// Friction pushes (1, 1, −1, −1), an offset (1, 1, 1, 1); the residual is their difference, (0, 0, −2, −2), all of which
    /// (8) both explain and each by itself half.
    #[test]
    fn two_that_stand_against_each_other_are_seen_together() {
        let (columns, gram) = columns(
            &[
                (CoulombFriction, vec![1.0, 1.0, -1.0, -1.0]),
                (TorqueOffset, vec![-1.0; 4]),
                (CubicStiffness, vec![1.0, -1.0, 0.0, 0.0]),
            ],
            &[0.0, 0.0, -2.0, -2.0],
        );
        close(columns[0].predicted_gain(), 4.0, 1e-12);
        let entries = [gram.at(0, 0), gram.at(0, 1), gram.at(1, 1)];
        close(together([&columns[0], &columns[1]], entries), 8.0, 1e-12);
        assert_eq!(
            promising_pairs(&columns, &gram),
            [[CoulombFriction, TorqueOffset]]
        );
    }

    #[test]
    fn one_signature_twice_and_a_size_of_the_wrong_sign_are_no_pair() {
        let twice = [
            (CubicStiffness, vec![1.0, 2.0, 3.0]),
            (TorqueOffset, vec![2.0, 4.0, 6.0]),
        ];
        let (same, gram_of_same) = columns(&twice, &[1.0, 2.0, 5.0]);
        assert!(promising_pairs(&same, &gram_of_same).is_empty());
        // A gap cannot be negative.
        let gap = [(CubicStiffness, vec![1.0, 0.0]), (Backlash, vec![0.0, 1.0])];
        let (gap, gram_of_gap) = columns(&gap, &[1.0, -3.0]);
        assert!(promising_pairs(&gap, &gram_of_gap).is_empty());
    }
}
