use faer::Mat;

use super::cluster_moments::ClusterMoments;
use super::likelihood::{Profile, multiply, within_squares};
use crate::clustered::orthonormal::dot;

/// How the variance components' uncertainty enters the variance of a contrast.
///
/// Satterthwaite: `ν = 2 v²/(g' A g)` with `v = c'Cc` the contrast's variance, g its gradient
/// with respect to the variance components, and A the inverse of the observed information of
/// the restricted likelihood (Fai and Cornelius 1996; as in SAS `MIXED` and R `lmerTest`).
pub(super) struct Satterthwaite {
    /// Covariance of the coefficients in the basis, p × p.
    covariance: Mat<f64>,
    /// `Q'Σ⁻¹ V_i Σ⁻¹Q` for the residual and, off the boundary, the cluster variance.
    slopes: Vec<Mat<f64>>,
    /// Covariance of the variance components.
    components: [[f64; 2]; 2],
}

impl Satterthwaite {
    pub fn of(moments: &ClusterMoments, profile: &Profile, residual_variance: f64) -> Self {
        let s = residual_variance;
        let covariance = faer::Scale(s) * &profile.inverse;
        // Eigenvalue of Σ on a cluster's mean.
        let lambda = |size: f64| s * (1.0 + profile.ratio * size);
        let residual = moments.weighted(s.powi(-2), |n| n / lambda(n).powi(2));
        if profile.ratio == 0.0 {
            // On the boundary the cluster variance is a constant: least squares, n − p.
            let variance = 2.0 * s * s / Profile::freedom(moments);
            let components = [[variance, 0.0], [0.0, 0.0]];
            return Self {
                covariance,
                slopes: vec![residual],
                components,
            };
        }
        let cluster = moments.weighted(0.0, |n| (n / lambda(n)).powi(2));
        let slopes = vec![residual, cluster];
        let components = component_covariance(moments, profile, s, &covariance, &slopes);
        Self {
            covariance,
            slopes,
            components,
        }
    }

    /// Degrees of freedom of one contrast in the basis.
    pub fn freedom(&self, contrast: &[f64]) -> f64 {
        let spread = multiply(&self.covariance, contrast);
        let variance = dot(contrast, &spread);
        let gradient: Vec<f64> = self
            .slopes
            .iter()
            .map(|slope| dot(&spread, &multiply(slope, &spread)))
            .collect();
        let mut uncertainty = 0.0;
        for (i, left) in gradient.iter().enumerate() {
            for (j, right) in gradient.iter().enumerate() {
                uncertainty += left * self.components[i][j] * right;
            }
        }
        2.0 * variance * variance / uncertainty
    }
}

/// Inverse of the observed information `y'P V_i P V_j P y − ½ tr(P V_i P V_j)` of
/// `(σ², σ_b²)`, where `P = Σ⁻¹ − Σ⁻¹Q C Q'Σ⁻¹`, `V_1 = I`, `V_2 = ZZ'`; of the expected
/// information `½ tr(P V_i P V_j)` where tiny data leave the observed one indefinite.
fn component_covariance(
    moments: &ClusterMoments,
    profile: &Profile,
    s: f64,
    covariance: &Mat<f64>,
    slopes: &[Mat<f64>],
) -> [[f64; 2]; 2] {
    let mut observed = [[0.0; 2]; 2];
    let mut expected = [[0.0; 2]; 2];
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let half = 0.5 * projected_trace(moments, profile, s, covariance, slopes, (i, j));
        expected[i][j] = half;
        observed[i][j] = quadratic(moments, profile, s, covariance, (i, j)) - half;
    }
    let [[a, b], [_, d]] = observed;
    if a > 0.0 && a * d > b * b {
        inverse(observed)
    } else {
        inverse(expected)
    }
}

