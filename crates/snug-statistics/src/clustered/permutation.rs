//! A test that asks how labels could have fallen, cluster by cluster.

use serde::{Deserialize, Serialize};

use super::arrangements::{Block, between_labels, run};
use super::partition::Partition;
use super::permutation_settings::PermutationSettings;
use crate::descriptive::Moments;
use crate::sample::{check_lengths, check_sample, is_constant};
use crate::{DoubleDouble, Result, StatisticsError, TestResult};

const METHOD: &str = "cluster-wise permutation test";

/// A permuted statistic this little (relative to the total) below the observed one equals it.
const TIE: f64 = 1e-12;

/// What a permutation test exchanges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Scheme {
    /// Labels among the rows of each cluster.
    WithinClusters,
    /// Labels among whole clusters.
    BetweenClusters,
}

/// Result of a permutation test.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PermutationTest {
    /// Statistic and p; no degrees of freedom.
    pub test: TestResult,
    /// What was exchanged.
    pub scheme: Scheme,
    /// Arrangements tried, beside the observed one when random.
    pub arrangements: usize,
    /// Whether all arrangements were tried.
    pub exact: bool,
}

/// Permutation test that labels have no effect on the response, for rows in clusters.
///
/// `label` and `cluster` hold an id per row. When a cluster holds more than one label, the
/// response is centred in each cluster and labels are exchanged among its rows: valid when rows of
/// a cluster are exchangeable if labels do nothing. Otherwise each cluster counts once with its
/// mean, and labels are exchanged among clusters. The statistic is η², the share of those values'
/// sum of squares between the labels, which orders arrangements as F does. `p` is the
/// share of all arrangements with an η² at least as large, or
/// `(1 + count)/(1 + permutations)` with random ones. Same seed, same bits.
///
/// # Errors
/// [`StatisticsError::LengthMismatch`]; [`StatisticsError::TooFew`];
/// [`StatisticsError::NotFinite`]; [`StatisticsError::TooFewGroups`] below two labels;
/// [`StatisticsError::ZeroVariance`]; [`StatisticsError::OutOfRange`] without permutations.
pub fn permutation_test(
    response: &[f64],
    label: &[usize],
    cluster: &[usize],
    settings: &PermutationSettings,
) -> Result<PermutationTest> {
    settings.check()?;
    check_lengths(("response", response.len()), ("label", label.len()))?;
    check_lengths(("response", response.len()), ("cluster", cluster.len()))?;
    check_sample("response", response, METHOD, 2)?;
    let labels = labels(label)?;
    let clusters = Partition::of(cluster);
    let mixed = clusters.index.iter().zip(&labels.index).any({
        let mut first = vec![None; clusters.count()];
        move |(cluster, label)| *first[*cluster].get_or_insert(*label) != *label
    });
    let (scheme, mut blocks) = if mixed {
        let blocks = blocks_within(response, &labels, &clusters);
        (Scheme::WithinClusters, blocks)
    } else {
        let block = block_between(response, &labels, &clusters);
        (Scheme::BetweenClusters, vec![block])
    };
    let spread: f64 = blocks
        .iter()
        .map(|b| b.values.iter().map(|v| v * v).sum::<f64>())
        .sum();
    if spread == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "response".into(),
            method: METHOD,
        });
    }
    let observed = between_labels(&blocks, labels.count());
    let bar = observed - TIE * spread;
    let outcome = run(&mut blocks, labels.count(), bar, settings);
    Ok(PermutationTest {
        test: TestResult {
            method: METHOD,
            statistic_name: "η²",
            statistic: observed / spread,
            degrees_of_freedom: vec![],
            p: outcome.p(),
        },
        scheme,
        arrangements: outcome.arrangements,
        exact: outcome.exact,
    })
}

/// Rows grouped by label, of which there must be two.
fn labels(label: &[usize]) -> Result<Partition> {
    let labels = Partition::of(label);
    if labels.count() < 2 {
        return Err(StatisticsError::TooFewGroups {
            method: METHOD,
            what: "labels",
            required: 2,
            found: labels.count(),
        });
    }
    Ok(labels)
}

/// One block per cluster: its rows' deviations from the cluster's mean.
fn blocks_within(response: &[f64], labels: &Partition, clusters: &Partition) -> Vec<Block> {
    let mut rows = vec![Vec::new(); clusters.count()];
    clusters
        .index
        .iter()
        .enumerate()
        .for_each(|(row, cluster)| rows[*cluster].push(row));
    rows.iter()
        .map(|rows| Block {
            values: centred(&rows.iter().map(|row| response[*row]).collect::<Vec<_>>()),
            labels: rows.iter().map(|row| labels.index[*row]).collect(),
        })
        .collect()
}

/// One block: the clusters' means, each with its cluster's label.
fn block_between(response: &[f64], labels: &Partition, clusters: &Partition) -> Block {
    let mut own = vec![0; clusters.count()];
    clusters
        .index
        .iter()
        .zip(&labels.index)
        .for_each(|(cluster, label)| own[*cluster] = *label);
    let offset = Moments::of(response).mean;
    let shifted: Vec<f64> = response
        .iter()
        .map(|value| (DoubleDouble::from(*value) - offset).to_f64())
        .collect();
    Block {
        values: centred(&clusters.means(&shifted)),
        labels: own,
    }
}

/// Deviations from the mean; exactly zero for values that are all the same.
fn centred(values: &[f64]) -> Vec<f64> {
    if is_constant(values) {
        return vec![0.0; values.len()];
    }
    let mean = Moments::of(values).mean;
    values
        .iter()
        .map(|value| (DoubleDouble::from(*value) - mean).to_f64())
        .collect()
}
