//! MCAP: another program's file (written with the reference Python library) and Snug's own recordings.
#![cfg(feature = "mcap")]
#![allow(clippy::unwrap_used)]

use snug_campaign::{Conditions, Motion, Recording, Segment, TimeBase};
use snug_ingest::mcap::{McapChannel, McapLayout};
use snug_ingest::{Format, Range, Signal, Source, Unit, list, read};
use snug_record::{RecordSettings, Recorder};
use std::path::Path;

fn rig() -> McapLayout {
    let channel = |topic: &str, field: &str, signal, unit, scale| McapChannel {
        topic: topic.to_owned(),
        field: field.to_owned(),
        signal,
        unit,
        scale,
    };
    McapLayout {
        channels: vec![
            channel("/drive", "torque.z", Signal::Torque, Unit::NewtonMetre, 1.0),
            channel(
                "/encoder",
                "angle_deg",
                Signal::Displacement,
                Unit::Degree,
                -1.0,
            ),
        ],
        ranges: vec![Range {
            name: "all".to_owned(),
            start: 0,
            end: 190,
        }],
        ..McapLayout::default()
    }
}

fn source(layout: McapLayout) -> Source {
    let source = Source {
        format: Format::Mcap(layout),
        ..Source::default()
    };
    source.check().unwrap();
    source
}

fn file() -> &'static Path {
    Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/mcap/rig.mcap"
    ))
}

/// Torque 1.5 + 0.25 i Nm at i ms; angle 10 − 0.5 j ° at j ms, measured at j = 0.5, 2.5, …, 198.5.
#[test]
fn channels_with_clocks_of_their_own_are_brought_together() {
    let ingested = read(&source(rig()), file(), 0.5).unwrap();
    let recording = &ingested.recordings[0];
    assert_eq!(ingested.findings.len(), 1);
    assert_eq!(ingested.findings[0].code, "channels_aligned");
    // The encoder covers 0.5 to 198.5 ms, so the drive's samples 1 to 198 remain.
    assert_eq!(recording.torque_nm.len(), 198);
    assert!((recording.time_base.interval_s - 1e-3).abs() < 1e-9);
    let angle = recording.motion.displacement_rad.as_ref().unwrap();
    for (index, (torque, angle)) in recording.torque_nm.iter().zip(angle).enumerate() {
        let millisecond = (index + 1) as f64;
        assert_eq!(*torque, 1.5 + 0.25 * millisecond);
        assert!(
            (angle.to_degrees() + 10.0 - 0.5 * millisecond).abs() < 1e-6,
            "{index}"
        );
    }
    assert_eq!(
        (recording.segments[0].start, recording.segments[0].end),
        (0, 190)
    );
}

#[test]
fn fields_that_are_not_there_are_named_with_those_that_are() {
    let mut layout = rig();
    layout.channels[1].field = "angle".to_owned();
    let finding = read(&source(layout), file(), 0.5).unwrap_err().finding();
    assert_eq!(finding.code, "missing_channel");
    assert!(
        finding.message.contains("/encoder angle_deg"),
        "{}",
        finding.message
    );

    let finding = read(&Source::default(), file(), 0.5).unwrap_err().finding();
    assert_eq!(finding.code, "no_data");
    assert!(
        finding.message.contains("/drive torque.z"),
        "{}",
        finding.message
    );
}

fn measurement(file: &str) -> Recording {
    let samples: Vec<f64> = (0..5000)
        .map(|index| (f64::from(index) * 0.01).sin())
        .collect();
    Recording {
        file: file.to_owned(),
        label: "TP3_TT_Hard_8".to_owned(),
        conditions: Conditions {
            participant: Some("TP3".to_owned()),
            ..Conditions::default()
        },
        time_base: TimeBase {
            start_s: 0.0,
            interval_s: 1e-4,
        },
        torque_nm: samples.iter().map(|sample| 20.0 * sample).collect(),
        motion: Motion {
            acceleration_rad_per_s2: Some(samples),
            ..Motion::default()
        },
        grip_force_n: None,
        has_force_channel: false,
        grip_force_channel: None,
        segments: vec![Segment {
            number: 1,
            start: 0,
            end: 5000,
            event_times_s: Some([12.5, 13.0, 13.0001]),
        }],
    }
}

#[test]
fn recordings_of_snug_come_back_as_they_were_even_when_cut() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recording.mcap");
    let originals = [measurement("a.mat"), measurement("b.mat")];
    let mut recorder = Recorder::create(&path, RecordSettings::default()).unwrap();
    for original in &originals {
        assert!(recorder.measurement(original).unwrap());
    }
    recorder.finish().unwrap();

    let source = Source::default();
    let listing = list(&source, folder.path()).unwrap();
    let ingested = read(&source, &listing.files[0], 0.33).unwrap();
    assert_eq!(ingested.recordings, originals);
    assert!(ingested.findings.is_empty(), "{:?}", ingested.findings);

    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let ingested = read(&source, &path, 0.33).unwrap();
    assert_eq!(
        ingested.recordings[0].torque_nm[..100],
        originals[0].torque_nm[..100]
    );
    assert_eq!(ingested.findings[0].code, "file_incomplete");

    std::fs::write(&path, "no mcap at all").unwrap();
    assert_eq!(
        read(&source, &path, 0.33).unwrap_err().code(),
        "unreadable_file"
    );
}
