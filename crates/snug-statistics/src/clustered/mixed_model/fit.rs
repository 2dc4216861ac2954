//! A random intercept per cluster, fitted by restricted maximum likelihood.

use faer::Mat;

use super::cluster_moments::ClusterMoments;
use super::likelihood::{Profile, minimise};
use crate::clustered::Design;
use crate::clustered::contrast::{LEAST_FREEDOM, in_basis, inverse};
use crate::clustered::orthonormal::{Orthonormal, dot};
use crate::clustered::partition::check_clustered;
use crate::clustered::spectrum::Spectrum;
use crate::descriptive::Moments;
use crate::distributions::f_upper;
use crate::sample::is_constant;
use crate::{Result, StatisticsError, TestResult};

const METHOD: &str = "random-intercept model";

/// A fitted random-intercept model.
pub struct RandomInterceptFit {
    design: Design,
    basis: Orthonormal,
    profile: Profile,
    /// γ: coefficients in the basis.
    coordinates: Vec<f64>,
    /// Mean taken off the response before the fit.
    offset: f64,
    /// What the response was divided by before the fit.
    unit: f64,
    /// Whether each column has one value per cluster.
    constant_within: Vec<bool>,
    /// Number of rows.
    pub rows: usize,
    /// Number of clusters.
    pub clusters: usize,
    /// σ_b²: variance between clusters, in the response's unit squared.
    pub between_variance: f64,
    /// σ²: variance within clusters, in the response's unit squared.
    pub residual_variance: f64,
    /// Intraclass correlation `σ_b²/(σ_b² + σ²)`.
    pub intraclass_correlation: f64,
    /// −2 ln restricted likelihood, constants included (lme4's REML criterion).
    pub restricted_deviance: f64,
}

/// Fits `y = Xβ + b_cluster + e` by restricted maximum likelihood, `σ_b² ≥ 0`.
///
/// `cluster` holds an id per row; the order of rows and the ids' values do not matter.
///
/// # Errors
/// [`StatisticsError::LengthMismatch`]; [`StatisticsError::TooFew`];
/// [`StatisticsError::NotFinite`]; [`StatisticsError::TooFewGroups`] below two clusters;
/// [`StatisticsError::RankDeficient`] naming the column; [`StatisticsError::NoFreedomLeft`] when
/// the design takes up all clusters or all rows; [`StatisticsError::ZeroVariance`] when the
/// design explains the response wholly; [`StatisticsError::VarianceRatioUnbounded`] when only
/// the rows within clusters are explained wholly.
pub fn fit_random_intercept(
    design: &Design,
    cluster: &[usize],
    response: &[f64],
) -> Result<RandomInterceptFit> {
    let partition = check_clustered(design, cluster, response, METHOD)?;
    // The intercept takes the mean up again; without it nearby values keep their digits.
    let spread = Moments::of(response);
    let offset = spread.mean.to_f64();
    let unit = binary_unit(&spread);
    let centred: Vec<f64> = response
        .iter()
        .map(|value| (value - offset) / unit)
        .collect();
    let basis = Orthonormal::of(design, &centred)?;
    let moments = ClusterMoments::of(&basis, &partition);
    moments.check_freedom()?;
    if is_constant(response) || basis.leaves_nothing() {
        return Err(StatisticsError::ZeroVariance {
            sample: "response beyond the design".into(),
            method: METHOD,
        });
    }
    let profile = minimise(&moments)?;
    let freedom = Profile::freedom(&moments);
    let residual_variance = profile.weighted_squares / freedom;
    let constant = freedom * (1.0 + (2.0 * std::f64::consts::PI / freedom).ln() + 2.0 * unit.ln())
        + 2.0 * basis.ln_determinant();
    let coordinates = basis
        .coordinates
        .iter()
        .zip(&profile.shift)
        .map(|(plain, shift)| plain + shift)
        .collect();
    Ok(RandomInterceptFit {
        coordinates,
        offset,
        unit,
        constant_within: design
            .columns()
            .iter()
            .map(|column| partition.is_constant_within(column))
            .collect(),
        rows: design.rows(),
        clusters: partition.count(),
        between_variance: profile.ratio * residual_variance * unit * unit,
        residual_variance: residual_variance * unit * unit,
        intraclass_correlation: profile.ratio / (1.0 + profile.ratio),
        restricted_deviance: constant + profile.deviance(&moments),
        design: design.clone(),
        basis,
        profile,
    })
}

