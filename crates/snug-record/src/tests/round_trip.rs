//! What is recorded comes back bit for bit, as windows and as whole files, and thinned as the settings say.

use super::{INTERVAL_S, bits, noise, record, small_chunks, tightenings};
use crate::read::{Completeness, Extent, numeric_channels, recordings};
use crate::recorder::Recorder;
use crate::settings::{Compression, RecordSettings, Samples};
use crate::topic;
use snug_campaign::*;

#[test]
fn windows_come_back_bit_for_bit() {
    for compression in [Compression::Zstd, Compression::Lz4, Compression::Off] {
        let bytes = record(RecordSettings {
            compression,
            ..small_chunks()
        });
        let campaign = recordings(&bytes).unwrap();
        assert_eq!(campaign.completeness, Completeness::Complete);
        assert_eq!(campaign.malformed_messages, 0);
        assert_eq!(
            campaign.study_ron.as_deref(),
            Some("(title: \"round trip\")")
        );
        assert_eq!(campaign.files.len(), 2);
        for (index, (result, traces)) in tightenings().iter().enumerate() {
            let window = &campaign.windows[index];
            assert_eq!(window.number, result.id.number);
            assert_eq!(window.onset, Some(17));
            assert_eq!(window.noise, result.noise);
            assert_eq!(window.corrections, result.corrections);
            assert_eq!(window.time_base, traces.time_base);
            assert_eq!(window.rig, result.rig);
            let file = &campaign.files[index % 2];
            assert_eq!(file.extent, Extent::Windows { stored_every: 1 });
            let recording = &file.recording;
            assert_eq!(recording.file, result.id.file);
            assert_eq!(recording.conditions, result.conditions);
            let segment = &recording.segments[index / 2];
            assert_eq!(segment.number, result.id.number);
            let range = segment.start..segment.end;
            assert_eq!(
                bits(&recording.torque_nm[range.clone()]),
                bits(&traces.torque_nm)
            );
            for quantity in [
                Quantity::Displacement,
                Quantity::Velocity,
                Quantity::Acceleration,
            ] {
                assert_eq!(
                    recording
                        .motion
                        .get(quantity)
                        .map(|s| bits(&s[range.clone()])),
                    traces.measured.get(quantity).map(bits)
                );
            }
            assert_eq!(
                recording
                    .grip_force_n
                    .as_ref()
                    .map(|s| bits(&s[range.clone()])),
                traces.grip_force_n.as_deref().map(bits)
            );
        }
    }
}

#[test]
fn the_same_calls_give_the_same_bytes() {
    assert_eq!(record(small_chunks()), record(small_chunks()));
}

/// Reads the samples through the file's own descriptor, as a viewer does.
#[test]
fn viewers_find_every_signal() {
    let bytes = record(RecordSettings::default());
    let channels = numeric_channels(&bytes).unwrap();
    assert!(channels.unreadable.is_empty(), "{:?}", channels.unreadable);
    let signal = |field: &str| channels.channel(topic::SIGNALS, field).unwrap();
    let all = tightenings();
    let first = &all[0].1;
    let single = |samples: &[f64]| -> Vec<f64> {
        samples
            .iter()
            .map(|&sample| f64::from(sample as f32))
            .collect()
    };
    let motion = |motion: &Motion| motion.displacement_rad.clone().unwrap();
    let expected = [
        (
            "simulated.displacement_rad",
            single(&motion(&first.simulated)),
        ),
        (
            "simulated.euler_displacement_rad",
            single(&first.euler_displacement_rad),
        ),
        ("forces.force_f1_n", single(&first.force_f1_n)),
        ("forces.force_f3_n", single(&first.force_f3_n)),
        ("forces.grip_force_n", first.grip_force_n.clone().unwrap()),
        ("measured.displacement_rad", motion(&first.measured)),
        (
            "before.acceleration_rad_per_s2",
            single(first.before.acceleration_rad_per_s2.as_ref().unwrap()),
        ),
        (
            "residual.displacement_rad",
            motion(&first.measured)
                .iter()
                .zip(&motion(&first.simulated))
                .map(|(measured, simulated)| f64::from((measured - simulated) as f32))
                .collect(),
        ),
    ];
    for (field, wanted) in expected {
        assert_eq!(bits(&signal(field).values[..120]), bits(&wanted), "{field}");
    }
    assert!(
        signal("forces.force_f2_n")
            .values
            .iter()
            .all(|v| v.is_nan())
    );
    assert!(
        signal("measured.velocity_rad_per_s")
            .values
            .iter()
            .all(|v| v.is_nan())
    );
    // Six windows of 12 ms with gaps of 200 ms, each 0.1 ms per sample.
    let times = &signal("measured.torque_nm").log_time_s;
    for (index, time_s) in times.iter().enumerate() {
        let expected = (index / 120) as f64 * 0.212 + (index % 120) as f64 * INTERVAL_S;
        assert!(
            (time_s - expected).abs() < 1e-9,
            "sample {index}: {time_s} s"
        );
    }
    assert_eq!(signal("time_since_onset_s").values[17], 0.0);
    assert!((signal("time_s").values[119] - 1.4919).abs() < 1e-12);
    assert_eq!(signal("tightening").values[120], 2.0);
}

