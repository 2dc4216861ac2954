//! The restricted likelihood of a random intercept, with its derivative, over the ratio of variances.

use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, Side};

use super::cluster_moments::ClusterMoments;
use crate::clustered::orthonormal::dot;
use crate::root::bracketed_root;
use crate::{Result, StatisticsError};

/// Largest `θ · rows of the largest cluster` searched; the matrices stay invertible below it.
const LARGEST_RATIO: f64 = 1e10;
/// Search points per decade of θ.
const POINTS_PER_DECADE: i32 = 4;
/// Decades of θ searched below the largest.
const DECADES: i32 = 19;

/// The generalised least-squares solution at one variance ratio θ.
pub(super) struct Profile {
    /// Variance ratio θ.
    pub ratio: f64,
    /// Coefficients in the basis, relative to the least-squares ones.
    pub shift: Vec<f64>,
    /// `(Q'V⁻¹Q)⁻¹` with `V = I + θ ZZ'`, p × p.
    pub inverse: Mat<f64>,
    /// Residual means per cluster.
    pub error_means: Vec<f64>,
    /// `(y − Xβ)'V⁻¹(y − Xβ)`.
    pub weighted_squares: f64,
    /// `ln |V| + ln |Q'V⁻¹Q|`.
    pub ln_determinants: f64,
}

impl Profile {
    pub fn at(moments: &ClusterMoments, ratio: f64) -> Self {
        let weight = |size: f64| size / (1.0 + ratio * size);
        let precision = moments.weighted(1.0, weight);
        let factor = precision
            .llt(Side::Lower)
            .expect("LARGEST_RATIO keeps the precision above 1e-10");
        let inverse = factor.inverse();
        let lower = factor.L();
        let ln_precision: f64 = (0..moments.columns).map(|i| 2.0 * lower[(i, i)].ln()).sum();
        let mut right = moments.qr_within.clone();
        for ((size, mean), r_mean) in moments
            .sizes
            .iter()
            .zip(&moments.q_means)
            .zip(&moments.r_means)
        {
            let scale = weight(*size) * r_mean;
            right
                .iter_mut()
                .zip(mean)
                .for_each(|(sum, value)| *sum += scale * value);
        }
        let shift = multiply(&inverse, &right);
        let error_means: Vec<f64> = moments
            .q_means
            .iter()
            .zip(&moments.r_means)
            .map(|(mean, r_mean)| r_mean - dot(mean, &shift))
            .collect();
        let between: f64 = moments
            .sizes
            .iter()
            .zip(&error_means)
            .map(|(size, mean)| weight(*size) * mean * mean)
            .sum();
        let ln_v: f64 = moments
            .sizes
            .iter()
            .map(|size| (ratio * size).ln_1p())
            .sum();
        Self {
            ratio,
            weighted_squares: within_squares(moments, &shift) + between,
            shift,
            inverse,
            error_means,
            ln_determinants: ln_v + ln_precision,
        }
    }

    /// Residual degrees of freedom `n − p`.
    pub fn freedom(moments: &ClusterMoments) -> f64 {
        moments.rows - moments.columns as f64
    }

    /// −2 ln restricted likelihood, up to a constant.
    pub fn deviance(&self, moments: &ClusterMoments) -> f64 {
        Self::freedom(moments) * self.weighted_squares.ln() + self.ln_determinants
    }

    /// Derivative of [`Self::deviance`] with respect to θ.
    fn slope(&self, moments: &ClusterMoments) -> f64 {
        let (mut squares, mut determinants) = (0.0, 0.0);
        for ((size, mean), error) in moments
            .sizes
            .iter()
            .zip(&moments.q_means)
            .zip(&self.error_means)
        {
            let weight = size / (1.0 + self.ratio * size);
            squares -= (weight * error).powi(2);
            let leverage = dot(mean, &multiply(&self.inverse, mean));
            determinants += weight - weight * weight * leverage;
        }
        Self::freedom(moments) * squares / self.weighted_squares + determinants
    }
}

/// Squares of the residuals' deviations from their cluster means.
fn within_squares(moments: &ClusterMoments, shift: &[f64]) -> f64 {
    let bent = dot(shift, &multiply(&moments.q_within, shift));
    moments.r_within - 2.0 * dot(shift, &moments.qr_within) + bent
}

/// Matrix times vector.
fn multiply(matrix: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    (0..matrix.nrows())
        .map(|row| {
            vector
                .iter()
                .enumerate()
                .map(|(column, v)| matrix[(row, column)] * v)
                .sum()
        })
        .collect()
}

/// The profile of least deviance over `θ ≥ 0`.
///
/// A scan over all magnitudes of θ brackets every local minimum; each is refined as a root of
/// the analytic slope, and the lowest wins.
///
/// # Errors
/// [`StatisticsError::VarianceRatioUnbounded`] when the deviance falls to the end of the scan.
pub(super) fn minimise(moments: &ClusterMoments) -> Result<Profile> {
    let largest_size = moments.sizes.iter().copied().fold(0.0, f64::max);
    let limit = LARGEST_RATIO / largest_size;
    let slope = |ratio: f64| Profile::at(moments, ratio).slope(moments);
    let mut candidates = Vec::new();
    let (mut below, mut slope_below) = (0.0, slope(0.0));
    if slope_below >= 0.0 {
        candidates.push(0.0);
    }
    for step in (0..=DECADES * POINTS_PER_DECADE).rev() {
        let above = limit * 10.0_f64.powf(-f64::from(step) / f64::from(POINTS_PER_DECADE));
        let slope_above = slope(above);
        if slope_below < 0.0 && slope_above >= 0.0 {
            candidates.extend(bracketed_root(slope, below, above));
        }
        (below, slope_below) = (above, slope_above);
    }
    let falling = slope_below < 0.0;
    candidates
        .into_iter()
        .map(|ratio| Profile::at(moments, ratio))
        .filter(|found| {
            !falling || found.deviance(moments) <= Profile::at(moments, limit).deviance(moments)
        })
        .min_by(|a, b| a.deviance(moments).total_cmp(&b.deviance(moments)))
        .ok_or(StatisticsError::VarianceRatioUnbounded { limit })
}
