//! A small campaign with every mantissa bit in use, for the tests below.
#![allow(clippy::unwrap_used)]

mod diagnosis;
mod interruption;
mod messages;
mod recovery;
mod round_trip;

use crate::recorder::Recorder;
use crate::settings::RecordSettings;
use snug_campaign::*;

const INTERVAL_S: f64 = 1e-4;

/// Numbers without pattern, from a linear congruential generator: every mantissa bit is in use.
fn noise(seed: u64, length: usize) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    (0..length)
        .map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        })
        .collect()
}

fn traces(seed: u64, length: usize, force: bool) -> Traces {
    let column = |part: u64| noise(seed * 100 + part, length);
    let mut torque_nm = column(0);
    torque_nm[1] = f64::NAN;
    torque_nm[2] = -0.0;
    Traces {
        time_base: TimeBase {
            start_s: 1.48,
            interval_s: INTERVAL_S,
        },
        torque_nm,
        measured: Motion {
            displacement_rad: Some(column(1)),
            velocity_rad_per_s: None,
            acceleration_rad_per_s2: Some(column(2)),
        },
        simulated: Motion {
            displacement_rad: Some(column(3)),
            velocity_rad_per_s: Some(column(4)),
            acceleration_rad_per_s2: Some(column(5)),
        },
        before: Motion {
            acceleration_rad_per_s2: Some(column(10)),
            ..Motion::default()
        },
        euler_displacement_rad: column(6),
        force_f1_n: column(7),
        force_f2_n: Vec::new(),
        force_f3_n: column(8),
        grip_force_n: force.then(|| column(9)),
    }
}

fn result(file: &str, number: u32, estimate: Option<Estimate>) -> TighteningResult {
    TighteningResult {
        started_at_s: None,
        id: TighteningId {
            file: file.into(),
            number,
        },
        conditions: Conditions {
            participant: Some("TP3".into()),
            pace_per_min: Some(8.0),
            ..Conditions::default()
        },
        rig: Rig {
            lever_arm_m: 0.33,
            known_inertia_kg_m2: 0.275,
        },
        peak_torque_nm: 29.7,
        target_torque_nm: 30.0,
        estimate,
        measures: FitMeasures {
            fit_percent: Some(93.1),
            error_over_noise: Some(1.02),
            peak_force_f1_n: Some(f64::INFINITY),
            ..FitMeasures::default()
        },
        selection: Selection {
            rejections: vec![Rejection::PoorFit, Rejection::GoesUp],
        },
        validation: None,
        corrections: vec![Correction {
            constant_of: Some(snug_campaign::Quantity::Acceleration),
            effect: "acceleration_bias".into(),
            value: 0.1 + 0.2,
            standard_error: 0.01,
            unit: "rad/s^2".into(),
            significant: true,
        }],
        noise: Some(NoiseFloor {
            source: NoiseSource::PreRoll,
            quantity: Quantity::Acceleration,
            standard_deviation: 0.5,
            autoregression: noise(4, 3),
            innovation_sd: 1.0 / 3.0,
            samples: 12_000,
        }),
    }
}

fn estimate() -> Estimate {
    let parameter = |name: &str, unit: &str, fixed: bool| ParameterEstimate {
        name: name.into(),
        unit: unit.into(),
        value: 1.76,
        standard_error: (!fixed).then_some(0.02),
        interval: (!fixed).then_some(Interval {
            low: 1.72,
            high: 1.8,
        }),
        fixed,
    };
    Estimate {
        parameters: vec![
            parameter("mass_kg", "kg", false),
            parameter("stiffness_n_per_m", "N/m", true),
        ],
        covariance: vec![4e-4],
        status: FitStatus::ConvergedAtConstraint,
        active_constraints: vec!["light_damping".into()],
        identifiability: Identifiability {
            rank: 1,
            free: 1,
            condition: 1.0,
            strongest_correlation: Some(("mass_kg".into(), "damping_kg_per_s".into(), -0.9)),
        },
        iterations: 7,
        evaluations: 15,
        conic_solves: 2,
    }
}

fn small_chunks() -> RecordSettings {
    RecordSettings {
        chunk_bytes: 4096,
        ..RecordSettings::default()
    }
}

/// Two files, of which the second has no grip force, with interleaved tightenings of 120 samples.
fn tightenings() -> Vec<(TighteningResult, Traces)> {
    (0..6)
        .map(|index| {
            let file = ["TP3_QS_Soft_8.mat", "TP1_TT_Hard_5.mat"][index % 2];
            let result = result(file, index as u32 / 2 + 1, (index != 3).then(estimate));
            (result, traces(index as u64, 120, index % 2 == 0))
        })
        .collect()
}

fn record(settings: RecordSettings) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(&mut bytes, settings).unwrap();
    recorder.study("(title: \"round trip\")").unwrap();
    for (result, traces) in &tightenings() {
        recorder.tightening(result, traces, Some(17)).unwrap();
    }
    recorder.finish().unwrap();
    bytes
}

fn bits(samples: &[f64]) -> Vec<u64> {
    samples.iter().map(|sample| sample.to_bits()).collect()
}
