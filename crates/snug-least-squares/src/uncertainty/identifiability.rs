//! Rank, condition and correlations of what a residual tells about its parameters.

use crate::matrix::{dot, norm};
use crate::uncertainty::thresholds::{BLOCKED, UNDETERMINED};
use faer::{Mat, MatRef};

/// How well the residual determines the parameters together.
///
/// All figures are of J with its columns scaled to unit length, restricted to directions that no active constraint
/// blocks, so units do not matter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Identifiability {
    /// Numerical rank.
    pub rank: usize,
    /// Number of directions that could be determined: n minus the active constraints.
    pub free: usize,
    /// Largest over smallest singular value; infinite where a direction is not determined at all.
    pub condition: f64,
    /// Correlation matrix of the estimates, n × n row-major; 0 where a parameter is blocked. With a deficient rank it
    /// is that of the undetermined directions alone.
    pub correlation: Vec<f64>,
    /// The most correlated pair (first < second) and its correlation; `None` with fewer than two free parameters.
    pub strongest: Option<(usize, usize, f64)>,
}

/// What the analysis of R gives besides [`Identifiability`].
pub struct Analysis {
    pub identifiability: Identifiability,
    pub covariance_root: Vec<f64>,
    pub determined: Vec<bool>,
}

/// Analyses R (n × n, column-major, upper) on the tangent space of constraints with the given `normals` (∇g, n each).
pub fn analyse(factor: &[f64], normals: &[Vec<f64>], rank_tolerance: f64) -> Analysis {
    let n = (factor.len() as f64).sqrt() as usize;
    let lengths: Vec<f64> = (0..n)
        .map(|column| match norm(&factor[column * n..(column + 1) * n]) {
            0.0 => 1.0,
            length => length,
        })
        .collect();
    let tangent = tangent_space(normals, &lengths);
    let free = tangent.ncols();
    let scaled = Mat::from_fn(n, n, |row, column| {
        factor[column * n + row] / lengths[column]
    });
    let reduced = scaled * &tangent;
    let decomposition = reduced.thin_svd().ok();
    let singular: Vec<f64> = match &decomposition {
        Some(svd) => svd.S().column_vector().iter().copied().collect(),
        None => Vec::new(),
    };
    let largest = singular.first().copied().unwrap_or(0.0);
    let is_known = |value: f64| value > rank_tolerance * largest;
    let rank = singular.iter().filter(|&&value| is_known(value)).count();
    let directions = match &decomposition {
        Some(svd) => &tangent * svd.V(),
        None => Mat::zeros(n, 0),
    };
    let mut covariance_root = vec![0.0; n * n];
    for column in 0..rank {
        for row in 0..n {
            covariance_root[column * n + row] =
                directions[(row, column)] / (singular[column] * lengths[row]);
        }
    }
    let share = |row: usize, from: usize| -> f64 {
        (from..directions.ncols())
            .map(|column| directions[(row, column)].powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let determined = (0..n)
        .map(|row| share(row, 0) > BLOCKED && share(row, rank) < UNDETERMINED)
        .collect();
    let correlation = correlation(directions.as_ref(), &singular, rank);
    let smallest = singular.last().copied().unwrap_or(0.0);
    Analysis {
        identifiability: Identifiability {
            rank,
            free,
            condition: match free {
                0 => 1.0,
                _ if smallest > 0.0 => largest / smallest,
                _ => f64::INFINITY,
            },
            strongest: strongest(&correlation, n),
            correlation,
        },
        covariance_root,
        determined,
    }
}

/// Orthonormal basis (n × free) of the directions along the constraints, in column-scaled coordinates.
fn tangent_space(normals: &[Vec<f64>], lengths: &[f64]) -> Mat<f64> {
    let n = lengths.len();
    if normals.is_empty() {
        return Mat::identity(n, n);
    }
    let rows = Mat::from_fn(normals.len(), n, |row, column| {
        let size: Vec<f64> = (normals[row].iter().zip(lengths))
            .map(|(a, l)| a / l)
            .collect();
        size[column] / norm(&size).max(f64::MIN_POSITIVE)
    });
    let Ok(svd) = rows.svd() else {
        return Mat::identity(n, n);
    };
    let singular = svd.S().column_vector();
    let blocked = singular.iter().filter(|&&value| value > BLOCKED).count();
    let basis = svd.V();
    Mat::from_fn(n, n - blocked, |row, column| basis[(row, blocked + column)])
}

fn correlation(directions: MatRef<'_, f64>, singular: &[f64], rank: usize) -> Vec<f64> {
    let n = directions.nrows();
    let undetermined = rank < directions.ncols();
    let columns = if undetermined {
        rank..directions.ncols()
    } else {
        0..rank
    };
    let rows: Vec<Vec<f64>> = (0..n)
        .map(|row| {
            let weight = |column: usize| {
                if undetermined {
                    1.0
                } else {
                    1.0 / singular[column]
                }
            };
            let entries = columns.clone();
            entries
                .map(|column| weight(column) * directions[(row, column)])
                .collect()
        })
        .collect();
    let sizes: Vec<f64> = rows.iter().map(|row| norm(row)).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let mut matrix = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..n {
            if sizes[i].min(sizes[j]) > UNDETERMINED * largest {
                matrix[i * n + j] =
                    (dot(&rows[i], &rows[j]) / (sizes[i] * sizes[j])).clamp(-1.0, 1.0);
            }
        }
    }
    matrix
}

fn strongest(correlation: &[f64], n: usize) -> Option<(usize, usize, f64)> {
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j, correlation[i * n + j])));
    pairs
        .filter(|pair| pair.2 != 0.0)
        .fold(None, |best: Option<(usize, usize, f64)>, pair| match best {
            Some(found) if found.2.abs() >= pair.2.abs() => Some(found),
            _ => Some(pair),
        })
}