/// `tr(P V_i P V_j)`.
fn projected_trace(
    moments: &ClusterMoments,
    profile: &Profile,
    s: f64,
    covariance: &Mat<f64>,
    slopes: &[Mat<f64>],
    (i, j): (usize, usize),
) -> f64 {
    let lambda = |size: f64| s * (1.0 + profile.ratio * size);
    // V_2 = ZZ' scales a cluster's mean by n_g and a deviation from it by 0.
    let power = i32::try_from(i + j).expect("i and j are 0 or 1");
    let within = if power == 0 { 1.0 } else { 0.0 };
    let free = moments.rows - moments.sizes.len() as f64;
    let plain: f64 = within * free / (s * s)
        + moments
            .sizes
            .iter()
            .map(|n| n.powi(power) / lambda(*n).powi(2))
            .sum::<f64>();
    let cross = moments.weighted(within / s.powi(3), |n| {
        n.powi(power + 1) / lambda(n).powi(3)
    });
    let projected = covariance * &slopes[i] * covariance * &slopes[j];
    plain - 2.0 * trace_of_product(covariance, &cross)
        + (0..moments.columns).map(|k| projected[(k, k)]).sum::<f64>()
}

/// `(V_i Py)' P (V_j Py)`.
fn quadratic(
    moments: &ClusterMoments,
    profile: &Profile,
    s: f64,
    covariance: &Mat<f64>,
    (i, j): (usize, usize),
) -> f64 {
    let lambda = |size: f64| s * (1.0 + profile.ratio * size);
    // Py: deviations e/σ², means ē/λ. Means of V_i Py, and Q'Σ⁻¹ V_i Py.
    let means = |power: usize| -> Vec<f64> {
        moments
            .sizes
            .iter()
            .zip(&profile.error_means)
            .map(|(n, error)| {
                if power == 0 {
                    error / lambda(*n)
                } else {
                    n * error / lambda(*n)
                }
            })
            .collect()
    };
    let within = |power: usize| if power == 0 { 1.0 } else { 0.0 };
    let bent = multiply(&moments.q_within, &profile.shift);
    let scores = |power: usize| -> Vec<f64> {
        let mut sum: Vec<f64> = moments
            .qr_within
            .iter()
            .zip(&bent)
            .map(|(whole, bent)| within(power) * (whole - bent) / (s * s))
            .collect();
        for ((n, q_mean), mean) in moments.sizes.iter().zip(&moments.q_means).zip(means(power)) {
            sum.iter_mut()
                .zip(q_mean)
                .for_each(|(sum, q)| *sum += n * q * mean / lambda(*n));
        }
        sum
    };
    let direct: f64 = within(i) * within(j) * within_squares(moments, &profile.shift) / s.powi(3)
        + moments
            .sizes
            .iter()
            .zip(means(i).iter().zip(&means(j)))
            .map(|(n, (left, right))| n * left * right / lambda(*n))
            .sum::<f64>();
    direct - dot(&scores(i), &multiply(covariance, &scores(j)))
}

/// `tr(AB)` of symmetric matrices.
fn trace_of_product(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    (0..a.ncols())
        .map(|c| (0..a.nrows()).map(|r| a[(r, c)] * b[(r, c)]).sum::<f64>())
        .sum()
}

/// Inverse of a symmetric 2 × 2 matrix.
fn inverse([[a, b], [_, d]]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let determinant = a * d - b * b;
    [
        [d / determinant, -b / determinant],
        [-b / determinant, a / determinant],
    ]
}

/// Denominator degrees of freedom of an F test from those of its independent t tests:
/// `2E/(E − q)`, `E = Σ ν/(ν − 2)` (Fai and Cornelius 1996).
pub(super) fn combined(freedoms: &[f64]) -> f64 {
    const ALIKE: f64 = 1e-8;
    let q = freedoms.len() as f64;
    let least = freedoms.iter().copied().fold(f64::INFINITY, f64::min);
    let most = freedoms.iter().copied().fold(0.0, f64::max);
    if most - least <= ALIKE * most {
        return freedoms.iter().sum::<f64>() / q;
    }
    if least <= 2.0 {
        return 2.0;
    }
    let expectation: f64 = freedoms.iter().map(|nu| nu / (nu - 2.0)).sum();
    2.0 * expectation / (expectation - q)
}
