use serde::Serialize;

use super::quantile::{sorted, sorted_quantile};
use crate::sample::{check_finite, check_sample};
use crate::{Result, StatisticsError};

/// Most bins the automatic rule makes; far outliers would otherwise ask for millions.
const MOST_BINS: f64 = 512.0;

/// Counts of a sample in adjoining bins.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Histogram {
    /// Ascending bin edges, one more than bins. A bin holds its lower edge; the last one holds
    /// its upper edge too.
    pub edges: Vec<f64>,
    /// Values per bin.
    pub counts: Vec<usize>,
    /// Values below the first edge.
    pub below: usize,
    /// Values above the last edge.
    pub above: usize,
}

/// Histogram with equal bins of about the Freedman–Diaconis width `2 IQR n^{-1/3}`.
///
/// The number of bins is the range over that width, rounded up, at most 512. When the middle
/// half of the sample is one value, Sturges' `log₂ n + 1` bins; when the whole sample is one
/// value, one bin of width 1 (or 2e-6 of it) around it.
///
/// # Errors
/// [`StatisticsError::TooFew`] for an empty sample, [`StatisticsError::NotFinite`].
pub fn histogram(values: &[f64]) -> Result<Histogram> {
    check_sample("values", values, "histogram", 1)?;
    let ordered = sorted(values);
    let (low, high) = (ordered[0], ordered[ordered.len() - 1]);
    if low == high {
        // Beyond 1e6 half a unit is not enough to tell the edges apart.
        let half = (1e-6 * low.abs()).max(0.5);
        return Ok(count(values, &[low - half, low + half]));
    }
    let n = values.len() as f64;
    let middle_half = sorted_quantile(&ordered, 0.75) - sorted_quantile(&ordered, 0.25);
    let width = 2.0 * middle_half / n.cbrt();
    let wanted = if width > 0.0 {
        (high - low) / width
    } else {
        n.log2() + 1.0
    };
    let bins = wanted.ceil().clamp(1.0, MOST_BINS) as usize;
    let step = (high - low) / bins as f64;
    let mut edges: Vec<f64> = (0..=bins).map(|bin| low + step * bin as f64).collect();
    // The last edge is the largest value itself, whatever the rounding of the steps.
    edges[bins] = high;
    // Neighbouring floats cannot be told apart by finer bins.
    edges.dedup();
    Ok(count(values, &edges))
}

/// Histogram in given bins, so that several samples can share them.
///
/// # Errors
/// [`StatisticsError::NotFinite`] for `values` or `edges`; [`StatisticsError::TooFew`] below two
/// edges; [`StatisticsError::OutOfRange`] for an edge that is not above the one before it.
pub fn histogram_with_edges(values: &[f64], edges: &[f64]) -> Result<Histogram> {
    check_finite("values", values)?;
    check_sample("edges", edges, "histogram", 2)?;
    if let Some(pair) = edges.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(StatisticsError::OutOfRange {
            argument: "edges",
            value: pair[1],
            allowed: "every edge above the one before it",
        });
    }
    Ok(count(values, edges))
}

/// Sorts finite values into bins with ascending edges.
fn count(values: &[f64], edges: &[f64]) -> Histogram {
    let bins = edges.len() - 1;
    let mut result = Histogram {
        edges: edges.to_vec(),
        counts: vec![0; bins],
        below: 0,
        above: 0,
    };
    for value in values {
        if *value > edges[bins] {
            result.above += 1;
        } else {
            match edges.partition_point(|edge| edge <= value) {
                0 => result.below += 1,
                passed => result.counts[(passed - 1).min(bins - 1)] += 1,
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn edges_belong_to_the_bin_above_and_the_last_to_the_last() {
        let found = histogram_with_edges(&[-1.0, 0.0, 0.5, 1.0, 1.9, 2.0, 2.1], &[0.0, 1.0, 2.0]);
        let found = found.unwrap();
        assert_eq!((found.counts, found.below, found.above), (vec![2, 3], 1, 1));
    }

    #[test]
    fn one_to_hundred_follows_freedman_diaconis() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        // IQR 49.5, width 99/100^(1/3) = 21.33, 99/21.33 = 4.64 -> 5 bins of 19.8.
        let found = histogram(&values).unwrap();
        assert_eq!(found.counts, [20, 20, 20, 20, 20]);
        assert_eq!(found.edges[5], 100.0);
    }

    #[test]
    fn degenerate_samples_still_count_every_value() {
        assert_eq!(histogram(&[3.0; 4]).unwrap().counts, [4]);
        let mut outlier = vec![0.0; 100];
        outlier.push(1.0);
        assert_eq!(
            histogram(&outlier).unwrap().counts.iter().sum::<usize>(),
            101
        );
        let far: Vec<f64> = (0..100).map(f64::from).chain([1e12]).collect();
        assert_eq!(histogram(&far).unwrap().counts.len(), 512);
        let neighbours = [1e15, 1e15 + 0.125, 1e15 + 0.25];
        assert_eq!(
            histogram(&neighbours).unwrap().counts.iter().sum::<usize>(),
            3
        );
    }

    #[test]
    fn edges_must_ascend() {
        let found = histogram_with_edges(&[1.0], &[0.0, 2.0, 2.0]);
        assert!(matches!(
            found,
            Err(StatisticsError::OutOfRange { value: 2.0, .. })
        ));
    }
}
