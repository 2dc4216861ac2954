//! Observations sorted into their clusters.

use std::collections::BTreeMap;

use super::Design;
use crate::sample::{check_lengths, check_sample};
use crate::{Result, StatisticsError};

/// Rows sorted into clusters, numbered in ascending order of their ids.
pub(super) struct Partition {
    /// Cluster number of each row.
    pub index: Vec<usize>,
    /// Rows per cluster.
    pub sizes: Vec<f64>,
}

impl Partition {
    /// Groups rows by cluster id.
    pub fn of(ids: &[usize]) -> Self {
        let distinct: BTreeMap<usize, ()> = ids.iter().map(|id| (*id, ())).collect();
        let numbers: BTreeMap<usize, usize> = distinct.into_keys().zip(0..).collect();
        let index: Vec<usize> = ids.iter().map(|id| numbers[id]).collect();
        let mut sizes = vec![0.0; numbers.len()];
        index.iter().for_each(|cluster| sizes[*cluster] += 1.0);
        Self { index, sizes }
    }

    /// Number of clusters.
    pub fn count(&self) -> usize {
        self.sizes.len()
    }

    /// Mean of a column in each cluster.
    pub fn means(&self, column: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        self.index
            .iter()
            .zip(column)
            .for_each(|(cluster, value)| sums[*cluster] += value);
        sums.iter()
            .zip(&self.sizes)
            .map(|(sum, size)| sum / size)
            .collect()
    }

    /// True when a column has one value per cluster.
    pub fn is_constant_within(&self, column: &[f64]) -> bool {
        let mut first = vec![None; self.count()];
        self.index
            .iter()
            .zip(column)
            .all(|(cluster, value)| *first[*cluster].get_or_insert(*value) == *value)
    }
}

/// Checks the arguments of a clustered fit and groups its rows.
pub(super) fn check_clustered(
    design: &Design,
    cluster: &[usize],
    response: &[f64],
    method: &'static str,
) -> Result<Partition> {
    check_lengths(("design", design.rows()), ("cluster", cluster.len()))?;
    check_lengths(("design", design.rows()), ("response", response.len()))?;
    check_sample("response", response, method, 3)?;
    let partition = Partition::of(cluster);
    if partition.count() < 2 {
        return Err(StatisticsError::TooFewGroups {
            method,
            what: "clusters",
            required: 2,
            found: partition.count(),
        });
    }
    Ok(partition)
}
