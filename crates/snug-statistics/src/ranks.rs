//! Ranks with ties shared out evenly.

/// Mid-ranks (1-based; equal values share the mean of their ranks) and the tie term `Σ(t³ − t)`.
pub(crate) struct Ranks {
    /// Rank of each value, in the order given.
    pub ranks: Vec<f64>,
    /// `Σ(t³ − t)` over the sizes t of the sets of equal values; 0 without ties.
    pub tie_term: f64,
}

/// Ranks finite values.
pub(crate) fn mid_ranks(values: &[f64]) -> Ranks {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut tie_term = 0.0;
    let mut first = 0;
    // `chunk_by` compares with `==`, so that 0.0 and -0.0 tie.
    for equal in order.chunk_by(|a, b| values[*a] == values[*b]) {
        let size = equal.len() as f64;
        let rank = first as f64 + (size + 1.0) / 2.0;
        equal.iter().for_each(|index| ranks[*index] = rank);
        tie_term += size * size * size - size;
        first += equal.len();
    }
    Ranks { ranks, tie_term }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_share_their_mean_rank() {
        let ranked = mid_ranks(&[3.0, 1.0, 3.0, 0.0, -0.0, 3.0]);
        assert_eq!(ranked.ranks, [5.0, 3.0, 5.0, 1.5, 1.5, 5.0]);
        assert_eq!(ranked.tie_term, 24.0 + 6.0);
    }
}
