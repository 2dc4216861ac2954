//! What mechanics demands of every trajectory, whatever the numbers.
#![allow(clippy::unwrap_used)]

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use snug_synthetic::{HandArm, HiddenEffect, Law, Plant, Pulse, Trajectory};

fn plant(laws: Vec<Law>) -> Plant {
    Plant {
        lever_arm_m: 0.330,
        known_inertia_kg_m2: 0.275,
        hand_arm: HandArm {
            mass_kg: 2.0,
            damping_kg_per_s: 90.0,
            stiffness_n_per_m: 2400.0,
        },
        pulses: vec![Pulse {
            start_s: 0.0,
            rundown_nm: 1.1,
            rundown_rise_s: 0.01,
            snug_s: 0.02,
            ramp_s: 0.09,
            curvature: 1.0,
            dwell: None,
            peak_nm: 37.0,
            release_s: 0.007,
        }],
        laws,
    }
}

fn law(effect: HiddenEffect, strength: f64) -> Law {
    effect
        .law(strength, &mut ChaCha8Rng::seed_from_u64(3))
        .unwrap()
}

fn run(plant: &Plant) -> Trajectory {
    Trajectory::of(plant, 0.0, 1e-4, 4001)
}

/// Force that the laws add to spring and damper \[N\], from the balance of the whole tool.
fn added_force_n(plant: &Plant, trajectory: &Trajectory) -> Vec<f64> {
    let (l, arm) = (plant.lever_arm_m, plant.hand_arm);
    (0..trajectory.time_s.len())
        .map(|n| {
            let torque = trajectory.acting_torque_nm[n];
            let total =
                (torque - plant.inertia_kg_m2() * trajectory.acceleration_rad_per_s2[n]) / l;
            total
                - l * arm.stiffness_n_per_m * trajectory.theta_rad[n]
                - l * arm.damping_kg_per_s * trajectory.omega_rad_per_s[n]
        })
        .collect()
}

/// ∫ F v dt \[J\], by the trapezoidal rule.
fn work_j(plant: &Plant, trajectory: &Trajectory, force_n: &[f64]) -> f64 {
    let power = |n: usize| force_n[n] * plant.lever_arm_m * trajectory.omega_rad_per_s[n];
    (1..force_n.len())
        .map(|n| 0.5 * 1e-4 * (power(n - 1) + power(n)))
        .sum()
}

#[test]
fn free_decay_is_the_closed_form_to_1e9() {
    let (theta0, omega0) = (0.004, -0.2);
    let start = Law {
        effect: HiddenEffect::InitialMotion,
        numbers: vec![theta0, omega0],
    };
    let mut plant = plant(vec![start]);
    plant.pulses.clear();
    let trajectory = run(&plant);
    let square = plant.lever_arm_m * plant.lever_arm_m;
    let decay = plant.hand_arm.damping_kg_per_s * square / (2.0 * plant.inertia_kg_m2());
    let undamped = plant.hand_arm.stiffness_n_per_m * square / plant.inertia_kg_m2();
    let damped = (undamped - decay * decay).sqrt();
    for (t, theta) in trajectory.time_s.iter().zip(&trajectory.theta_rad) {
        let sine = (omega0 + decay * theta0) / damped;
        let expected =
            (-decay * t).exp() * (theta0 * (damped * t).cos() + sine * (damped * t).sin());
        assert!((theta - expected).abs() < 1e-9 * 0.01, "{t}");
    }
}

