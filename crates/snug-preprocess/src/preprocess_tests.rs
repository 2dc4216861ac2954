//! Whole recordings, clean and spoilt in one place: what each fault costs, and that its neighbour is left alone.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::prepared::Prepared;
use crate::tests::synthetic::{
    ONSET, PEAK, SEGMENT, acceleration, coloured_noise, pulse, recording, white_noise,
};
use snug_campaign::Rejection;

fn snug(recording: &Recording) -> Preprocessed {
    let settings = PreprocessSettings::default();
    preprocess(recording, &settings, Quantity::Acceleration).unwrap()
}

fn thesis(recording: &Recording) -> Preprocessed {
    let settings = PreprocessSettings {
        preset: Preset::Thesis,
        ..PreprocessSettings::default()
    };
    preprocess(recording, &settings, Quantity::Displacement).unwrap()
}

fn accelerations(recording: &mut Recording) -> &mut Vec<f64> {
    recording.motion.acceleration_rad_per_s2.as_mut().unwrap()
}

/// Spoils a clean recording of two tightenings in the second one; gives what becomes of that one.
fn spoilt(spoil: impl Fn(&mut Recording)) -> (Option<Prepared>, Vec<Finding>) {
    let mut recording = recording(&[11, 12], 0.0);
    spoil(&mut recording);
    let mut result = snug(&recording);
    assert!(
        result.findings.iter().all(|f| f.tightening != Some(1)),
        "{:?}",
        result.findings
    );
    assert_eq!(result.tightenings[0].rejections(), vec![]);
    (result.tightenings.drain(1..).next(), result.findings)
}

fn codes(findings: &[Finding]) -> Vec<&str> {
    findings.iter().map(|f| f.code.as_str()).collect()
}

fn rejected_for(code: &str, spoil: impl Fn(&mut Recording)) {
    let (prepared, findings) = spoilt(spoil);
    assert_eq!(codes(&findings), [code], "{findings:?}");
    assert_eq!(prepared.unwrap().rejections(), [Rejection::DataQuality]);
    assert_eq!(findings[0].severity, Severity::LeftOut);
}

fn left_out_for(code: &str, spoil: impl Fn(&mut Recording)) {
    let (prepared, findings) = spoilt(spoil);
    assert_eq!(codes(&findings), [code], "{findings:?}");
    assert!(prepared.is_none());
    assert_eq!(
        (findings[0].severity, findings[0].tightening),
        (Severity::LeftOut, Some(2))
    );
}

fn used_with(code: &str, spoil: impl Fn(&mut Recording)) -> Prepared {
    let (prepared, findings) = spoilt(spoil);
    assert_eq!(codes(&findings), [code], "{findings:?}");
    assert!(findings[0].severity < Severity::LeftOut);
    let prepared = prepared.unwrap();
    assert_eq!(prepared.rejections(), vec![]);
    prepared
}

#[test]
fn clean_recordings_give_clean_tightenings() {
    let seeds: Vec<u64> = (100..112).collect();
    let result = snug(&recording(&seeds, 0.0));
    assert_eq!(result.findings, vec![]);
    assert_eq!(result.tightenings.len(), seeds.len());
    for prepared in &result.tightenings {
        let tightening = &prepared.tightening;
        assert_eq!(tightening.torque_nm.len(), 3000);
        assert_eq!(tightening.time_base.at(0), 1.48);
        assert_eq!(tightening.target_torque_nm, 30.0);
        assert_eq!(tightening.rig.known_inertia_kg_m2, 0.275);
        assert!(tightening.onset.unwrap().abs_diff(ONSET - 14_800) < 10);
        assert_eq!(
            tightening.motion.velocity_rad_per_s.as_ref().unwrap()[0],
            0.0
        );
        assert_eq!(tightening.motion.displacement_rad.as_ref().unwrap()[0], 0.0);
        assert_eq!(tightening.grip_force_n.as_ref().unwrap().len(), 3000);
        assert!(
            tightening
                .corrections
                .iter()
                .all(|correction| !correction.significant)
        );
        let noise = tightening.noise.as_ref().unwrap();
        assert!((noise.standard_deviation - 0.5).abs() < 0.03);
        assert!(noise.innovation_sd < 0.49, "the noise is coloured");
        assert_eq!(
            (noise.quantity, noise.samples),
            (Quantity::Acceleration, 14_800)
        );
    }
}

