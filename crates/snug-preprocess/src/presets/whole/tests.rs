//! What is taken as it is, and what is said of it.
#![allow(clippy::unwrap_used)]

use crate::settings::rig::KnownInertia;
use crate::tests::synthetic::{SEGMENT, coloured_noise, recording};
use crate::{PreprocessSettings, Preprocessed, Window, preprocess};
use snug_campaign::{Motion, Quantity};

fn whole() -> PreprocessSettings {
    PreprocessSettings {
        window: Window::Whole,
        ..PreprocessSettings::default()
    }
}

fn codes(result: &Preprocessed) -> Vec<String> {
    let findings = result.findings.iter();
    findings.map(|finding| finding.code.clone()).collect()
}

/// Glitches of an encoder and a logger that dropped out, told and left; a kick by the torque is none.
#[test]
fn what_no_rig_does_is_told_of_a_whole_recording() {
    let settings = whole();
    let swing = |per_sample: f64| (0..SEGMENT).map(move |k| (per_sample * k as f64).sin());
    let told = |spoil: &dyn Fn(&mut [f64], &mut [f64])| -> Vec<String> {
        let mut recording = recording(&[51], 0.0);
        let mut torque_nm: Vec<f64> = swing(0.01).collect();
        let mut angle_rad: Vec<f64> = swing(0.02).collect();
        spoil(&mut torque_nm, &mut angle_rad);
        recording.torque_nm.clone_from(&torque_nm);
        recording.motion = Motion {
            displacement_rad: Some(angle_rad.clone()),
            ..Default::default()
        };
        let result = preprocess(&recording, &settings, Quantity::Displacement).unwrap();
        let tightening = &result.tightenings[0].tightening;
        assert_eq!(tightening.motion.displacement_rad, Some(angle_rad));
        codes(&result)
    };
    let none = told(&|_, _| ());
    let glitch = |angle_rad: &mut [f64]| angle_rad[700] += 0.5;
    let with = |code: &str| [none.as_slice(), &[code.to_owned()]].concat();
    assert_eq!(told(&|_, angle_rad| glitch(angle_rad)), with("spikes"));
    let kicked = told(&|torque_nm, angle_rad| {
        glitch(angle_rad);
        torque_nm[699] += 20.0;
    });
    assert_eq!(kicked, none);
    let held = told(&|_, angle_rad| {
        let value = angle_rad[1000];
        angle_rad[1000..1060].fill(value);
    });
    assert_eq!(held, with("dropout"));
}

#[test]
fn whole_segments_stay_as_measured() {
    let mut recording = recording(&[51], 0.0);
    recording.motion = Motion {
        displacement_rad: Some(coloured_noise(SEGMENT, 1.0, 3)),
        ..Default::default()
    };
    recording.segments[0].start = 100;
    let mut settings = whole();
    settings.rig.known_inertia = KnownInertia::Fixed(0.0);
    let result = preprocess(&recording, &settings, Quantity::Displacement).unwrap();
    let tightening = &result.tightenings[0].tightening;
    assert_eq!(tightening.torque_nm, recording.torque_nm[100..]);
    assert_eq!(
        tightening.motion.displacement_rad.as_ref().unwrap()[..],
        recording.motion.displacement_rad.as_ref().unwrap()[100..]
    );
    assert_eq!(tightening.rig.known_inertia_kg_m2, 0.0);
    assert!(tightening.motion.velocity_rad_per_s.is_none() && tightening.noise.is_none());
    let result = preprocess(&recording, &settings, Quantity::Acceleration).unwrap();
    assert_eq!(codes(&result), ["missing_channel"]);
}