#[test]
fn angular_momentum_is_the_impulse_of_torque_spring_and_damper() {
    let plant = plant(Vec::new());
    let trajectory = run(&plant);
    let square = plant.lever_arm_m * plant.lever_arm_m;
    let simpson = |signal: &[f64]| -> f64 {
        let weight = |n: usize| match n {
            0 | 4000 => 1.0,
            odd if odd % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let sum: f64 = signal.iter().enumerate().map(|(n, s)| weight(n) * s).sum();
        sum * 1e-4 / 3.0
    };
    let impulse = simpson(&trajectory.acting_torque_nm);
    let left = plant.inertia_kg_m2() * trajectory.omega_rad_per_s[4000]
        + plant.hand_arm.damping_kg_per_s * square * trajectory.theta_rad[4000]
        + plant.hand_arm.stiffness_n_per_m * square * simpson(&trajectory.theta_rad);
    // The torque's kinks cost Simpson's rule about a slope jump times the squared interval.
    assert!((left - impulse).abs() < 1e-5 * impulse, "{left} {impulse}");
}

#[test]
fn dissipative_laws_take_energy_and_conservative_ones_give_it_back() {
    use HiddenEffect::*;
    for effect in [
        CoulombFriction,
        QuadraticDamping,
        MaxwellBranch,
        BoucWen,
        X2vDamping,
        PositionFriction,
        CubicDamping,
    ] {
        let plant = plant(vec![law(effect, 0.6)]);
        let trajectory = run(&plant);
        let work = work_j(&plant, &trajectory, &added_force_n(&plant, &trajectory));
        assert!(work > 0.01, "{effect:?} {work} J");
    }
    type PotentialJ = fn(f64) -> f64;
    let conservative: [(HiddenEffect, PotentialJ); 4] = [
        (CubicStiffness, |x| 3.3e6 * x.powi(4) / 4.0),
        (QuadraticStiffness, |x| 6.0e4 * x.powi(3) / 3.0),
        (QuinticStiffness, |x| 4.0e9 * x.powi(6) / 6.0),
        (EndStop, |x| 5000.0 * (x - 0.007).max(0.0).powi(2) / 2.0),
    ];
    for (effect, potential_j) in conservative {
        let plant = plant(vec![law(effect, 1.0)]);
        let trajectory = run(&plant);
        let work = work_j(&plant, &trajectory, &added_force_n(&plant, &trajectory));
        let end_m = plant.lever_arm_m * trajectory.theta_rad[4000];
        let most = potential_j(plant.lever_arm_m * trajectory.peak_rad());
        assert!(
            (work - potential_j(end_m)).abs() < 1e-5 * most,
            "{effect:?}"
        );
    }
}

#[test]
fn effects_push_the_peak_the_right_way() {
    use HiddenEffect::*;
    let base = run(&plant(Vec::new())).peak_rad();
    let peak = |effect| run(&plant(vec![law(effect, 0.5)])).peak_rad();
    for stiffening in [
        CubicStiffness,
        QuadraticStiffness,
        CoulombFriction,
        QuadraticDamping,
        MaxwellBranch,
        BoucWen,
        StretchReflex,
        VoluntaryPush,
        CoContraction,
        TorqueDependentStiffness,
        X2vDamping,
        XvDamping,
        PositionFriction,
        CubicDamping,
        QuinticStiffness,
        ExponentialStiffness,
        EndStop,
    ] {
        assert!(peak(stiffening) < base, "{stiffening:?}");
    }
    for yielding in [Backlash, GripSlip, SecondMass] {
        assert!(peak(yielding) > base, "{yielding:?}");
    }
    // Only the way back differs.
    assert_eq!(peak(DirectionalDamping), base);
}

#[test]
fn every_effect_fades_into_the_base_model() {
    let base = run(&plant(Vec::new()));
    let difference = |effect, strength| {
        let trajectory = run(&plant(vec![law(effect, strength)]));
        let gaps = trajectory.theta_rad.iter().zip(&base.theta_rad);
        gaps.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    for (effect, _) in HiddenEffect::ALL {
        let (half, thousandth) = (difference(effect, 0.5), difference(effect, 0.0005));
        assert!(
            thousandth <= 2.1e-3 * half,
            "{effect:?}: {half} rad at 0.5, {thousandth} rad at 0.0005"
        );
    }
}

#[test]
fn a_reflex_does_nothing_before_its_delay() {
    let plain = run(&plant(Vec::new()));
    let reflex = run(&plant(vec![law(HiddenEffect::StretchReflex, 1.0)]));
    assert_eq!(plain.theta_rad[..600], reflex.theta_rad[..600]);
    assert!(reflex.theta_rad[1500] < plain.theta_rad[1500]);
}