#[test]
fn a_bias_is_measured_within_its_error_and_taken_out() {
    // The standard error under this noise: √(0.25 · (0.635 + 0.365·19) / 14 800) = 0.0113 rad/s².
    let result = snug(&recording(&[1, 2, 3, 4], 0.3));
    let truth = acceleration(&pulse(30.0));
    for prepared in &result.tightenings {
        let bias = &prepared.tightening.corrections[1];
        assert_eq!(
            (bias.effect.as_str(), bias.unit.as_str()),
            ("acceleration_bias", "rad/s^2")
        );
        assert!(bias.significant);
        assert!((bias.standard_error - 0.0113).abs() < 0.0015, "{bias:?}");
        assert!(
            (bias.value - 0.3).abs() < 4.0 * bias.standard_error,
            "{bias:?}"
        );
        let velocity = prepared
            .tightening
            .motion
            .velocity_rad_per_s
            .as_ref()
            .unwrap();
        let expected: f64 = truth[14_800..17_799].iter().sum::<f64>() * 1e-4;
        // 0.3 s of bias left in would be 0.09 rad/s; its error is 0.0034 and the noise's integral 0.0075.
        assert!((velocity[2999] - expected).abs() < 0.035);
    }
}

#[test]
fn a_torque_offset_is_taken_out_before_the_target_is_rounded() {
    let mut recording = recording(&[5], 0.0);
    recording
        .torque_nm
        .iter_mut()
        .for_each(|torque| *torque += 3.0);
    let tightening = snug(&recording).tightenings.remove(0).tightening;
    let offset = &tightening.corrections[0];
    assert_eq!(offset.effect, "torque_offset");
    assert!(offset.significant && (offset.value - 3.0).abs() < 0.001);
    assert_eq!(tightening.target_torque_nm, 30.0);
}

#[test]
fn a_torque_that_creeps_is_not_taken_for_an_offset() {
    let prepared = used_with("quiet_part_unsteady", |recording| {
        for index in 0..SEGMENT {
            recording.torque_nm[SEGMENT + index] += 0.1 * index.min(14_800) as f64 / 14_800.0;
        }
    });
    assert!(
        prepared
            .tightening
            .corrections
            .iter()
            .all(|c| c.effect != "torque_offset")
    );
}

#[test]
fn faults_that_reject() {
    rejected_for("saturation", |r| {
        r.torque_nm
            .iter_mut()
            .skip(SEGMENT)
            .for_each(|t| *t = t.min(26.0))
    });
    rejected_for("saturation", |r| {
        accelerations(r)
            .iter_mut()
            .skip(SEGMENT)
            .for_each(|a| *a = a.max(-20.0));
    });
    rejected_for("dropout", |r| {
        let held = r.torque_nm[SEGMENT + 15_200];
        r.torque_nm[SEGMENT + 15_200..SEGMENT + 15_240].fill(held);
    });
    rejected_for("double_hit", |r| {
        r.torque_nm[SEGMENT + 16_500..SEGMENT + 16_900]
            .iter_mut()
            .for_each(|t| *t += 20.0);
    });
    rejected_for("inverted_acceleration", |r| {
        accelerations(r)
            .iter_mut()
            .skip(SEGMENT)
            .for_each(|a| *a = -*a);
    });
    let (prepared, findings) = spoilt(|r| {
        (SEGMENT + 15_000..SEGMENT + 17_000)
            .step_by(40)
            .for_each(|i| r.torque_nm[i] = f64::NAN);
    });
    assert_eq!(codes(&findings), ["missing_samples", "repaired_too_much"]);
    assert!(prepared.unwrap().data_quality_rejects);
}

#[test]
fn faults_that_leave_out() {
    left_out_for("no_pulse", |r| {
        let noise = white_noise(SEGMENT, 0.02, 77);
        r.torque_nm[SEGMENT..].copy_from_slice(&noise);
    });
    left_out_for("no_pulse", |r| r.torque_nm[SEGMENT..].fill(0.0));
    left_out_for("constant_channel", |r| {
        accelerations(r)[SEGMENT..].fill(0.0)
    });
    left_out_for("inverted_torque", |r| {
        r.torque_nm.iter_mut().skip(SEGMENT).for_each(|t| *t = -*t);
    });
    left_out_for("swapped_channels", |r| {
        for index in SEGMENT..2 * SEGMENT {
            let torque = r.torque_nm[index];
            r.torque_nm[index] = std::mem::replace(&mut accelerations(r)[index], torque);
        }
    });
    left_out_for("gap", |r| {
        accelerations(r)[SEGMENT + 15_000..SEGMENT + 15_100].fill(f64::NAN)
    });
    left_out_for("truncated_segment", |r| {
        accelerations(r).truncate(SEGMENT + 17_000)
    });
    left_out_for("truncated_segment", |r| r.torque_nm.truncate(SEGMENT));
    left_out_for("truncated_segment", |r| {
        r.segments[1].end = SEGMENT + 15_000
    });
}

