//! What stands in the channels: determinism, noise, sensor effects, faults.
#![allow(clippy::unwrap_used)]

use snug_synthetic::{
    CampaignPlan, Fault, HiddenEffect, NoiseKind, PlannedFault, SyntheticCampaign, SyntheticError,
    ZeroErrors, simulate,
};

/// First sample of the window.
const WINDOW: usize = 14_800;

/// One file with two tightenings and no noise, with one effect.
fn silent(effect: Option<HiddenEffect>, strength: f64) -> CampaignPlan {
    let mut plan = CampaignPlan::of_size(1, 2);
    plan.effects = effect.into_iter().collect();
    plan.strength = strength;
    plan.sensors.acceleration_noise_rad_per_s2 = 0.0;
    plan.sensors.torque_noise_nm = 0.0;
    plan.sensors.force_noise_n = 0.0;
    plan
}

fn run(plan: &CampaignPlan) -> SyntheticCampaign {
    simulate(plan, 11).unwrap()
}

/// Acceleration with `effect` minus acceleration without, and the torque likewise.
fn added(effect: HiddenEffect) -> (Vec<f64>, Vec<f64>) {
    let (plain, hidden) = (run(&silent(None, 0.5)), run(&silent(Some(effect), 0.5)));
    let minus = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
    let (plain, hidden) = (&plain.files[0], &hidden.files[0]);
    (
        minus(
            &hidden.acceleration_rad_per_s2,
            &plain.acceleration_rad_per_s2,
        ),
        minus(&hidden.torque_nm, &plain.torque_nm),
    )
}

#[test]
fn same_plan_and_seed_same_bits_and_other_seed_other_bits() {
    let mut plan = CampaignPlan::of_size(2, 2);
    plan.sensors.noise = NoiseKind::Coloured;
    plan.sensors.bias_sd_rad_per_s2 = 0.03;
    assert_eq!(run(&plan), run(&plan));
    assert_ne!(run(&plan).files, simulate(&plan, 12).unwrap().files);
}

#[test]
fn strength_zero_is_the_base_model_bit_for_bit() {
    let plain = run(&silent(None, 0.0));
    for (effect, _) in HiddenEffect::ALL {
        assert_eq!(
            run(&silent(Some(effect), 0.0)).files,
            plain.files,
            "{effect:?}"
        );
    }
}

#[test]
fn one_file_more_leaves_the_others_as_they_were() {
    let (two, three) = (CampaignPlan::of_size(2, 1), CampaignPlan::of_size(3, 1));
    assert_eq!(run(&two).files[..], run(&three).files[..2]);
}

#[test]
fn quiet_part_holds_noise_of_the_declared_size_and_no_motion() {
    let campaign = run(&CampaignPlan::of_size(1, 1));
    let file = &campaign.files[0];
    let spread = |samples: &[f64]| {
        let power: f64 = samples.iter().map(|s| s * s).sum();
        (power / samples.len() as f64).sqrt()
    };
    // 14 800 samples: a standard error of 0.6 %.
    assert!((spread(&file.acceleration_rad_per_s2[..WINDOW]) - 0.5).abs() < 0.015);
    assert!((spread(&file.torque_nm[..WINDOW]) - 0.02).abs() < 0.0006);
    let silent = run(&silent(None, 0.0));
    let quiet = &silent.files[0].acceleration_rad_per_s2[..WINDOW];
    assert!(quiet.iter().all(|&a| a == 0.0));
}

#[test]
fn grip_force_is_what_the_tool_does_not_take() {
    let campaign = run(&silent(None, 0.0));
    let file = &campaign.files[0];
    let force = file.grip_force_n.as_ref().unwrap();
    for (n, force) in force.iter().enumerate() {
        let expected = (file.torque_nm[n] - 0.275 * file.acceleration_rad_per_s2[n]) / 0.330;
        assert!((force - expected).abs() < 1e-4, "{n}");
    }
}

#[test]
fn peak_torque_is_the_target_and_peak_angle_the_double_integral() {
    let campaign = run(&silent(None, 0.0));
    let file = &campaign.files[0];
    for (index, truth) in campaign.truth.tightenings.iter().enumerate() {
        let segment = index * 20_000..(index + 1) * 20_000;
        let peak = file.torque_nm[segment.clone()]
            .iter()
            .copied()
            .fold(0.0, f64::max);
        // The peak may stand between two samples, where the shut-off is still flat.
        assert!(
            peak <= truth.target * (1.0 + 1e-7) && peak > truth.target * 0.99,
            "{peak}"
        );
        let (mut omega, mut theta, mut largest) = (0.0, 0.0, 0.0_f64);
        let acceleration = &file.acceleration_rad_per_s2[segment];
        for n in 1..acceleration.len() {
            let before = omega;
            omega += 0.5e-4 * (acceleration[n - 1] + acceleration[n]);
            theta += 0.5e-4 * (before + omega);
            largest = largest.max(theta);
        }
        assert!((largest - truth.peak_rad).abs() < 1e-5 * truth.peak_rad);
    }
}

#[test]
fn constant_sensor_errors_are_in_the_quiet_part_only_when_asked() {
    let (bias, _) = added(HiddenEffect::AccelerationBias);
    assert!(bias[0].abs() > 0.05 && (bias[0] - bias[19_999]).abs() < 1e-5);
    assert_ne!(bias[0], bias[20_000], "each tightening has its own");
    let (_, offset) = added(HiddenEffect::TorqueOffset);
    assert!(offset.iter().all(|t| (t - 0.5).abs() < 1e-5));
    let (output, _) = added(HiddenEffect::OutputOffset);
    assert!(output[WINDOW - 1] == 0.0 && output[WINDOW].abs() > 0.05);

    let mut plan = silent(Some(HiddenEffect::TorqueOffset), 0.5);
    plan.sensors.zero_errors = ZeroErrors::WindowOnly;
    let torque = &run(&plan).files[0].torque_nm;
    assert_eq!((torque[0], torque[WINDOW - 1]), (0.0, 0.0));
    assert!((torque[19_999] - 0.5).abs() < 1e-6);
}

