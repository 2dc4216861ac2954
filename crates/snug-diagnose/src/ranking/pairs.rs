//! Two effects that explain much together, though neither does alone: how much, to first order.
//!
//! With scores s = (s_a, s_b) and the Gram matrix G of the two projected signatures, both decrease Σ r² by sᵀ G⁻¹ s with sizes
//! G⁻¹ s. A drive turned one way in one record and the other way in another needs dry friction and an offset of its torque; one
//! of them alone helps half of the records and harms the rest.

use crate::library::is_unlisted;
use crate::ranking::sensitivity::Column;
use crate::ranking::thresholds::{BEYOND_BOTH, PAIRS, UNLIKE};
use crate::settings::DiagnoseSettings;
use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;
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

/// Two effects and the chance that any two do so well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pair {
    pub effects: [Effect; 2],
    /// Family-wise over all pairs: how often the largest T² = sᵀ V⁻¹ s, V = Σ u uᵀ over the clusters' scores u, reaches as far when
    /// whole clusters flip their sign.
    pub p_family: f64,
}

/// The pairs of catalogue effects that are predicted to explain most, and more than either alone; best first.
pub(crate) fn promising_pairs(
    columns: &[Column],
    gram: &SymmetricMatrix,
    settings: &DiagnoseSettings,
) -> Vec<Pair> {
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    let mut all: Vec<[usize; 2]> = Vec::new();
    for (i, a) in columns.iter().enumerate() {
        for (j, b) in columns.iter().enumerate().take(i) {
            if a.effect == b.effect || is_unlisted(a.effect) || is_unlisted(b.effect) {
                continue;
            }
            all.push([j, i]);
            let gain = together([a, b], [gram.at(i, i), gram.at(i, j), gram.at(j, j)]);
            if gain > BEYOND_BOTH * a.predicted_gain().max(b.predicted_gain()) {
                pairs.push((gain, [j, i]));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best: Vec<[usize; 2]> = Vec::new();
    let effects = |pair: [usize; 2]| pair.map(|index| columns[index].effect);
    for (_, pair) in pairs {
        let is_known = best.iter().any(|&known| effects(known) == effects(pair));
        if !is_known && best.len() < PAIRS {
            best.push(pair);
        }
    }
    if best.is_empty() {
        return Vec::new();
    }
    let largest = largest_by_chance(columns, &all, settings);
    let of_pair = |pair: [usize; 2]| {
        let reached =
            spread(columns, pair).map_or(0.0, |spread| spread.statistic(sums(columns, pair)));
        let as_far = largest
            .iter()
            .filter(|&&largest| largest >= reached)
            .count();
        Pair {
            effects: effects(pair),
            p_family: (as_far + 1) as f64 / (largest.len() + 1) as f64,
        }
    };
    let best: Vec<Pair> = best.into_iter().map(of_pair).collect();
    for Pair { effects, p_family } in &best {
        let [a, b] = effects.map(|effect| effect.name());
        tracing::debug!(a, b, p_family, "promise much together");
    }
    best
}

/// Σ u of both.
fn sums(columns: &[Column], pair: [usize; 2]) -> [f64; 2] {
    pair.map(|index| columns[index].scores.iter().sum())
}

/// V = Σ u uᵀ of two columns.
struct Spread([f64; 3]);

/// `None` for two that are hardly different.
fn spread(columns: &[Column], [a, b]: [usize; 2]) -> Option<Spread> {
    let (u, v) = (&columns[a].scores, &columns[b].scores);
    let entries = [dot(u, u), dot(u, v), dot(v, v)];
    let [aa, ab, bb] = entries;
    (aa * bb - ab * ab > UNLIKE * aa * bb).then_some(Spread(entries))
}

impl Spread {
    /// sᵀ V⁻¹ s.
    fn statistic(&self, [a, b]: [f64; 2]) -> f64 {
        let Self([aa, ab, bb]) = self;
        (bb * a * a - 2.0 * ab * a * b + aa * b * b) / (aa * bb - ab * ab)
    }
}

/// The largest T² of all pairs, flip by flip.
fn largest_by_chance(
    columns: &[Column],
    pairs: &[[usize; 2]],
    settings: &DiagnoseSettings,
) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(settings.seed);
    let clusters = columns.first().map_or(0, |column| column.scores.len());
    let spreads: Vec<([usize; 2], Spread)> = (pairs.iter())
        .filter_map(|&pair| Some((pair, spread(columns, pair)?)))
        .collect();
    let flip = |_| {
        let signs: Vec<f64> = (0..clusters)
            .map(|_| {
                if random.next_u64() & 1 == 1 {
                    1.0
                } else {
                    -1.0
                }
            })
            .collect();
        let sums: Vec<f64> = (columns.iter())
            .map(|column| dot(&signs, &column.scores))
            .collect();
        let statistics = spreads
            .iter()
            .map(|([a, b], spread)| spread.statistic([sums[*a], sums[*b]]));
        statistics.fold(0.0, f64::max)
    };
    (0..settings.sign_flips).map(flip).collect()
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
    use crate::tests::made_up::{close, quick};
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
        let pairs = promising_pairs(&columns, &gram, &quick(99));
        assert_eq!(pairs.len(), 1);
        assert_eq!(pairs[0].effects, [CoulombFriction, TorqueOffset]);
    }

    #[test]
    fn one_signature_twice_and_a_size_of_the_wrong_sign_are_no_pair() {
        let twice = [
            (CubicStiffness, vec![1.0, 2.0, 3.0]),
            (TorqueOffset, vec![2.0, 4.0, 6.0]),
        ];
        let (same, gram_of_same) = columns(&twice, &[1.0, 2.0, 5.0]);
        assert!(promising_pairs(&same, &gram_of_same, &quick(99)).is_empty());
        // A gap cannot be negative.
        let gap = [(CubicStiffness, vec![1.0, 0.0]), (Backlash, vec![0.0, 1.0])];
        let (gap, gram_of_gap) = columns(&gap, &[1.0, -3.0]);
        assert!(promising_pairs(&gap, &gram_of_gap, &quick(99)).is_empty());
    }

    /// In two groups of clusters two effects push the same way and against each other: u = (1, 1) six times, (1, −1) six times.
    /// Of both signs' sums, T² = 12 (s_a² + s_b²) / 12² for V = 12 I; 12 at s = (12, 0), as at every other corner, and larger nowhere.
    #[test]
    fn the_chance_of_a_pair_is_that_of_its_clusters_signs() {
        let scores = |sign: f64| (0..12).map(|n| if n < 6 { 1.0 } else { sign }).collect();
        let columns = [
            Column::with_scores(CubicStiffness, scores(1.0)),
            Column::with_scores(TorqueOffset, scores(-1.0)),
        ];
        let Some(spread) = spread(&columns, [0, 1]) else {
            panic!("they are two")
        };
        close(spread.statistic(sums(&columns, [0, 1])), 12.0, 1e-12);
        let largest = largest_by_chance(&columns, &[[0, 1]], &quick(3999));
        // Both halves must each agree with themselves: 2 · 2⁻⁶ squared.
        let as_far = largest.iter().filter(|&&l| l > 12.0 - 1e-9).count() as f64 / 3999.0;
        let expected = (2.0_f64 / 64.0).powi(2);
        let scatter = (expected / 3999.0).sqrt();
        assert!((as_far - expected).abs() < 5.0 * scatter, "{as_far}");
    }
}
