//! Regression with a sandwich covariance over clusters, and the degrees of freedom that few clusters leave.
//!
//! Each cluster's residuals are adjusted so that the covariance is unbiased where rows are independent after all (CR2), and the
//! degrees of freedom are estimated: few clusters with designs that differ need both. It is of linear regressions only.

use faer::Mat;

use super::Design;
use super::contrast::{LEAST_FREEDOM, in_basis, inverse};
use super::orthonormal::{Orthonormal, dot};
use super::partition::check_clustered;
use super::spectrum::{Spectrum, add_outer};
use crate::descriptive::Moments;
use crate::distributions::f_upper;
use crate::sample::is_constant;
use crate::{Result, StatisticsError, TestResult};

const METHOD: &str = "cluster-robust least squares";

/// A direction of which this much lies in a single cluster is left out of its adjustment.
const ABSORBED: f64 = 1e-10;
/// Variance of a contrast, over the squared lengths of its axis and of the residual, up to which it is rounding \[–\]. Chosen.
const ROUNDING: f64 = 1e-20;

/// A least-squares fit with a bias-reduced cluster-robust covariance.
pub struct ClusterRobustFit {
    design: Design,
    basis: Orthonormal,
    offset: f64,
    /// Per cluster: `S = Q_g'Q_g` and `(I − S)^{−1/2}`, p × p.
    clusters: Vec<(Mat<f64>, Mat<f64>)>,
    /// Covariance of the coefficients in the basis, p × p.
    covariance: Mat<f64>,
}

/// Least squares whose covariance lets rows of one cluster depend on each other in any way
/// (CR2: Bell and McCaffrey 2002), with small-sample degrees of freedom for few clusters.
///
/// `Cov = M Σ_g X_g'A_g e_g e_g'A_g X_g M`, `M = (X'X)⁻¹`, `A_g = (I − X_g M X_g')^{−1/2}`, which
/// is unbiased when rows are independent after all. Clusters may enter the design as a factor.
///
/// # Errors
/// [`StatisticsError::LengthMismatch`]; [`StatisticsError::TooFew`];
/// [`StatisticsError::NotFinite`]; [`StatisticsError::TooFewGroups`] below two clusters;
/// [`StatisticsError::RankDeficient`]; [`StatisticsError::NoFreedomLeft`] without more rows than
/// coefficients; [`StatisticsError::ZeroVariance`] when the design explains the response wholly.
pub fn fit_cluster_robust(
    design: &Design,
    cluster: &[usize],
    response: &[f64],
) -> Result<ClusterRobustFit> {
    let partition = check_clustered(design, cluster, response, METHOD)?;
    let offset = Moments::of(response).mean.to_f64();
    let centred: Vec<f64> = response.iter().map(|value| value - offset).collect();
    let basis = Orthonormal::of(design, &centred)?;
    let columns = basis.q.len();
    if design.rows() <= columns {
        return Err(StatisticsError::NoFreedomLeft {
            what: "residual",
            rows: design.rows(),
            clusters: partition.count(),
            columns,
        });
    }
    if is_constant(response) || basis.leaves_nothing() {
        return Err(StatisticsError::ZeroVariance {
            sample: "response beyond the design".into(),
            method: METHOD,
        });
    }
    let mut products = vec![Mat::<f64>::zeros(columns, columns); partition.count()];
    let mut scores = vec![vec![0.0; columns]; partition.count()];
    let mut row = vec![0.0; columns];
    for (index, (cluster, residual)) in partition.index.iter().zip(&basis.residual).enumerate() {
        row.iter_mut()
            .zip(&basis.q)
            .for_each(|(entry, column)| *entry = column[index]);
        add_outer(&mut products[*cluster], 1.0, &row);
        scores[*cluster]
            .iter_mut()
            .zip(&row)
            .for_each(|(sum, q)| *sum += q * residual);
    }
    let mut covariance = Mat::zeros(columns, columns);
    let mut clusters = Vec::with_capacity(products.len());
    for (product, score) in products.into_iter().zip(&scores) {
        let adjustment = adjustment(&product);
        let adjusted: Vec<f64> = (0..columns)
            .map(|row| {
                (0..columns)
                    .map(|column| adjustment[(row, column)] * score[column])
                    .sum()
            })
            .collect();
        add_outer(&mut covariance, 1.0, &adjusted);
        clusters.push((product, adjustment));
    }
    Ok(ClusterRobustFit {
        design: design.clone(),
        basis,
        offset,
        clusters,
        covariance,
    })
}

/// `(I − S)^{−1/2}`, without the directions that lie wholly in this cluster.
///
/// `f(QQ')Q = Q f(Q'Q)`: the root of an n_g × n_g matrix from a p × p one.
fn adjustment(product: &Mat<f64>) -> Mat<f64> {
    Spectrum::of(product).map(|share| {
        if share > 1.0 - ABSORBED {
            0.0
        } else {
            (1.0 - share).sqrt().recip()
        }
    })
}

impl ClusterRobustFit {
    /// Test that all coefficients of a term are zero.
    ///
    /// # Errors
    /// [`StatisticsError::UnknownTerm`] and those of [`Self::test_contrasts`].
    pub fn test_term(&self, term: &str) -> Result<TestResult> {
        self.test_contrasts(&self.design.term_contrasts(term)?)
    }