#[test]
fn faults_that_are_mended_or_noted() {
    used_with("missing_samples", |r| {
        r.torque_nm[SEGMENT + 15_100] = f64::INFINITY
    });
    used_with("spikes", |r| accelerations(r)[SEGMENT + 15_100] += 200.0);
    let flown = used_with("free_flight", |r| {
        let is_free = |&index: &usize| r.torque_nm[index].abs() < 0.1;
        let after = (SEGMENT + 15_000..SEGMENT + 18_000).filter(is_free);
        let size = |index: usize| r.motion.acceleration_rad_per_s2.as_ref().unwrap()[index].abs();
        let swing = after.max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap();
        accelerations(r)[swing..swing + 2].fill(0.0);
    });
    let measured = flown.tightening.motion.acceleration_rad_per_s2.unwrap();
    assert!(
        measured.windows(2).any(|pair| pair[0] == pair[1]),
        "two samples of 0"
    );
    used_with("truncated_segment", |r| {
        accelerations(r).truncate(SEGMENT + 18_000)
    });
    used_with("quiet_part_unsteady", |r| {
        for index in 0..4000 {
            accelerations(r)[SEGMENT + 5000 + index] += 3.0 * (0.01 * index as f64).sin();
        }
    });
    let without_force = used_with("gap", |r| {
        r.grip_force_n.as_mut().unwrap()[SEGMENT + 15_000..SEGMENT + 15_100].fill(f64::NAN);
    });
    assert_eq!(without_force.tightening.grip_force_n, None);
    let zeroed = used_with("grip_force_offset", |r| {
        r.grip_force_n
            .as_mut()
            .unwrap()
            .iter_mut()
            .skip(SEGMENT)
            .for_each(|f| *f += 5.0);
    });
    let force = zeroed.tightening.grip_force_n.unwrap();
    assert!((force.iter().sum::<f64>() / 3000.0).abs() < 0.1);
}

#[test]
fn a_pulse_behind_the_window_is_lost_and_the_first_one_used() {
    let (prepared, findings) = spoilt(|r| {
        r.torque_nm[SEGMENT + 18_500..SEGMENT + 18_900]
            .iter_mut()
            .for_each(|t| *t += 20.0);
    });
    assert_eq!(codes(&findings), ["second_pulse"]);
    assert_eq!(findings[0].severity, Severity::LeftOut);
    assert!(prepared.unwrap().rejections().is_empty());
}

#[test]
fn a_long_gap_in_the_quiet_part_shortens_it() {
    let mut recording = recording(&[6], 0.0);
    accelerations(&mut recording)[3000..3200].fill(f64::NAN);
    let prepared = &snug(&recording).tightenings[0];
    let measured = prepared.tightening.noise.as_ref().unwrap().samples;
    assert!(
        measured.abs_diff(14_800 - 3200) <= 2,
        "{measured}: up to the guard before the onset"
    );
    assert_eq!(
        thesis(&recording).findings[0].code,
        "gap",
        "the original integrates across it"
    );
}

#[test]
fn a_pulse_elsewhere_takes_the_window_along() {
    for shift in [-3000_isize, 2000] {
        let mut recording = recording(&[7], 0.0);
        if shift < 0 {
            recording.segments[0].start = shift.unsigned_abs();
        } else {
            let longer = shift.unsigned_abs();
            recording
                .torque_nm
                .splice(0..0, white_noise(longer, 0.02, 91));
            accelerations(&mut recording).splice(0..0, coloured_noise(longer, 0.5, 92));
            recording.grip_force_n = None;
            recording.segments[0].end += longer;
        }
        let result = snug(&recording);
        assert_eq!(
            codes(&result.findings)[0],
            "window_moved",
            "{:?}",
            result.findings
        );
        let tightening = &result.tightenings[0].tightening;
        let onset_s = tightening.time_base.at(tightening.onset.unwrap());
        let true_onset_s = (ONSET as f64 + shift as f64) * 1e-4;
        assert!((onset_s - true_onset_s).abs() < 1e-3);
        assert_eq!(tightening.onset, Some(50), "5 ms of lead");
        assert!(tightening.noise.is_some());
    }
}

#[test]
fn without_a_quiet_part_nothing_is_corrected() {
    let mut recording = recording(&[8], 0.3);
    recording.segments[0].start = ONSET - 300;
    recording.segments[0].end = SEGMENT;
    let result = snug(&recording);
    assert!(
        codes(&result.findings).contains(&"short_quiet_part"),
        "{:?}",
        result.findings
    );
    let tightening = &result.tightenings[0].tightening;
    assert!(tightening.corrections.is_empty() && tightening.noise.is_none());
}