#[test]
fn whole_measurement_files_come_back_bit_for_bit() {
    let measurement = |file: &str, length: usize, force: bool| Recording {
        file: file.into(),
        label: "TP3_QS_Soft_8".into(),
        conditions: Conditions::default(),
        time_base: TimeBase {
            start_s: 0.0,
            interval_s: INTERVAL_S,
        },
        torque_nm: noise(1, length),
        motion: Motion {
            acceleration_rad_per_s2: Some(noise(2, length - 5)),
            ..Motion::default()
        },
        grip_force_n: force.then(|| noise(3, length)),
        has_force_channel: true,
        grip_force_channel: Some("Data1_F_op_J_FIR_Filter_OFFSET".into()),
        segments: vec![Segment {
            number: 1,
            start: 0,
            end: length + 10,
            event_times_s: Some([0.1, 0.2 + 0.1, 0.7]),
        }],
    };
    let kept = [
        measurement("TP3_QS_Soft_8.mat", 4001, true),
        measurement("b.mat", 1600, false),
    ];
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(
        &mut bytes,
        RecordSettings {
            measurement_samples: 5601,
            ..RecordSettings::default()
        },
    )
    .unwrap();
    assert!(recorder.measurement(&kept[0]).unwrap());
    assert!(recorder.measurement(&kept[1]).unwrap());
    assert!(
        !recorder
            .measurement(&measurement("c.mat", 6, true))
            .unwrap()
    );
    for (result, traces) in &tightenings()[..2] {
        recorder.tightening(result, traces, None).unwrap();
    }
    recorder.finish().unwrap();
    let campaign = recordings(&bytes).unwrap();
    let found: Vec<(&Recording, &Extent)> = campaign
        .files
        .iter()
        .map(|file| (&file.recording, &file.extent))
        .collect();
    // The first file is there whole, so its window is not given a second time.
    assert_eq!(found.len(), 3);
    assert_eq!(found[0], (&kept[0], &Extent::Whole));
    assert_eq!(found[1], (&kept[1], &Extent::Whole));
    assert_eq!(found[2].0.file, "TP1_TT_Hard_5.mat");
    assert_eq!(campaign.windows.len(), 2);
}

#[test]
fn long_campaigns_are_thinned_within_the_stated_bound() {
    let settings = RecordSettings {
        samples: Samples::Bounded {
            complete_samples: 200,
            then_at_most: 50,
        },
        ..RecordSettings::default()
    };
    let campaign = recordings(&record(settings)).unwrap();
    let strides: Vec<usize> = campaign.windows.iter().map(|w| w.stored_every).collect();
    // 120 and 240 samples are whole; of the others every third is kept: 40.
    assert_eq!(strides, [1, 1, 3, 3, 3, 3]);
    let file = &campaign.files.last().unwrap();
    assert_eq!(file.extent, Extent::Windows { stored_every: 3 });
    assert_eq!(file.recording.time_base.interval_s, 3.0 * INTERVAL_S);
    let every_third: Vec<u64> = tightenings()[5]
        .1
        .torque_nm
        .iter()
        .step_by(3)
        .map(|sample| sample.to_bits())
        .collect();
    let segment = file.recording.segments.last().unwrap();
    assert_eq!(segment.end - segment.start, 40);
    assert_eq!(
        bits(&file.recording.torque_nm[segment.start..segment.end]),
        every_third
    );
}

#[test]
fn unequal_lengths_and_settings_out_of_range_are_named() {
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(&mut bytes, RecordSettings::default()).unwrap();
    let (result, mut traces) = tightenings().remove(0);
    traces.force_f3_n.pop();
    let error = recorder.tightening(&result, &traces, None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "TP3_QS_Soft_8.mat #1: signal force_f3_n has 119 samples, the torque has 120"
    );
    recorder.finish().unwrap();
    assert!(recordings(&bytes).unwrap().windows.is_empty());
    let settings = RecordSettings {
        gap_s: f64::NAN,
        ..RecordSettings::default()
    };
    let error = Recorder::new(Vec::new(), settings).err().unwrap();
    assert!(error.to_string().contains("gap_s is NaN"), "{error}");
}