#[test]
fn leaks_follow_speed_and_angle() {
    let plain = run(&silent(None, 0.0));
    let acceleration = &plain.files[0].acceleration_rad_per_s2;
    let (crosstalk, _) = added(HiddenEffect::CentripetalCrosstalk);
    let (leakage, _) = added(HiddenEffect::GravityLeakage);
    let (mut omega, mut theta) = (0.0, 0.0);
    for n in 1..20_000 {
        let before = omega;
        omega += 0.5e-4 * (acceleration[n - 1] + acceleration[n]);
        theta += 0.5e-4 * (before + omega);
        assert!((crosstalk[n] - 0.4 * omega * omega).abs() < 1e-4, "{n}");
        assert!((leakage[n] - 10.0 * f64::sin(theta)).abs() < 1e-4, "{n}");
    }
}

#[test]
fn a_delayed_torque_moves_the_tool_later_but_is_logged_as_ever() {
    let plain = run(&silent(None, 0.0));
    let late = run(&silent(Some(HiddenEffect::TorqueDelay), 0.5));
    assert_eq!(plain.files[0].torque_nm, late.files[0].torque_nm);
    // 0.5 × 4 ms are 20 samples.
    let (plain, late) = (
        &plain.files[0].acceleration_rad_per_s2,
        &late.files[0].acceleration_rad_per_s2,
    );
    for n in WINDOW..19_000 {
        assert!((plain[n] - late[n + 20]).abs() < 1e-4, "{n}");
    }
}

#[test]
fn gain_and_lever_arm_are_exactly_invisible() {
    let plain = run(&silent(None, 0.0));
    let gain = run(&silent(Some(HiddenEffect::TorqueGain), 0.5));
    let of = |campaign: &SyntheticCampaign| campaign.files[0].clone();
    assert_eq!(
        of(&plain).acceleration_rad_per_s2,
        of(&gain).acceleration_rad_per_s2
    );
    for (logged, acting) in of(&gain).torque_nm.iter().zip(&of(&plain).torque_nm) {
        assert!((logged - 1.05 * acting).abs() < 1e-5);
    }
    // With a lever arm longer by e, m, c and k grown by (1 + e)² do the same.
    let lever = run(&silent(Some(HiddenEffect::LeverArmError), 0.5));
    let mut alike = silent(None, 0.0);
    alike.lever_arm_m *= 1.025;
    assert_eq!(
        of(&lever).acceleration_rad_per_s2,
        of(&run(&alike)).acceleration_rad_per_s2
    );
}

#[test]
fn fatigue_softens_from_tightening_to_tightening() {
    let (plain, tired) = (
        run(&silent(None, 0.0)),
        run(&silent(Some(HiddenEffect::Fatigue), 0.5)),
    );
    for (plain, tired) in plain.truth.tightenings.iter().zip(&tired.truth.tightenings) {
        let number = plain.index as f64;
        assert!((tired.k / plain.k - (1.0 - 0.02 * number)).abs() < 1e-12);
        assert!((tired.m / plain.m - (1.0 + 0.005 * number)).abs() < 1e-12);
    }
}

#[test]
fn faults_are_where_they_were_planned() {
    let with = |fault, tightening| {
        let mut plan = silent(None, 0.0);
        plan.faults = vec![PlannedFault {
            file: 0,
            tightening,
            fault,
        }];
        simulate(&plan, 11)
    };
    let none = with(Fault::NoPulse, 0).unwrap();
    assert!(none.files[0].torque_nm[..20_000].iter().all(|&t| t == 0.0));
    assert!(none.files[0].torque_nm[20_000..].iter().any(|&t| t > 10.0));
    assert_eq!(none.truth.tightenings[0].fault.as_deref(), Some("no_pulse"));

    let short = with(Fault::Truncated, 1).unwrap();
    assert_eq!(short.files[0].torque_nm.len(), 20_000 + 15_400);
    let segment = &short.files[0].recording().segments[1];
    assert_eq!((segment.start, segment.end), (20_000, 40_000));

    let gap = with(Fault::Gap, 0).unwrap();
    let missing = gap.files[0].acceleration_rad_per_s2.iter();
    assert_eq!(missing.filter(|a| a.is_nan()).count(), 50);

    let plain = run(&silent(None, 0.0));
    let clipped = with(Fault::SaturatedTorque, 0).unwrap();
    let most = |campaign: &SyntheticCampaign| {
        campaign.files[0].torque_nm[..20_000]
            .iter()
            .copied()
            .fold(0.0, f64::max)
    };
    assert!((most(&clipped) / most(&plain) - 0.7).abs() < 1e-6);

    let inside = with(Fault::Truncated, 0);
    assert!(matches!(
        inside,
        Err(SyntheticError::TruncatedInside { .. })
    ));
    assert!(matches!(
        with(Fault::Gap, 9),
        Err(SyntheticError::FaultOutsidePlan { .. })
    ));
}

#[test]
fn a_plan_that_cannot_be_says_which_setting() {
    let mut plan = CampaignPlan::of_size(1, 1);
    plan.segment_s = 1.0;
    let error = simulate(&plan, 1).unwrap_err().to_string();
    assert!(
        error.contains("segment_s") && error.contains('1'),
        "{error}"
    );
}
