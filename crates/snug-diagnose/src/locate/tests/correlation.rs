//! Correlations of residuals of which it is known how they go with themselves and with the torque.

use super::{INTERVAL_S, ONSET, campaign, locate, seen, torque_nm};
use snug_campaign::ResidualCorrelation;

fn correlation(seed: u64, misfit: impl Fn(u32, f64) -> f64) -> ResidualCorrelation {
    let made = campaign(12, seed, misfit);
    let location = locate(&seen(&made), 1);
    location.correlation.expect("there are residuals")
}

/// Of all correlations of many campaigns one in twenty is outside the band. Within one, those with the torque go together, since the torque
/// is smooth.
#[test]
fn white_noise_stays_within_its_band() {
    let (mut outside, mut all) = (0, 0);
    for seed in 0..40 {
        let found = correlation(seed, |_, _| 0.0);
        let values = found.own.iter().chain(&found.with_torque);
        all += values.clone().count();
        outside += values
            .filter(|value| value.abs() > found.half_width)
            .count();
        assert!((found.half_width - 1.96 / (12.0_f64 * 3000.0).sqrt()).abs() < 1e-4);
        assert!((found.lag_s[0] - INTERVAL_S).abs() < 1e-12);
    }
    let share = f64::from(outside as u32) / f64::from(all as u32);
    assert!((0.025..0.085).contains(&share), "{share}");
}

/// What follows the torque after 20 ms, in proportion: the correlation is largest there, near 1, and of the other sign where the
/// residual is.
#[test]
fn a_late_answer_to_the_torque_shows_when_it_comes() {
    for sign in [1.0, -1.0] {
        let found = correlation(3, |number, t| {
            let torque = torque_nm(20.0 + 5.0 * f64::from(number % 4));
            let index = ((t - 0.02) / INTERVAL_S).round() + ONSET as f64;
            let torque = torque.get(index.max(0.0) as usize).copied();
            sign * torque.unwrap_or(0.0)
        });
        let largest = (0..found.with_torque.len())
            .max_by(|a, b| {
                let of = |at: &usize| sign * found.with_torque[*at];
                of(a).total_cmp(&of(b))
            })
            .expect("there are lags");
        assert!(
            (found.torque_lag_s[largest] - 0.02).abs() < 2e-3,
            "{}",
            found.torque_lag_s[largest]
        );
        assert!(sign * found.with_torque[largest] > 0.9);
        assert!(found.own[0] > 0.9, "a motion goes with itself");
    }
}
