//! How well a simulation agrees with a measurement.

use crate::residual::whitening::Whitening;
use snug_campaign::NoiseFloor;

/// Normalised root-mean-square fit \[%\]: 100 (1 − ‖y − ŷ‖ / ‖y − ȳ‖); 100 is perfect, 0 no better than the mean.
///
/// `None` when the measurement does not vary.
pub fn fit_percent(measured: &[f64], simulated: &[f64]) -> Option<f64> {
    let mean = measured.iter().sum::<f64>() / measured.len() as f64;
    let spread: f64 = measured.iter().map(|y| (y - mean).powi(2)).sum();
    let misfit: f64 = squares(measured, simulated).sum();
    (spread > 0.0).then(|| 100.0 * (1.0 - (misfit / spread).sqrt()))
}

/// 100 (1 − mean|y − ŷ| / mean|y|) \[%\], the accuracy of Molitor's program; `None` when the measurement is zero.
pub fn accuracy_percent(measured: &[f64], simulated: &[f64]) -> Option<f64> {
    let size: f64 = measured.iter().map(|y| y.abs()).sum();
    let error: f64 = measured
        .iter()
        .zip(simulated)
        .map(|(y, s)| (y - s).abs())
        .sum();
    (size > 0.0).then(|| 100.0 * (1.0 - error / size))
}

/// Root mean square of measured − simulated, in the signals' unit.
pub fn rms_residual(measured: &[f64], simulated: &[f64]) -> f64 {
    (squares(measured, simulated).sum::<f64>() / measured.len() as f64).sqrt()
}

/// Root mean square of the whitened residual over the noise: 1 = nothing left but noise.
///
/// `None` when the noise has no positive innovation or the signals are shorter than its order.
pub fn error_over_noise(measured: &[f64], simulated: &[f64], noise: &NoiseFloor) -> Option<f64> {
    let whitening = Whitening::new(noise)?;
    let count = measured.len().checked_sub(whitening.order())?;
    let residual: Vec<f64> = measured.iter().zip(simulated).map(|(y, s)| y - s).collect();
    let mut white = vec![0.0; count];
    whitening.apply(&residual, &mut white);
    (count > 0).then(|| (white.iter().map(|w| w * w).sum::<f64>() / count as f64).sqrt())
}

fn squares<'a>(measured: &'a [f64], simulated: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    measured.iter().zip(simulated).map(|(y, s)| (y - s).powi(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn perfect_and_constant_guesses_give_the_ends_of_the_scale() {
        let measured = [1.0, 2.0, 3.0, 6.0];
        assert_eq!(fit_percent(&measured, &measured), Some(100.0));
        assert_eq!(fit_percent(&measured, &[3.0; 4]), Some(0.0));
        assert_eq!(fit_percent(&[2.0; 4], &[1.0; 4]), None);
        assert_eq!(accuracy_percent(&measured, &[0.0; 4]), Some(0.0));
        assert_eq!(rms_residual(&measured, &[1.0, 2.0, 3.0, 4.0]), 1.0);
    }
}
