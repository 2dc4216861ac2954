//! How far what a model leaves is from noise.

/// Correlation of neighbouring samples, in any of the recordings \[–\]: 0 of white noise, near 1 of a motion; 0 where nothing is.
pub(crate) fn correlation(recordings: &[Vec<f64>]) -> f64 {
    let (mut products, mut squares) = (0.0, 0.0);
    for one in recordings {
        products += one.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>();
        squares += one.iter().map(|r| r * r).sum::<f64>();
    }
    let correlation = products / squares;
    if correlation.is_finite() {
        correlation
    } else {
        0.0
    }
}
