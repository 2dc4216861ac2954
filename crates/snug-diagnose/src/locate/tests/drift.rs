//! Drifts of fitted parameters that were planted, and that were not.

use super::{HAND, Made, made, normal, seen};
use crate::locate::drift::{number_range, per_tightening};
use crate::locate::drifts;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use snug_campaign::{Drift, FitStatus};

/// Fitted parameters that scatter by 5 % around each person's own level, stiffness growing with the target by `growth`.
fn fitted(seed: u64, growth: f64) -> Vec<Made> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    (0..32)
        .map(|number| {
            let target_nm = 15.0 + 5.0 * f64::from((number / 4) % 6);
            let person = 1.0 + 0.3 * f64::from(number % 4);
            let scatter: [f64; 3] = std::array::from_fn(|_| (0.05 * normal(&mut generator)).exp());
            let values = [
                HAND[0] * person * scatter[0],
                HAND[1] * scatter[1],
                HAND[2] / person * scatter[2] * (growth * (target_nm - 15.0) / 25.0).exp(),
            ];
            made(number + 1, values, target_nm)
        })
        .collect()
}

#[test]
fn a_planted_drift_is_found_with_its_size() {
    let made = fitted(10, 1.2_f64.ln());
    let drifts = drifts(&seen(&made));
    let of = |parameter: &str, against: &str| {
        let mut drifts = drifts.iter();
        drifts
            .find(|drift| drift.parameter == parameter && drift.against == against)
            .unwrap()
    };
    let planted = of("stiffness_n_per_m", "target_torque_nm");
    let interval = planted.interval_percent.unwrap();
    assert!(interval.low < 20.0 && 20.0 < interval.high, "{planted:?}");
    assert!((planted.change_percent - 20.0).abs() < 8.0, "{planted:?}");
    assert!(planted.p_adjusted.unwrap() < 0.01);
    assert!(of("mass_kg", "target_torque_nm").p_adjusted.unwrap() > 0.05);
    // The torque's shape is the same at every target.
    let length = drifts
        .iter()
        .find(|drift| drift.against == "pulse_length_s");
    assert!(length.is_none(), "{length:?}");
}

/// Four files, numbered on, so that a file's numbers are 28 apart and all are 31; the last of each did not converge.
#[test]
fn a_growth_per_tightening_is_found_again_whatever_the_numbers_are() {
    let mut generator = ChaCha8Rng::seed_from_u64(3);
    let mut made: Vec<Made> = (1..=32)
        .map(|number| {
            let scatter = (1e-4 * normal(&mut generator)).exp();
            let [m, c, k] = HAND;
            made(
                number,
                [m, c, k * 1.03_f64.powf(f64::from(number)) * scatter],
                30.0,
            )
        })
        .collect();
    for one in &mut made[28..] {
        one.estimate.status = FitStatus::IterationLimit;
    }
    let drifts = drifts(&seen(&made));
    let of_number = |d: &&Drift| d.against == "trial_number" && d.parameter == "stiffness_n_per_m";
    let change_percent = drifts.iter().find(of_number).unwrap().change_percent;
    assert!((change_percent / 100.0 - (1.03_f64.powi(28) - 1.0)).abs() < 1e-3);
    let range = number_range(made.iter().map(|one| &one.tightening));
    assert!((per_tightening(change_percent, range) - 0.03).abs() < 1e-4);
}

/// Scatter in k alone, which moves the measured peaks with it, is no drift: p is uniform.
#[test]
fn no_drift_gives_uniform_p() {
    let mut p: Vec<f64> = (0..40)
        .flat_map(|seed| {
            let made = fitted(100 + seed, 0.0);
            let drifts = drifts(&seen(&made));
            let own = |name: &str| {
                let mut all = drifts.iter();
                all.find(|d| d.against == name && d.parameter == "stiffness_n_per_m")
                    .and_then(|drift| drift.p)
                    .unwrap()
            };
            // Peak angle and target go together here, so one of them stands for both.
            [own("peak_angle_rad"), own("trial_number")]
        })
        .collect();
    p.sort_by(f64::total_cmp);
    let n = p.len() as f64;
    let distance = p
        .iter()
        .enumerate()
        .map(|(index, p)| ((index as f64 + 0.5) / n - p).abs())
        .fold(0.0, f64::max);
    // Kolmogorov's 99.9 % point is 1.95/√n.
    assert!(distance < 1.95 / n.sqrt(), "{distance}");
}
