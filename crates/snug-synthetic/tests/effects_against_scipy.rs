//! Every law against an independent simulation: the table in `reference/effects.csv`, made with SciPy as its head says.
#![allow(clippy::unwrap_used)]

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use snug_synthetic::{Dwell, HandArm, HiddenEffect, Plant, Pulse, Trajectory};
use std::collections::BTreeSet;

const TABLE: &str = include_str!("reference/effects.csv");

/// The table's plant with `effect` (or none) at strength 0.5.
fn plant(effect: &str) -> Plant {
    let mut unused = ChaCha8Rng::seed_from_u64(0);
    let law = |name| {
        HiddenEffect::from_name(name)
            .unwrap()
            .law(0.5, &mut unused)
            .unwrap()
    };
    let laws = (effect != "none").then_some(effect).map(law);
    Plant {
        lever_arm_m: 0.330,
        known_inertia_kg_m2: 0.275,
        hand_arm: HandArm {
            mass_kg: 2.2,
            damping_kg_per_s: 95.0,
            stiffness_n_per_m: 2350.0,
        },
        pulses: vec![Pulse {
            start_s: 0.0004,
            rundown_nm: 1.2,
            rundown_rise_s: 0.011,
            snug_s: 0.025,
            ramp_s: 0.055,
            curvature: 1.1,
            dwell: Some(Dwell {
                middle_ratio: 0.32,
                half_length_ratio: 0.12,
                depth_ratio: 0.9,
            }),
            peak_nm: 32.0,
            release_s: 0.007,
        }],
        laws: laws.into_iter().collect(),
    }
}

/// What a law's smoothness allows a fixed step to reach, relative to the signal's size.
fn tolerance(effect: &str) -> f64 {
    match effect {
        // The damper sets in at once where the gap closes, in the middle of a step.
        "backlash" => 2e-5,
        // Its rate jumps where the velocity changes its sign, in the middle of a step.
        "bouc_wen" => 2e-9,
        // A derivative jumps there, or friction turns within 0.01 m/s.
        "directional_damping" | "coulomb_friction" | "position_friction" => 5e-10,
        _ => 1e-11,
    }
}

#[test]
fn every_law_moves_the_tool_as_scipy_says() {
    let rows: Vec<Vec<&str>> = TABLE
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let effects: BTreeSet<&str> = rows.iter().map(|row| row[0]).collect();
    // All laws that change the motion or a channel's timing; the others are sums that `channels.rs` checks.
    assert_eq!(effects.len(), 26);
    for effect in effects {
        let trajectory = Trajectory::of(&plant(effect), 0.0, 1e-4, 3001);
        for row in rows.iter().filter(|row| row[0] == effect) {
            let number = |column: usize| row[column].parse::<f64>().unwrap();
            let sample = (number(1) / 1e-4).round() as usize;
            let found = [
                (trajectory.theta_rad[sample], number(2), 0.04),
                (trajectory.omega_rad_per_s[sample], number(3), 0.9),
                (
                    trajectory.sensed_acceleration_rad_per_s2[sample],
                    number(4),
                    35.0,
                ),
                (trajectory.logged_torque_nm[sample], number(5), 32.0),
            ];
            for (found, expected, size) in found {
                let error = (found - expected).abs() / size;
                assert!(
                    error < tolerance(effect),
                    "{effect} at {} s: {found} against {expected}, error {error:.1e}",
                    row[1]
                );
            }
        }
    }
}
