//! Sums over clusters from which a mixed model's likelihood follows for any ratio of variances.

use faer::Mat;

use crate::clustered::orthonormal::{Orthonormal, dot};
use crate::clustered::partition::Partition;
use crate::clustered::spectrum::{Spectrum, add_outer};
use crate::{Result, StatisticsError};

/// Cross products of the basis Q and the least-squares residual r, within and between clusters.
pub(super) struct ClusterMoments {
    /// Rows n.
    pub rows: f64,
    /// Columns p.
    pub columns: usize,
    /// Rows per cluster.
    pub sizes: Vec<f64>,
    /// Cluster means of Q: one vector of p per cluster.
    pub q_means: Vec<Vec<f64>>,
    /// Cluster means of r.
    pub r_means: Vec<f64>,
    /// `Q'Q` of deviations from the cluster means, p × p.
    pub q_within: Mat<f64>,
    /// `Q'r` of deviations from the cluster means.
    pub qr_within: Vec<f64>,
    /// `r'r` of deviations from the cluster means.
    pub r_within: f64,
}

impl ClusterMoments {
    pub fn of(basis: &Orthonormal, partition: &Partition) -> Self {
        let columns = basis.q.len();
        let mut column_means = Vec::with_capacity(columns);
        let mut deviations = Vec::with_capacity(columns);
        for column in &basis.q {
            let (means, rest) = split(column, partition);
            column_means.push(means);
            deviations.push(rest);
        }
        let (r_means, r_rest) = split(&basis.residual, partition);
        let q_means = (0..partition.count())
            .map(|cluster| column_means.iter().map(|means| means[cluster]).collect())
            .collect();
        Self {
            rows: basis.residual.len() as f64,
            columns,
            sizes: partition.sizes.clone(),
            q_means,
            r_means,
            q_within: Mat::from_fn(columns, columns, |i, j| dot(&deviations[i], &deviations[j])),
            qr_within: deviations
                .iter()
                .map(|column| dot(column, &r_rest))
                .collect(),
            r_within: dot(&r_rest, &r_rest),
        }
    }

    /// `within · Q'Q_within + Σ weight(n_g) q̄ q̄'`: every p × p sum of the likelihood and its
    /// derivatives has this form.
    pub fn weighted(&self, within: f64, weight: impl Fn(f64) -> f64) -> Mat<f64> {
        let mut sum = faer::Scale(within) * &self.q_within;
        for (size, mean) in self.sizes.iter().zip(&self.q_means) {
            add_outer(&mut sum, weight(*size), mean);
        }
        sum
    }

    /// Checks that both variances can be told from what the coefficients leave over.
    ///
    /// # Errors
    /// [`StatisticsError::NoFreedomLeft`].
    pub fn check_freedom(&self) -> Result<()> {
        /// Share of a direction that counts as none of it \[–\]: wholly between clusters it has eigenvalue 0 within, wholly within them 1.
        /// Chosen: far above rounding.
        const NONE: f64 = 1e-10;
        let within = Spectrum::of(&self.q_within).values;
        let wholly_between = within.iter().filter(|value| **value < NONE).count();
        let wholly_within = within.iter().filter(|value| **value > 1.0 - NONE).count();
        let clusters = self.sizes.len();
        let rows = self.rows as usize;
        let lacking = if clusters <= wholly_between {
            "variation between clusters"
        } else if rows <= clusters + wholly_within || rows < self.columns + 2 {
            "variation within clusters"
        } else {
            return Ok(());
        };
        Err(StatisticsError::NoFreedomLeft {
            what: lacking,
            rows,
            clusters,
            columns: self.columns,
        })
    }
}

/// Cluster means of a column and its deviations from them.
fn split(column: &[f64], partition: &Partition) -> (Vec<f64>, Vec<f64>) {
    let means = partition.means(column);
    let deviations = column
        .iter()
        .zip(&partition.index)
        .map(|(value, cluster)| value - means[*cluster])
        .collect();
    (means, deviations)
}
