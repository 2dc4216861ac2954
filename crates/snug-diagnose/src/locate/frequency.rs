//! The misfit over frequency.
//!
//! The whitened residual's periodogram (see [`Spectra`]), whose expectation is 1 at every frequency where nothing but noise is left, summed
//! over bands.

use super::aspect::{Part, Sum, View};
use super::grid::round_up;
use super::spectra::Spectra;
use crate::locate::thresholds::NARROWEST;
use rayon::prelude::*;
use snug_campaign::words::number::without_last_digits;

/// Bands that end at 1, 2, 5 times powers of ten, from the longest tightening's resolution to half the sampling rate.
pub fn view(spectra: &Spectra<'_, '_>) -> Option<View> {
    let all = &spectra.of_misfits;
    let longest_s = all.iter().map(|one| one.length_s).reduce(f64::max)?;
    let highest_hz = (all.iter())
        .map(|one| 0.5 / one.recording.interval_s())
        .reduce(f64::max)?;
    let edges = edges_hz(NARROWEST / longest_s, highest_hz);
    let sums = all
        .par_iter()
        .map(|one| band_sums(&one.power, 1.0 / one.length_s, &edges))
        .collect();
    let parts = edges
        .windows(2)
        .map(|edge| Part {
            name: format!("{}..{} Hz", edge[0], edge[1]),
            from: Some(edge[0]),
            to: Some(edge[1]),
        })
        .collect();
    Some(View {
        aspect: "frequency_hz",
        parts,
        sums,
    })
}

fn edges_hz(narrowest_hz: f64, highest_hz: f64) -> Vec<f64> {
    let mut edges = vec![0.0];
    let mut next = round_up(narrowest_hz);
    while next < highest_hz * (1.0 - 1e-9) {
        edges.push(without_last_digits(next));
        next = round_up(next * 1.01);
    }
    edges.push(without_last_digits(highest_hz));
    edges
}

/// Frequencies between the ends stand for their negative twin as well.
fn band_sums(power: &[f64], step_hz: f64, edges: &[f64]) -> Vec<Sum> {
    let mut sums = vec![Sum::default(); edges.len() - 1];
    for (index, power) in power.iter().enumerate() {
        let frequency_hz = index as f64 * step_hz;
        let band = edges[1..edges.len() - 1].partition_point(|edge| *edge <= frequency_hz);
        let twice = if index == 0 { 1.0 } else { 2.0 };
        sums[band].square += twice * power;
        sums[band].count += twice;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_signal::Periodogram;
    use std::f64::consts::PI;

    /// A whole number of cycles: its power lies in its band but for what the window's edges spread, n/2 · A² in total.
    #[test]
    fn a_sine_lies_in_its_band() {
        let (n, interval_s) = (3000, 1e-4);
        let values: Vec<f64> = (0..n)
            .map(|t| 3.0 * (2.0 * PI * 70.0 * f64::from(t) * interval_s).sin())
            .collect();
        let power = Periodogram::of_length(values.len()).power(&values);
        let edges = edges_hz(5.0, 5000.0);
        assert_eq!(edges[..4], [0.0, 5.0, 10.0, 20.0]);
        let sums = band_sums(&power, 1.0 / 0.3, &edges);
        let total: f64 = sums.iter().map(|sum| sum.square).sum();
        assert!((total / (4.5 * 3000.0) - 1.0).abs() < 0.01, "{total}");
        let band = edges.iter().position(|edge| *edge == 50.0);
        let here = band.map_or(0.0, |band| sums[band].square);
        assert!(here / total > 0.99, "{here} of {total}");
    }

    /// The end of a ramp is no signal at high frequencies: the next bands fall at 60 dB a decade and more.
    #[test]
    fn a_ramp_leaks_nothing_upwards() {
        let values: Vec<f64> = (0..3000).map(|t| f64::from(t) / 3000.0).collect();
        let power = Periodogram::of_length(values.len()).power(&values);
        let sums = band_sums(&power, 1.0 / 0.3, &edges_hz(5.0, 5000.0));
        let mean = |sum: &Sum| sum.square / sum.count;
        assert!(mean(&sums[0]) / mean(&sums[7]) > 1e7);
    }
}
