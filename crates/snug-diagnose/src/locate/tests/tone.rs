//! A misfit that is one steady tone, and others that are none.

use super::{Made, campaign, locate, seen};
use snug_campaign::words::remark::Remark;
use std::f64::consts::TAU;

fn tone(misfit: impl Fn(u32, f64) -> f64) -> Option<(f64, f64)> {
    told(&campaign(6, 1, misfit))
}

fn told(made: &[Made]) -> Option<(f64, f64)> {
    let remarks = locate(&seen(made), 1).remarks;
    remarks.into_iter().find_map(|remark| match remark {
        Remark::Tone { hz, share } => Some((hz, share)),
        _ => None,
    })
}

/// Whether the input is said to have the tone, where one is told that the torque has this much of \[Nm\], too.
fn is_in_input(hz: f64, torque_nm: f64) -> Option<bool> {
    is_among(hz, &[hz], torque_nm)
}

/// The same of a torque that has as much of several.
fn is_among(hz: f64, all_hz: &[f64], torque_nm: f64) -> Option<bool> {
    let sine = |t: f64| -> f64 { all_hz.iter().map(|hz| (TAU * hz * t).sin()).sum() };
    let mut made = campaign(6, 1, |_, t| 3.0 * (TAU * hz * t).sin());
    for one in &mut made {
        let tightening = &mut one.tightening;
        let interval_s = tightening.time_base.interval_s;
        for (index, torque) in tightening.torque_nm.iter_mut().enumerate() {
            *torque += torque_nm * sine(index as f64 * interval_s);
        }
    }
    let remarks = locate(&seen(&made), 1).remarks;
    remarks.into_iter().find_map(|remark| match remark {
        Remark::Tone { .. } => Some(false),
        Remark::PickedUp { .. } => Some(true),
        _ => None,
    })
}

/// 3 rad/s² of another phase in each tightening beside noise of 0.5 rad/s², of which nothing is above half the sampling rate.
#[test]
fn a_hum_is_told_with_its_frequency() {
    let hum = |number: u32, t: f64| 3.0 * (TAU * 403.7 * t + 1.7 * f64::from(number)).sin();
    let (hz, share) = tone(hum).expect("a tone");
    assert!((hz - 403.7).abs() < 0.3, "{hz}");
    assert!(share > 0.9, "{share}");
}

/// A tone that dies away after a push, one that comes and goes, two tones, and noise are none.
#[test]
fn what_rings_or_wavers_is_no_hum() {
    let sine = |hz: f64, t: f64| 3.0 * (TAU * hz * t).sin();
    let rings = |_: u32, t: f64| 3.0 * sine(400.0, t) * (-t.max(0.0) / 0.05).exp();
    let wavers = |_: u32, t: f64| sine(400.0, t) * f64::from(u8::from(t > 0.1));
    let two = |_: u32, t: f64| sine(400.0, t) + sine(700.0, t);
    assert_eq!(tone(rings), None);
    assert_eq!(tone(wavers), None);
    assert_eq!(tone(two), None);
    assert_eq!(tone(|_, _| 0.0), None);
}

/// Mains in the cables of both, unless the tone is loud enough to drive the rig, or none of the mains.
#[test]
fn a_faint_tone_of_the_mains_in_the_input_drives_no_rig() {
    assert_eq!(is_in_input(400.1, 0.0), Some(false));
    assert_eq!(is_in_input(400.1, 0.1), Some(true));
    assert_eq!(is_in_input(400.1, 10.0), None);
    assert_eq!(is_in_input(403.7, 0.1), None);
    assert_eq!(is_among(400.1, &[400.1, 425.0], 0.1), None);
}

/// A short recording that is sampled too slowly for the tone says nothing of it, and takes nothing from it.
#[test]
fn the_tone_is_told_beside_a_recording_that_cannot_show_it() {
    let hum = |number: u32, t: f64| 3.0 * (TAU * 403.7 * t + 1.7 * f64::from(number)).sin();
    let mut made = campaign(6, 1, hum);
    let slow = &mut made[0];
    slow.tightening.time_base.interval_s = 2e-3;
    slow.tightening.torque_nm.truncate(100);
    slow.tightening.onset = None;
    for motion in [&mut slow.tightening.motion, &mut slow.simulated] {
        let quantities = [
            &mut motion.displacement_rad,
            &mut motion.velocity_rad_per_s,
            &mut motion.acceleration_rad_per_s2,
        ];
        for values in quantities.into_iter().flatten() {
            values.truncate(100);
        }
    }
    let (hz, _) = told(&made).expect("a tone");
    assert!((hz - 403.7).abs() < 0.3, "{hz}");
}
