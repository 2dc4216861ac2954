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

/// What is said of a swing that is spoilt, and the angle that is fitted.
fn told(spoil: &dyn Fn(&mut [f64], &mut [f64])) -> (Vec<String>, Vec<f64>) {
    let mut result = prepared(spoil);
    let codes = codes(&result);
    let tightening = result.tightenings.remove(0).tightening;
    (codes, tightening.motion.displacement_rad.unwrap())
}

/// What becomes of a swing that is spoilt.
fn prepared(spoil: &dyn Fn(&mut [f64], &mut [f64])) -> Preprocessed {
    let swing = |per_sample: f64| (0..SEGMENT).map(move |k| (per_sample * k as f64).sin());
    let mut recording = recording(&[51], 0.0);
    let mut torque_nm: Vec<f64> = swing(0.01).collect();
    let mut angle_rad: Vec<f64> = swing(0.02).collect();
    spoil(&mut torque_nm, &mut angle_rad);
    recording.torque_nm = torque_nm;
    recording.motion = Motion {
        displacement_rad: Some(angle_rad),
        ..Default::default()
    };
    preprocess(&recording, &whole(), Quantity::Displacement).unwrap()
}

/// The codes of a swing that is not spoilt, and one more.
fn with(code: &str) -> Vec<String> {
    [told(&|_, _| ()).0, vec![code.to_owned()]].concat()
}

/// A glitch of an encoder is bridged; what a kick by the torque makes of the angle stays.
#[test]
fn a_glitch_is_mended_and_a_kick_is_none() {
    let glitch = |angle_rad: &mut [f64]| angle_rad[700] += 0.5;
    let (codes, mended) = told(&|_, angle_rad| glitch(angle_rad));
    assert_eq!(codes, with("spikes"));
    // On the straight line between its neighbours; sin 14 was there.
    let line = 0.5 * (13.98_f64.sin() + 14.02_f64.sin());
    assert!((mended[700] - line).abs() < 1e-12, "{}", mended[700]);
    assert_eq!(mended[699], 13.98_f64.sin());
    let (codes, kept) = told(&|torque_nm, angle_rad| {
        glitch(angle_rad);
        torque_nm[699] += 20.0;
    });
    assert_eq!(codes, told(&|_, _| ()).0);
    assert_eq!(kept[700], 14.0_f64.sin() + 0.5);
}

/// What comes again and again is no glitch, and a logger that dropped out has nothing to be mended with.
#[test]
fn what_cannot_be_mended_is_told_and_stays() {
    let (codes, kept) = told(&|_, angle_rad| {
        for place in (10..SEGMENT).step_by(40) {
            angle_rad[place] += 0.5;
        }
    });
    assert_eq!(codes, with("spikes"));
    assert_eq!(kept[10], 0.2_f64.sin() + 0.5);
    let (codes, kept) = told(&|_, angle_rad| {
        let value = angle_rad[1000];
        angle_rad[1000..1060].fill(value);
    });
    assert_eq!(codes, with("dropout"));
    assert_eq!(kept[1030], kept[1000]);
}

/// Of 20 000 samples 60 are stuck, or 400, more than a whole swing.
#[test]
fn a_reading_that_is_stuck_for_long_keeps_the_recording_out() {
    let stuck = |samples: usize, kicked: bool| {
        let mut result = prepared(&|torque_nm, angle_rad| {
            let value = angle_rad[1000];
            angle_rad[1000..1000 + samples].fill(value);
            let after = &mut torque_nm[1000 + samples..];
            after
                .iter_mut()
                .for_each(|torque| *torque += if kicked { 20.0 } else { 0.0 });
        });
        assert!(codes(&result).contains(&"dropout".to_owned()));
        result.tightenings.remove(0).data_quality_rejects
    };
    assert!(!stuck(60, false));
    assert!(stuck(400, false));
    assert!(!stuck(400, true), "it may have been held until then");
}

/// A zero that is set anew half way, at one sample; with the only jump of the torque it may be the rig.
#[test]
fn a_zero_that_jumps_is_told_and_keeps_the_recording_out() {
    let jump = |angle_rad: &mut [f64]| angle_rad[900..].iter_mut().for_each(|angle| *angle += 0.3);
    let (codes, kept) = told(&|_, angle_rad| jump(angle_rad));
    assert_eq!(codes, with("zero_jump"));
    assert_eq!(kept[900], 18.0_f64.sin() + 0.3);
    let with_kicks = |kicks: &[usize]| {
        let codes = told(&|torque_nm, angle_rad| {
            jump(angle_rad);
            for &from in kicks {
                torque_nm[from..]
                    .iter_mut()
                    .for_each(|torque| *torque += 20.0);
            }
        });
        codes.0
    };
    assert_eq!(with_kicks(&[899]), told(&|_, _| ()).0);
    // At 400 the angle did not jump.
    assert_eq!(with_kicks(&[400, 899]), with("zero_jump"));
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

/// A swing of 314 samples stands at 0.98 of its amplitude for 20 in a row, 6 % of it; one swing among many that are half as large does for
/// less than 1 % of all.
#[test]
fn an_acceleration_at_the_end_of_its_sensor_s_range_is_told() {
    let told = |limit: f64, swings: usize, fitted: Quantity| {
        let mut recording = recording(&[51], 0.0);
        let swing = |k: usize| {
            let size = if k < swings * 314 { 1.0 } else { 0.5 };
            (size * (0.02 * k as f64).sin()).clamp(-limit, limit)
        };
        recording.torque_nm = (0..SEGMENT).map(|k| (0.01 * k as f64).sin()).collect();
        recording.motion = Motion {
            acceleration_rad_per_s2: Some((0..SEGMENT).map(swing).collect()),
            displacement_rad: Some((0..SEGMENT).map(|k| (0.02 * k as f64).sin()).collect()),
            ..Default::default()
        };
        let mut result = preprocess(&recording, &whole(), fitted).unwrap();
        let is_told = codes(&result).contains(&"saturation".to_owned());
        (is_told, result.tightenings.remove(0).data_quality_rejects)
    };
    let all = SEGMENT / 314;
    assert_eq!(told(2.0, all, Quantity::Acceleration), (false, false));
    assert_eq!(told(0.98, all, Quantity::Acceleration), (true, true));
    assert_eq!(told(0.98, all, Quantity::Displacement), (true, false));
    assert_eq!(told(0.98, 1, Quantity::Acceleration), (true, false));
}
