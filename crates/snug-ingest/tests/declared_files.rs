//! MAT files as SciPy and h5py write them, and JSON as Python does, read by declared places: the same numbers from each.
#![allow(clippy::unwrap_used)]

use snug_campaign::Recording;
use snug_ingest::{Format, IngestError, Source, read};
use std::path::Path;

/// The recording in a file of `tests/data/declared`, by declared channels.
fn recording(file: &str, channels: &str, sampling: &str) -> Result<Recording, IngestError> {
    let kind = if file.ends_with(".json") {
        "Json"
    } else {
        "Mat"
    };
    let extensions = ron::extensions::Extensions::UNWRAP_VARIANT_NEWTYPES;
    let options = ron::Options::default().with_default_extension(extensions);
    let text = format!("{kind}(channels: [{channels}], sampling: {sampling})");
    let format: Format = options.from_str(&text).unwrap();
    let source = Source {
        format,
        ..Source::default()
    };
    source.check().unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/declared");
    let mut ingested = read(&source, &folder.join(file), 0.5)?;
    assert!(ingested.findings.is_empty(), "{:?}", ingested.findings);
    Ok(ingested.recordings.remove(0))
}

#[test]
fn files_of_other_programs_give_their_numbers() {
    let torque: Vec<f64> = (0..8).map(|i| 0.5 * f64::from(i)).collect();
    let speed: Vec<f64> = (0..8).map(|i| 0.1 * f64::from(i) * f64::from(i)).collect();
    // A force at the lever arm of 0.5 m is half a torque.
    let fields = r#"(path: "run.graph.force", signal: Force, unit: Newton, scale: 2), (path: "run.graph.speed", signal: Velocity, unit: RadianPerSecond)"#;
    let columns = r#"(path: "data", part: Column(1), signal: Torque, unit: NewtonMetre), (path: "data", part: Column(2), signal: Velocity, unit: RadianPerSecond)"#;
    for file in ["scipy_rig_v5.mat", "h5py_rig_v73.mat", "python_rig.json"] {
        if cfg!(not(feature = "hdf5")) && file.contains("v73") {
            continue;
        }
        for (channels, sampling) in [
            (fields, r#"RateAt(path: "fs")"#),
            (columns, r#"Times(path: "data", part: Column(0))"#),
        ] {
            let recording = recording(file, channels, sampling).unwrap();
            assert_eq!(recording.torque_nm, torque, "{file}");
            let found = recording.motion.velocity_rad_per_s.unwrap();
            for (found, expected) in found.iter().zip(&speed) {
                assert!((found - expected).abs() < 1e-15, "{file}: {found}");
            }
            assert!(
                (recording.time_base.interval_s - 0.01).abs() < 1e-12,
                "{file}"
            );
        }
    }
}

#[test]
fn sparse_truth_values_and_struct_arrays_are_signals() {
    let brake = r#"(path: "brake", signal: Torque, unit: One), (path: "data", part: Column(3), signal: Displacement, unit: Radian)"#;
    let expected = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    for file in ["scipy_rig_v5.mat", "h5py_rig_v73.mat"] {
        if cfg!(not(feature = "hdf5")) && file.contains("v73") {
            continue;
        }
        let recording = recording(file, brake, "Rate(hz: 100.0)").unwrap();
        assert_eq!(recording.torque_nm, expected, "{file}");
    }
    let array = r#"(path: "runs[1].y", signal: Torque, unit: One), (path: "runs[0].y", signal: Displacement, unit: Radian)"#;
    let recording = recording("scipy_rig_v5.mat", array, "Rate(hz: 100.0)").unwrap();
    assert_eq!(recording.motion.displacement_rad.unwrap()[7], 3.5);
}

#[test]
fn a_typing_error_is_answered_with_what_is_there() {
    let channels = r#"(path: "run.graph.forse", signal: Force, unit: Newton), (path: "run.graph.speed", signal: Velocity, unit: RadianPerSecond)"#;
    for file in ["scipy_rig_v5.mat", "python_rig.json"] {
        let told = recording(file, channels, "Rate(hz: 1.0)")
            .unwrap_err()
            .to_string();
        assert!(
            told.contains(file) && told.contains("did you mean `run.graph.force`"),
            "{told}"
        );
    }
}
