//! Whole campaigns and rigs as people measure them, against what SciPy and NumPy read.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use serde_json::Value as Json;
use snug_campaign::{Recording, Severity};
use snug_ingest::csv::{Column, CsvChannel, CsvLayout, Sampling, TimeUnit};
use snug_ingest::{Format, Ingested, Range, Signal, Source, Unit, list, read};
use std::path::{Path, PathBuf};

fn folder(variable: &str) -> Option<PathBuf> {
    let folder = std::env::var_os(variable).map(PathBuf::from);
    if folder.is_none() {
        eprintln!("skipped: {variable} is not set");
    }
    folder
}

fn table(name: &str) -> Json {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name);
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn numbers(node: &Json) -> Vec<f64> {
    node.as_array()
        .unwrap()
        .iter()
        .map(|item| item.as_f64().unwrap())
        .collect()
}

/// First samples bit for bit; the sum as far as the order of additions allows.
fn check_channel(samples: &[f64], node: &Json, place: &str) {
    assert_eq!(
        samples.len() as u64,
        node["length"].as_u64().unwrap(),
        "{place}: length"
    );
    let first = numbers(&node["first"]);
    assert_eq!(samples[..first.len()], first, "{place}: first samples");
    let at = node["index"].as_u64().unwrap() as usize;
    assert_eq!(
        samples[at],
        node["value"].as_f64().unwrap(),
        "{place}: sample {at}"
    );
    let scale: f64 = samples.iter().map(|sample| sample.abs()).sum();
    let sum: f64 = samples.iter().sum();
    assert!(
        (sum - node["sum"].as_f64().unwrap()).abs() <= 1e-12 * scale,
        "{place}: sum"
    );
}

#[test]
fn practice_campaigns() {
    let Some(practice) = folder("SNUG_PRACTICE") else {
        return;
    };
    let expected = table("practice_expected.json");
    for (campaign, files) in expected.as_object().unwrap() {
        let source = Source::default();
        let listing = list(&source, &practice.join(campaign)).unwrap();
        assert!(listing.findings.is_empty(), "{:?}", listing.findings);
        assert_eq!(listing.files.len(), files.as_object().unwrap().len());
        for path in &listing.files {
            let Ingested {
                recordings,
                findings,
            } = read(&source, path, 0.33).unwrap();
            let recording = &recordings[0];
            let node = &files[&recording.file];
            let place = format!("{campaign}/{}", recording.file);
            assert!(findings.is_empty(), "{place}: {findings:?}");
            check_recording(recording, node, &place);
        }
    }
}

fn check_recording(recording: &Recording, node: &Json, place: &str) {
    assert_eq!(recording.label, node["label"].as_str().unwrap(), "{place}");
    check_channel(&recording.torque_nm, &node["torque"], place);
    let acceleration = recording.motion.acceleration_rad_per_s2.as_ref().unwrap();
    check_channel(acceleration, &node["acceleration"], place);
    assert_eq!(
        recording.has_force_channel,
        !node["force"].is_null(),
        "{place}"
    );
    if let Some(force) = &recording.grip_force_n {
        check_channel(force, &node["force"], place);
    }
    let ends: Vec<usize> = recording
        .segments
        .iter()
        .map(|segment| segment.end)
        .collect();
    let expected: Vec<usize> = numbers(&node["ends"])
        .iter()
        .map(|&end| end as usize)
        .collect();
    assert_eq!(ends, expected, "{place}: segments");
    let parts: Vec<&str> = recording.label.split('_').collect();
    let conditions = &recording.conditions;
    let read = [
        &conditions.participant,
        &conditions.strategy,
        &conditions.joint,
    ];
    assert_eq!(
        read.map(|part| part.as_deref().unwrap()),
        parts[..3],
        "{place}: conditions"
    );
    assert_eq!(
        conditions.pace_per_min,
        parts[3].parse().ok(),
        "{place}: pace"
    );
    assert_eq!(recording.time_base.interval_s, 1e-4, "{place}");
}

fn channel(column: &str, signal: Signal, unit: Unit) -> CsvChannel {
    CsvChannel {
        column: Column::Name(column.to_owned()),
        signal,
        unit,
        scale: 1.0,
    }
}