    /// Approximate Hotelling T² test that all of several contrasts are zero (Pustejovsky and
    /// Tipton 2018): `F = (η − q + 1)/(η q) · (Lβ)'(L Cov L')⁻¹Lβ` on `q` and `η − q + 1`.
    ///
    /// # Errors
    /// [`StatisticsError::LengthMismatch`]; [`StatisticsError::NotFinite`];
    /// [`StatisticsError::DependentContrasts`], also when there are too few clusters for so many
    /// contrasts.
    pub fn test_contrasts(&self, contrasts: &[Vec<f64>]) -> Result<TestResult> {
        let axes = self.axes(contrasts)?;
        let covariance = axes.transpose() * &self.covariance * &axes;
        let q = contrasts.len() as f64;
        let eta = self.freedom(&axes)?;
        let df = eta - q + 1.0;
        self.check_spread(&axes, &covariance)?;
        let (Some(inverse), true) = (inverse(&covariance), df >= LEAST_FREEDOM) else {
            return Err(self.dependent(contrasts.len()));
        };
        let estimates = Mat::from_fn(contrasts.len(), 1, |row, _| {
            self.estimate(&axes, contrasts, row)
        });
        let wald = (estimates.transpose() * inverse * &estimates)[(0, 0)];
        let f = df / (eta * q) * wald;
        Ok(TestResult {
            method: "cluster-robust F test (CR2, approximate Hotelling T²)",
            statistic_name: "F",
            statistic: f,
            degrees_of_freedom: vec![q, df],
            p: f_upper(f, q, df),
        })
    }

    fn axes(&self, contrasts: &[Vec<f64>]) -> Result<Mat<f64>> {
        in_basis(&self.design, &self.basis, contrasts, self.clusters.len())
    }

    fn estimate(&self, axes: &Mat<f64>, contrasts: &[Vec<f64>], column: usize) -> f64 {
        let axis: Vec<f64> = (0..axes.nrows()).map(|row| axes[(row, column)]).collect();
        dot(&axis, &self.basis.coordinates) + contrasts[column][0] * self.offset
    }

    /// Refuses contrasts whose clusters are explained wholly: their variance is rounding.
    fn check_spread(&self, axes: &Mat<f64>, covariance: &Mat<f64>) -> Result<()> {
        let residual = dot(&self.basis.residual, &self.basis.residual);
        for index in 0..axes.ncols() {
            let length: f64 = (0..axes.nrows())
                .map(|row| axes[(row, index)].powi(2))
                .sum();
            if covariance[(index, index)] <= ROUNDING * length * residual {
                return Err(StatisticsError::ZeroVariance {
                    sample: "response in the clusters that decide a contrast".into(),
                    method: METHOD,
                });
            }
        }
        Ok(())
    }

    fn dependent(&self, contrasts: usize) -> StatisticsError {
        StatisticsError::DependentContrasts {
            contrasts,
            clusters: self.clusters.len(),
        }
    }

    /// Degrees of freedom η of the Wishart distribution that matches the total variance of the
    /// contrasts' covariance when rows are independent: `q(q + 1)/Σ [(tr P_gh)² + tr P_gh²]` with
    /// `P_gh = δ_gh D_g'S_gD_g − D_g'S_gS_hD_h` and `D_g = (I − S_g)^{−1/2} c Ω^{−1/2}`.
    fn freedom(&self, axes: &Mat<f64>) -> Result<f64> {
        let q = axes.ncols();
        let loadings: Vec<Mat<f64>> = self
            .clusters
            .iter()
            .map(|(_, adjustment)| adjustment * axes)
            .collect();
        let expected = self.expected(&loadings, q);
        if inverse(&expected).is_none() {
            return Err(self.dependent(q));
        }
        let scale = Spectrum::of(&expected).map(|value| value.sqrt().recip());
        let scaled: Vec<Mat<f64>> = loadings.iter().map(|loading| loading * &scale).collect();
        let shadows: Vec<Mat<f64>> = self
            .clusters
            .iter()
            .zip(&scaled)
            .map(|((product, _), loading)| product * loading)
            .collect();
        let mut total = 0.0;
        for (g, left) in shadows.iter().enumerate() {
            for (h, right) in shadows.iter().enumerate() {
                let own = if g == h {
                    scaled[g].transpose() * right
                } else {
                    Mat::zeros(q, q)
                };
                let block = own - left.transpose() * right;
                let trace: f64 = (0..q).map(|i| block[(i, i)]).sum();
                let square = &block * &block;
                total += trace * trace + (0..q).map(|i| square[(i, i)]).sum::<f64>();
            }
        }
        Ok((q * (q + 1)) as f64 / total)
    }

    /// `Σ_g D_g'(S_g − S_g²)D_g`: the contrasts' covariance expected from independent rows.
    fn expected(&self, loadings: &[Mat<f64>], q: usize) -> Mat<f64> {
        let mut sum = Mat::zeros(q, q);
        for ((product, _), loading) in self.clusters.iter().zip(loadings) {
            let shadow = product * loading;
            sum += loading.transpose() * &shadow - shadow.transpose() * &shadow;
        }
        sum
    }
}
