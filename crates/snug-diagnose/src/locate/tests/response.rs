//! Responses over frequency of hands whose equation is known.

use super::{HAND, INTERVAL_S, RIG, campaign, locate, seen};
use snug_campaign::{FrequencyResponse, Quantity};
use std::f64::consts::TAU;

fn response(misfit: impl Fn(u32, f64) -> f64) -> FrequencyResponse {
    let made = campaign(12, 5, misfit);
    let location = locate(&seen(&made), 1);
    location.response.expect("the torque moves the hand")
}

/// |α / T| = ω² / |k l² − (I_n + m l²) ω² + i c l² ω| \[rad/s² per Nm\].
fn truth(frequency_hz: f64) -> f64 {
    let ([m, c, k], w) = (HAND, TAU * frequency_hz);
    let square = RIG.lever_arm_m.powi(2);
    let real = k * square - (RIG.known_inertia_kg_m2 + m * square) * w * w;
    w * w / real.hypot(c * square * w)
}

/// From twice the windows' resolution on, where they tell frequencies apart: within a tenth, and measured and simulated alike.
#[test]
fn a_hands_response_is_that_of_its_equation() {
    let found = response(|_, _| 0.0);
    assert_eq!(found.quantity, Quantity::Acceleration);
    assert!((found.resolution_hz - 1.0 / (3000.0 * INTERVAL_S)).abs() < 1e-9);
    let mut inside = 0;
    for (at, &frequency_hz) in found.frequency_hz.iter().enumerate() {
        let [measured, simulated] = [found.measured[at], found.simulated[at]];
        if frequency_hz < 2.0 * found.resolution_hz {
            continue;
        }
        let off = simulated.gain / truth(frequency_hz);
        assert!((off - 1.0).abs() < 0.1, "{frequency_hz} Hz: {off}");
        let interval = found.gain_interval[at].expect("twelve were averaged");
        inside += usize::from((interval.low..=interval.high).contains(&simulated.gain));
        if frequency_hz < 30.0 {
            assert!((measured.gain / simulated.gain - 1.0).abs() < 0.03);
            assert!(found.coherence[at] > Some(0.99), "{frequency_hz} Hz");
        }
    }
    let share = inside as f64 / found.frequency_hz.len() as f64;
    assert!(share > 0.8, "{share}");
}

/// What the model lacks at one frequency shows there: a ringing at 60 Hz of one sign with the torque.
#[test]
fn what_is_missing_stands_at_its_frequency() {
    let found = response(|number, t| {
        let target_nm = 20.0 + 5.0 * f64::from(number % 4);
        match t > 0.0 {
            true => 0.5 * target_nm * (-t / 0.05).exp() * (TAU * 60.0 * t).sin(),
            false => 0.0,
        }
    });
    let ratio = |at: usize| found.measured[at].gain / found.simulated[at].gain;
    let worst = (0..found.frequency_hz.len())
        .max_by(|&a, &b| ratio(a).ln().abs().total_cmp(&ratio(b).ln().abs()))
        .expect("there are frequencies");
    let frequency_hz = found.frequency_hz[worst];
    assert!((frequency_hz / 60.0 - 1.0).abs() < 0.25, "{frequency_hz}");
}