#[test]
fn thesis_keeps_what_the_original_keeps() {
    let recording = recording(&[21, 22], 0.0);
    let measured = recording.motion.acceleration_rad_per_s2.as_ref().unwrap();
    let result = thesis(&recording);
    for (prepared, start) in result.tightenings.iter().zip([0, SEGMENT]) {
        let tightening = &prepared.tightening;
        let kept = start + 14_800..start + 17_799;
        assert_eq!(tightening.torque_nm, recording.torque_nm[kept.clone()]);
        assert_eq!(
            tightening.motion.get(Quantity::Acceleration).unwrap(),
            &measured[kept]
        );
        assert!(tightening.corrections.is_empty(), "nothing is corrected");
        let noise = tightening.noise.as_ref().unwrap();
        assert!(
            (noise.standard_deviation / 0.5 - 1.0).abs() < 0.05,
            "but it is measured"
        );
        // Cumulative trapezoid from the segment's start, written out.
        let inner: f64 = measured[start + 1..start + 14_800].iter().sum();
        let velocity = (inner + 0.5 * (measured[start] + measured[start + 14_800])) * 1e-4;
        assert!((tightening.motion.get(Quantity::Velocity).unwrap()[0] - velocity).abs() < 1e-12);
        let displacement = tightening.motion.get(Quantity::Displacement).unwrap();
        assert!(
            displacement[..1000].contains(&0.0),
            "the offset is one of the first third's samples"
        );
    }
}

#[test]
fn thesis_rejects_what_a_bias_drags_down() {
    // −0.3 rad/s² over 1.48 s: −0.44 rad/s at the window's start, −0.13 rad over the window, twice the true excursion.
    let down = thesis(&recording(&[31], -0.3));
    assert_eq!(down.tightenings[0].rejections(), [Rejection::GoesDown]);
    let up = thesis(&recording(&[31], 0.3));
    assert_eq!(up.tightenings[0].rejections(), vec![]);
    assert!(up.tightenings[0].thesis_checks.unwrap().goes_up);
    assert_eq!(codes(&up.findings), ["goes_up"]);
    assert_eq!(
        snug(&recording(&[31], -0.3)).tightenings[0].rejections(),
        vec![]
    );
}

#[test]
fn thesis_leaves_out_what_is_too_short() {
    let mut recording = recording(&[41], 0.0);
    recording.segments[0].end = 17_799;
    assert_eq!(
        thesis(&recording).tightenings.len(),
        1,
        "17 799 samples suffice for 2999"
    );
    recording.segments[0].end = 17_798;
    assert_eq!(codes(&thesis(&recording).findings), ["truncated_segment"]);
}

#[test]
fn hopeless_recordings_name_every_segment() {
    let clean = recording(&[61, 62], 0.0);
    let mut cases = vec![clean.clone(); 5];
    cases[0].torque_nm.clear();
    cases[1].motion = snug_campaign::Motion::default();
    cases[2].time_base.interval_s = f64::NAN;
    accelerations(&mut cases[3]).fill(f64::NAN);
    cases[4]
        .segments
        .iter_mut()
        .for_each(|segment| std::mem::swap(&mut segment.start, &mut segment.end));
    let expected = [
        "missing_channel",
        "missing_channel",
        "bad_sample_interval",
        "gap",
        "truncated_segment",
    ];
    for (recording, expected) in cases.iter().zip(expected) {
        let result = snug(recording);
        assert_eq!(codes(&result.findings), [expected, expected]);
        assert_eq!(result.findings[1].tightening, Some(2));
        assert!(result.tightenings.is_empty());
        assert_eq!(thesis(recording).tightenings.len(), 0);
    }
    let mut empty = clean;
    empty.segments.clear();
    assert_eq!(codes(&snug(&empty).findings), ["no_segments"]);
}

#[test]
fn a_noise_free_simulation_has_no_floor_and_no_false_findings() {
    let mut recording = recording(&[71], 0.0);
    recording.torque_nm = pulse(30.0);
    recording.motion.acceleration_rad_per_s2 = Some(acceleration(&pulse(30.0)));
    let result = snug(&recording);
    assert_eq!(
        codes(&result.findings),
        ["silent_quiet_part"],
        "{:?}",
        result.findings
    );
    assert!(result.tightenings[0].tightening.noise.is_none());
    assert!(result.tightenings[0].tightening.onset.unwrap() + 14_800 < PEAK);
}

#[test]
fn the_inertia_follows_the_force_channel() {
    let mut recording = recording(&[81], 0.0);
    recording.has_force_channel = false;
    assert_eq!(
        snug(&recording).tightenings[0]
            .tightening
            .rig
            .known_inertia_kg_m2,
        0.15
    );
}
