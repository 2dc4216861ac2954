//! What is asked of regression coefficients: that linear combinations of them vanish.

use faer::Mat;

use super::Design;
use super::orthonormal::Orthonormal;
use super::spectrum::Spectrum;
use crate::sample::{check_finite, check_lengths};
use crate::{Result, StatisticsError};

/// Approximate degrees of freedom below this mean that the data hold no test of the contrast.
pub(super) const LEAST_FREEDOM: f64 = 0.1;
/// Smallest eigenvalue of the contrasts' correlation below which one follows from the others \[–\]. Chosen.
const SINGULAR: f64 = 1e-10;

/// Contrasts in the orthonormal basis, as columns (coefficients × contrasts).
///
/// # Errors
/// [`StatisticsError::LengthMismatch`], [`StatisticsError::NotFinite`], and
/// [`StatisticsError::DependentContrasts`] when there is none or one is zero.
pub(super) fn in_basis(
    design: &Design,
    basis: &Orthonormal,
    contrasts: &[Vec<f64>],
    clusters: usize,
) -> Result<Mat<f64>> {
    let coefficients = design.names().len();
    let zero = contrasts
        .iter()
        .any(|row| row.iter().all(|weight| *weight == 0.0));
    if contrasts.is_empty() || zero {
        return Err(StatisticsError::DependentContrasts {
            contrasts: contrasts.len(),
            clusters,
        });
    }
    let mut columns = Vec::with_capacity(contrasts.len());
    for row in contrasts {
        check_lengths(("coefficients", coefficients), ("contrast", row.len()))?;
        check_finite("contrast", row)?;
        columns.push(basis.contrast(row));
    }
    Ok(Mat::from_fn(
        coefficients,
        contrasts.len(),
        |row, column| columns[column][row],
    ))
}

/// Inverse of a covariance of contrasts, factored so that the contrasts' units do not matter;
/// `None` when it is singular.
pub(super) fn inverse(covariance: &Mat<f64>) -> Option<Mat<f64>> {
    let size = covariance.nrows();
    let scales: Vec<f64> = (0..size)
        .map(|index| covariance[(index, index)].sqrt())
        .collect();
    if !scales.iter().all(|scale| *scale > 0.0) {
        return None;
    }
    let correlation = Mat::from_fn(size, size, |row, column| {
        covariance[(row, column)] / scales[row] / scales[column]
    });
    let spectrum = Spectrum::of(&correlation);
    let inverse = spectrum.map(f64::recip);
    (spectrum.values[0] >= SINGULAR).then(|| {
        Mat::from_fn(size, size, |row, column| {
            inverse[(row, column)] / scales[row] / scales[column]
        })
    })
}
