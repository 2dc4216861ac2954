//! Signals with known properties for the tests.

use crate::prepared::Preprocessed;
use crate::preprocess::preprocess;
use crate::settings::{PreprocessSettings, Preset};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use snug_campaign::{Conditions, Motion, Quantity, Recording, Segment, TimeBase};

pub(crate) fn white_noise(count: usize, standard_deviation: f64, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| {
            let value: f64 = StandardNormal.sample(&mut random);
            standard_deviation * value
        })
        .collect()
}

/// Autoregressive noise with coefficients a_1 … a_p and innovations of standard deviation `innovation_sd`.
pub(crate) fn autoregressive_noise(
    count: usize,
    coefficients: &[f64],
    innovation_sd: f64,
    seed: u64,
) -> Vec<f64> {
    const SETTLING: usize = 2000;
    let mut noise = white_noise(count + SETTLING, innovation_sd, seed);
    for index in 0..noise.len() {
        for (lag, coefficient) in coefficients.iter().enumerate() {
            if index > lag {
                noise[index] -= coefficient * noise[index - 1 - lag];
            }
        }
    }
    noise.split_off(SETTLING)
}

/// White plus first-order noise (pole 0.9, 36.5 % of the variance): an accelerometer's, no finite autoregression.
pub(crate) fn coloured_noise(count: usize, standard_deviation: f64, seed: u64) -> Vec<f64> {
    let slow_sd = standard_deviation * 0.365_f64.sqrt() * (1.0 - 0.81_f64).sqrt();
    let slow = autoregressive_noise(count, &[-0.9], slow_sd, seed);
    let white = white_noise(
        count,
        standard_deviation * 0.635_f64.sqrt(),
        seed ^ 0x5555_0000,
    );
    slow.iter().zip(white).map(|(a, b)| a + b).collect()
}

/// Samples of one made-up segment.
pub(crate) const SEGMENT: usize = 20_000;
/// Where the pulse of a made-up segment begins.
pub(crate) const ONSET: usize = 14_850;
/// Where its torque peaks.
pub(crate) const PEAK: usize = 15_650;

/// Torque ramping to `peak_nm` within 80 ms and gone 12 ms later.
pub(crate) fn pulse(peak_nm: f64) -> Vec<f64> {
    (0..SEGMENT)
        .map(|index| {
            let rise = (index as f64 - ONSET as f64) / (PEAK - ONSET) as f64;
            if index < PEAK {
                peak_nm * rise.max(0.0)
            } else {
                peak_nm * (1.0 - (index - PEAK) as f64 / 120.0).max(0.0)
            }
        })
        .collect()
}

/// Acceleration of a damped oscillator pushed by `torque_nm`, by semi-implicit Euler: good enough to look right.
pub(crate) fn acceleration(torque_nm: &[f64]) -> Vec<f64> {
    let (inertia, damping, stiffness, step) = (0.53, 11.0, 250.0, 1e-4);
    let (mut angle, mut velocity) = (0.0, 0.0);
    torque_nm
        .iter()
        .map(|torque| {
            let acceleration = (torque - damping * velocity - stiffness * angle) / inertia;
            velocity += step * acceleration;
            angle += step * velocity;
            acceleration
        })
        .collect()
}

/// What `preset` makes of a recording, its acceleration to be fitted.
pub(crate) fn prepared(recording: &Recording, preset: Preset) -> Preprocessed {
    let settings = PreprocessSettings {
        preset,
        ..PreprocessSettings::default()
    };
    preprocess(recording, &settings, Quantity::Acceleration).expect("the settings are the defaults")
}

/// A recording of as many tightenings as `seeds`, 30 Nm, with noise like a real rig's and the given acceleration bias.
pub(crate) fn recording(seeds: &[u64], bias_rad_per_s2: f64) -> Recording {
    let clean_torque = pulse(30.0);
    let clean_acceleration = acceleration(&clean_torque);
    let (mut torque_nm, mut measured, mut force) = (Vec::new(), Vec::new(), Vec::new());
    for &seed in seeds {
        let torque_noise = white_noise(SEGMENT, 0.02, seed.wrapping_mul(31) + 7);
        let noise = coloured_noise(SEGMENT, 0.5, seed);
        torque_nm.extend(clean_torque.iter().zip(torque_noise).map(|(t, n)| t + n));
        measured.extend(
            clean_acceleration
                .iter()
                .zip(noise)
                .map(|(a, n)| a + n + bias_rad_per_s2),
        );
        force.extend(white_noise(SEGMENT, 0.5, seed.wrapping_mul(17) + 3));
    }
    Recording {
        file: "TP1_QS_Soft_5.mat".into(),
        label: "TP1_QS_Soft_5".into(),
        conditions: Conditions::default(),
        time_base: TimeBase {
            start_s: 0.0,
            interval_s: 1e-4,
        },
        torque_nm,
        motion: Motion {
            acceleration_rad_per_s2: Some(measured),
            ..Motion::default()
        },
        grip_force_n: Some(force),
        has_force_channel: true,
        grip_force_channel: Some("F_op_J".into()),
        segments: (0..seeds.len())
            .map(|index| Segment {
                number: index as u32 + 1,
                start: index * SEGMENT,
                end: (index + 1) * SEGMENT,
                event_times_s: None,
            })
            .collect(),
    }
}