/// A power of two near the standard deviation: powers of the variances stay far from overflow,
/// and dividing by it rounds nothing.
fn binary_unit(moments: &Moments) -> f64 {
    let deviation = moments.variance().sqrt();
    if deviation > 0.0 {
        deviation.log2().round().exp2()
    } else {
        1.0
    }
}

impl RandomInterceptFit {
    /// F test that all coefficients of a term are zero.
    ///
    /// # Errors
    /// [`StatisticsError::UnknownTerm`] and those of [`Self::test_contrasts`].
    pub fn test_term(&self, term: &str) -> Result<TestResult> {
        self.test_contrasts(&self.design.term_contrasts(term)?)
    }

    /// Wald F test that all of several contrasts (rows of L) are zero:
    /// `F = (Lβ)'(L Cov L')⁻¹ Lβ/q` on between–within degrees of freedom (Schluchter and Elashoff
    /// 1990): a coefficient whose column has one value per cluster gets `clusters − number of such
    /// columns`, any other `rows − clusters − number of the others`; several contrasts take the
    /// smallest among their coefficients. Conservative for effects between clusters whatever the
    /// estimated cluster variance.
    ///
    /// # Errors
    /// [`StatisticsError::LengthMismatch`]; [`StatisticsError::NotFinite`];
    /// [`StatisticsError::DependentContrasts`]; [`StatisticsError::NoFreedomLeft`].
    pub fn test_contrasts(&self, contrasts: &[Vec<f64>]) -> Result<TestResult> {
        let axes = in_basis(&self.design, &self.basis, contrasts, self.clusters)?;
        let estimates: Vec<f64> = (0..contrasts.len())
            .map(|column| {
                let axis: Vec<f64> = (0..axes.nrows()).map(|row| axes[(row, column)]).collect();
                self.unit * dot(&axis, &self.coordinates) + contrasts[column][0] * self.offset
            })
            .collect();
        let covariance: Mat<f64> = faer::Scale(self.residual_variance)
            * (axes.transpose() * &self.profile.inverse * &axes);
        if inverse(&covariance).is_none() {
            return Err(StatisticsError::DependentContrasts {
                contrasts: contrasts.len(),
                clusters: self.clusters,
            });
        }
        // Independent t tests along the covariance's own axes.
        let spectrum = Spectrum::of(&covariance);
        let mut sum = 0.0;
        for (column, variance) in spectrum.values.iter().enumerate() {
            let direction: Vec<f64> = (0..contrasts.len())
                .map(|row| spectrum.vectors[(row, column)])
                .collect();
            sum += dot(&direction, &estimates).powi(2) / variance;
        }
        let q = contrasts.len() as f64;
        let df = self.between_within(contrasts)?;
        Ok(TestResult {
            method: "random-intercept F test",
            statistic_name: "F",
            statistic: sum / q,
            degrees_of_freedom: vec![q, df],
            p: f_upper(sum / q, q, df),
        })
    }

    /// Smallest between–within degrees of freedom among the coefficients the contrasts use, unless
    /// no test can be built on them.
    fn between_within(&self, contrasts: &[Vec<f64>]) -> Result<f64> {
        let between = self
            .constant_within
            .iter()
            .filter(|constant| **constant)
            .count();
        let within = self.constant_within.len() - between;
        let used = |column: usize| contrasts.iter().any(|row| row[column] != 0.0);
        let freedom = |constant: bool| {
            if constant {
                self.clusters as f64 - between as f64
            } else {
                self.rows as f64 - self.clusters as f64 - within as f64
            }
        };
        let least = self
            .constant_within
            .iter()
            .enumerate()
            .filter(|(column, _)| used(*column))
            .map(|(_, constant)| freedom(*constant))
            .fold(f64::INFINITY, f64::min);
        if least >= LEAST_FREEDOM {
            return Ok(least);
        }
        Err(StatisticsError::NoFreedomLeft {
            what: "denominator degrees of freedom",
            rows: self.rows,
            clusters: self.clusters,
            columns: self.constant_within.len(),
        })
    }
}
