//! What checks of a comparison of groups look at: the residuals about the groups' means.

use crate::DoubleDouble;
use crate::descriptive::Moments;

/// The groups of two values or more: a single value says nothing about the spread of its group.
#[must_use]
pub fn replicated<G: AsRef<[f64]>>(groups: &[G]) -> Vec<&[f64]> {
    groups
        .iter()
        .map(AsRef::as_ref)
        .filter(|group| group.len() >= 2)
        .collect()
}

/// Residuals `xᵢⱼ − x̄ⱼ` about the groups' means, group after group.
#[must_use]
pub fn residuals<G: AsRef<[f64]>>(groups: &[G]) -> Vec<f64> {
    groups
        .iter()
        .map(AsRef::as_ref)
        .flat_map(|group| {
            let mean = Moments::of(group).mean;
            group
                .iter()
                .map(move |value| (DoubleDouble::from(*value) - mean).to_f64())
        })
        .collect()
}

/// How many values equal another one.
///
/// Rounded readings and estimates on a bound tie. A continuous distribution has no ties, so that
/// a test of normality answers to them, too.
#[must_use]
pub fn tied(values: &[f64]) -> usize {
    let mut ordered = values.to_vec();
    ordered.sort_by(f64::total_cmp);
    ordered
        .chunk_by(|a, b| a == b)
        .map(<[f64]>::len)
        .filter(|size| *size >= 2)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_value_has_no_residual_to_look_at() {
        let groups = [vec![1.0, 2.0, 6.0], vec![8.0], vec![], vec![4.0, 4.0]];
        let found = replicated(&groups);
        assert_eq!(found, [&groups[0][..], &groups[3][..]]);
        assert_eq!(residuals(&found), [-2.0, -1.0, 3.0, 0.0, 0.0]);
    }

    #[test]
    fn a_large_common_offset_costs_no_digits() {
        let found = residuals(&[[1e15 + 1.0, 1e15 + 2.0, 1e15 + 3.0]]);
        assert_eq!(found, [-1.0, 0.0, 1.0]);
    }

    #[test]
    fn every_value_of_a_tie_counts() {
        assert_eq!(tied(&[0.0, 2.5, -0.0, 1.0, 2.5, 2.5]), 5);
        assert_eq!(tied(&[3.0, 1.0]), 0);
        assert_eq!(tied(&[]), 0);
    }
}
