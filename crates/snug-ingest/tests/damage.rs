//! What damage costs: the variable it is in, if one can do without; the file, if not; nothing, if nobody asks for it.
#![allow(clippy::unwrap_used)]

mod level5;

use level5::{array, deflated, doubles, element, file, text};
use snug_campaign::Severity;
use snug_ingest::mat::{MatFile, MatSelection};
use snug_ingest::{IngestError, Ingested, Source, read};

const SAMPLES: [f64; 4] = [0.0, 1.0, 2.0, 3.0];

/// Three variables that make a recording, and those that a test is about.
fn with(others: &[Vec<u8>]) -> Vec<u8> {
    let mut elements = vec![
        doubles("angle_acc_Acc_FIR150", &SAMPLES),
        deflated(&doubles("Inline_Torque", &SAMPLES)),
        text("File_name", "TP3_QS_Soft_8"),
    ];
    elements.extend_from_slice(others);
    file(&elements)
}

fn ingest(bytes: &[u8]) -> Result<Ingested, IngestError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.mat");
    std::fs::write(&path, bytes).unwrap();
    read(&Source::default(), &path, 0.33)
}

/// A column that is said to be longer than it is.
fn short(name: &str) -> Vec<u8> {
    array(6, &[9, 1], name, &[element(9, &[0; 16])])
}

/// A compressed column whose checksum is wrong.
fn torn(name: &str) -> Vec<u8> {
    let many: Vec<f64> = (0..5000).map(f64::from).collect();
    let mut bytes = deflated(&doubles(name, &many));
    *bytes.last_mut().unwrap() ^= 0x55;
    bytes
}

#[test]
fn nothing_where_nobody_asks() {
    for damaged in [short("Camera"), torn("Camera"), deflated(&short("Camera"))] {
        let ingested = ingest(&with(std::slice::from_ref(&damaged))).unwrap();
        let codes: Vec<&str> = ingested.findings.iter().map(|f| f.code.as_str()).collect();
        assert_eq!(codes, ["no_events"]);
        assert_eq!(ingested.recordings[0].torque_nm, SAMPLES);
        assert!(MatFile::from_bytes(with(&[damaged])).is_err(), "whole");
    }
}

#[test]
fn itself_where_one_can_do_without() {
    for damaged in [short("F_op_J"), torn("F_op_J")] {
        let ingested = ingest(&with(&[damaged])).unwrap();
        let recording = &ingested.recordings[0];
        assert!(recording.has_force_channel && recording.grip_force_n.is_none());
        assert_eq!(recording.grip_force_channel.as_deref(), Some("F_op_J"));
        let finding = &ingested.findings[0];
        assert_eq!(
            (
                finding.severity,
                finding.code.as_str(),
                finding.channel.as_deref()
            ),
            (Severity::LeftOut, "unusable_channel", Some("F_op_J"))
        );
    }
    let ingested = ingest(&with(&[torn("Sample_rate")])).unwrap();
    assert_eq!(ingested.findings[0].code, "sample_rate_unusable");
    assert_eq!(ingested.recordings[0].time_base.interval_s, 1e-4);

    let elements = [
        doubles("angle_acc_Acc_FIR150", &SAMPLES),
        doubles("Inline_Torque", &SAMPLES),
        torn("File_name"),
    ];
    let ingested = ingest(&file(&elements)).unwrap();
    assert!(ingested.findings.iter().any(|f| f.code == "label_unusable"));
    assert_eq!(ingested.recordings[0].label, "x");
}

#[test]
fn the_file_where_it_is_needed() {
    for damage in [short, torn] {
        let finding = ingest(&with(&[damage("Events")])).unwrap_err().finding();
        assert_eq!(finding.code, "unusable_events", "{}", finding.message);
        let elements = [doubles("angle_acc_Acc_FIR150", &SAMPLES), damage("Inline")];
        let finding = ingest(&file(&elements)).unwrap_err().finding();
        assert_eq!(finding.code, "unusable_channel");
        assert_eq!(finding.channel.as_deref(), Some("Inline"));
    }
}

#[test]
fn the_file_where_nobody_can_tell_what_follows() {
    let whole = with(&[doubles("Camera", &SAMPLES), doubles("Events", &SAMPLES)]);
    let error = ingest(&whole[..whole.len() - 8]).unwrap_err();
    assert!(error.to_string().contains("bytes, but"), "{error}");

    // Where the name is cannot be told, so it may be the events'.
    let mut nameless = deflated(&doubles("Camera", &SAMPLES));
    nameless[12] ^= 0xFF;
    assert_eq!(
        ingest(&with(&[nameless])).unwrap_err().code(),
        "unreadable_file"
    );
}

#[test]
fn of_a_selection_all_names_are_known() {
    let bytes = with(&[torn("F_op_J"), doubles("Camera", &SAMPLES)]);
    let wanted = |name: &str| ["Inline_Torque", "F_op_J"].contains(&name);
    let selection = MatSelection::read(&mut std::io::Cursor::new(bytes), &wanted).unwrap();
    assert_eq!(
        selection.present,
        [
            "angle_acc_Acc_FIR150",
            "Inline_Torque",
            "File_name",
            "F_op_J",
            "Camera"
        ]
    );
    let names: Vec<&str> = selection
        .variables
        .iter()
        .map(|v| v.name.as_str())
        .collect();
    assert_eq!(names, ["Inline_Torque"]);
    assert_eq!(selection.unreadable[0].name, "F_op_J");
}
