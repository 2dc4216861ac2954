//! Known processes back, noise whitened that the fit has not seen, and hum that must stay stable.

use super::*;
use crate::tests::synthetic::{autoregressive_noise, coloured_noise, white_noise};

#[test]
fn recovers_a_known_process_and_its_long_run_variance() {
    // Poles 0.9 e^{±i0.5}: a_1 = −2·0.9·cos 0.5, a_2 = 0.81; large-sample covariance of (a_1, a_2) per sample:
    // 1 − a_2² on the diagonal (Brockwell and Davis, example 8.1.1).
    let truth = [-1.8 * 0.5_f64.cos(), 0.81];
    let count = 50_000;
    let standard_error = ((1.0 - truth[1] * truth[1]) / count as f64).sqrt();
    let long_run = (0.3 / (1.0 + truth[0] + truth[1])).powi(2);
    for seed in 0..5 {
        let signal = autoregressive_noise(count, &truth, 0.3, seed);
        let fitted = Autoregression::fit(&signal, 2).expect("not constant");
        for (estimate, truth) in fitted.coefficients.iter().zip(truth) {
            assert!(
                (estimate - truth).abs() < 5.0 * standard_error,
                "{estimate} for {truth}"
            );
        }
        assert!((fitted.innovation_sd / 0.3 - 1.0).abs() < 5.0 / (2.0 * count as f64).sqrt());
        let free_order = Autoregression::fit(&signal, 30).expect("not constant");
        assert!(free_order.coefficients.len() >= 2);
        for fit in [&fitted, &free_order] {
            assert!((fit.long_run_variance() / long_run - 1.0).abs() < 0.1);
        }
    }
}

#[test]
fn white_noise_stays_nearly_white() {
    for seed in 0..20 {
        let fitted =
            Autoregression::fit(&white_noise(14_800, 0.5, seed), 30).expect("not constant");
        assert!((fitted.innovation_sd - 0.5).abs() < 5.0 * 0.5 / (2.0 * 14_800.0_f64).sqrt());
        assert!(
            fitted
                .coefficients
                .iter()
                .all(|a| a.abs() < 5.0 / 14_800.0_f64.sqrt())
        );
    }
}

#[test]
fn whitens_noise_it_has_not_seen() {
    // The filter 1, a_1 … a_p fitted to one stretch must leave white noise of unit variance in another.
    let fitted = Autoregression::fit(&coloured_noise(14_800, 0.5, 1), 30).expect("not constant");
    let fresh = coloured_noise(200_000, 0.5, 2);
    let order = fitted.coefficients.len();
    let whitened: Vec<f64> = (order..fresh.len())
        .map(|index| {
            let past: f64 = (0..order)
                .map(|lag| fitted.coefficients[lag] * fresh[index - 1 - lag])
                .sum();
            (fresh[index] + past) / fitted.innovation_sd
        })
        .collect();
    let power = dot(&whitened, &whitened) / whitened.len() as f64;
    assert!((power - 1.0).abs() < 0.03, "{power}");
    for lag in [1, 2, 5, 10] {
        let correlation = dot(&whitened[lag..], &whitened[..whitened.len() - lag])
            / (power * whitened.len() as f64);
        assert!(correlation.abs() < 0.03, "lag {lag}: {correlation}");
    }
}

#[test]
fn a_line_spectrum_stays_stable() {
    // 50 Hz hum 20 times the noise, at 10 kHz: all poles inside the unit circle means a decaying impulse response.
    let mut signal = white_noise(14_800, 0.05, 8);
    for (index, value) in signal.iter_mut().enumerate() {
        *value += (2.0 * std::f64::consts::PI * 50.0 * index as f64 * 1e-4).sin();
    }
    for signal in [
        signal.clone(),
        signal.iter().map(|x| (x * 50.0).round() / 50.0).collect(),
    ] {
        let fitted = Autoregression::fit(&signal, 30).expect("not constant");
        assert!(fitted.innovation_sd < 0.2 * fitted.standard_deviation);
        let mut response = vec![1.0];
        for index in 1..20_000 {
            let next: f64 = fitted
                .coefficients
                .iter()
                .enumerate()
                .filter(|(lag, _)| *lag < index)
                .map(|(lag, a)| -a * response[index - 1 - lag])
                .sum();
            response.push(next);
        }
        let late = response[19_000..]
            .iter()
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(late < 0.05, "{late}");
    }
}

#[test]
fn nothing_to_fit_is_none() {
    assert_eq!(Autoregression::fit(&[0.1; 1000], 30), None);
    assert_eq!(Autoregression::fit(&[0.0; 1000], 30), None);
    assert_eq!(Autoregression::fit(&[1.0, 2.0], 30), None);
    assert_eq!(Autoregression::fit(&[f64::NAN; 100], 30), None);
}