#[test]
fn silverbox_with_its_benchmark_ranges() {
    let Some(data) = folder("SNUG_DATA") else {
        return;
    };
    let range = |name: &str, start, end| Range {
        name: name.to_owned(),
        start,
        end,
    };
    let layout = CsvLayout {
        channels: vec![
            channel("V1", Signal::Torque, Unit::One),
            channel("V2", Signal::Displacement, Unit::One),
        ],
        sampling: Sampling::Rate { hz: 610.351_562_5 },
        ranges: vec![
            range("multisine", 40_650, 127_400),
            range("arrow", 100, 40_575),
        ],
        ..CsvLayout::default()
    };
    for (file, node) in table("csv_expected.json")["silverbox"].as_object().unwrap() {
        let source = Source {
            format: Format::Csv(layout.clone()),
            files: vec![file.clone()],
            ..Source::default()
        };
        source.check().unwrap();
        let path = &list(&source, &data.join("silverbox")).unwrap().files[0];
        let Ingested {
            recordings,
            findings,
        } = read(&source, path, 1.0).unwrap();
        assert!(findings.is_empty(), "{file}: {findings:?}");
        check_channel(&recordings[0].torque_nm, &node["V1"], file);
        check_channel(
            recordings[0].motion.displacement_rad.as_ref().unwrap(),
            &node["V2"],
            file,
        );
        let segments = &recordings[0].segments;
        assert_eq!((segments[0].start, segments[0].end), (40_650, 127_400));
        assert_eq!(
            (segments[1].number, segments[1].start, segments[1].end),
            (2, 100, 40_575)
        );
    }
}

#[test]
fn pendulum_runs_uniform_and_with_gaps() {
    let Some(data) = folder("SNUG_DATA") else {
        return;
    };
    let source = Source {
        format: Format::Csv(CsvLayout {
            channels: vec![
                channel("torque", Signal::Torque, Unit::NewtonMetre),
                channel("position", Signal::Displacement, Unit::Radian),
                channel("velocity", Signal::Velocity, Unit::RadianPerSecond),
            ],
            sampling: Sampling::TimeColumn {
                column: Column::Name("time".to_owned()),
                unit: TimeUnit::Second,
                tolerance_ratio: 0.1,
            },
            ..CsvLayout::default()
        }),
        ..Source::default()
    };
    let expected = table("csv_expected.json");
    for (file, node) in expected["pendulum"].as_object().unwrap() {
        let path = data.join("pendulum-torque").join(file);
        let Ingested {
            recordings,
            findings,
        } = read(&source, &path, 0.5).unwrap();
        let recording = &recordings[0];
        let interval = node["interval_s"].as_f64().unwrap();
        assert!(
            (recording.time_base.interval_s / interval - 1.0).abs() < 1e-12,
            "{file}"
        );
        let gap = node["gap_s"].as_f64();
        assert_eq!(
            findings.len(),
            usize::from(gap.is_some()),
            "{file}: {findings:?}"
        );
        for (name, samples) in [
            ("torque", &recording.torque_nm),
            (
                "position",
                recording.motion.displacement_rad.as_ref().unwrap(),
            ),
            (
                "velocity",
                recording.motion.velocity_rad_per_s.as_ref().unwrap(),
            ),
        ] {
            if let Some(gap) = gap {
                assert_eq!(findings[0].severity, Severity::Repaired);
                assert!(
                    findings[0]
                        .message
                        .contains(&format!("{:.3} ms", 1e3 * gap)),
                    "{}",
                    findings[0].message
                );
                check_resampled(samples, &node[name], &format!("{file} {name}"));
            } else {
                check_channel(samples, &node[name], &format!("{file} {name}"));
            }
        }
    }
}

/// Against NumPy's `interp` on the same grid; only rounding differs.
fn check_resampled(samples: &[f64], node: &Json, place: &str) {
    assert_eq!(
        samples.len() as u64,
        node["length"].as_u64().unwrap(),
        "{place}: length"
    );
    let step = node["step"].as_u64().unwrap() as usize;
    for (read, expected) in samples.iter().step_by(step).zip(numbers(&node["every"])) {
        assert!(
            (read - expected).abs() < 1e-9,
            "{place}: {read} is not {expected}"
        );
    }
}
