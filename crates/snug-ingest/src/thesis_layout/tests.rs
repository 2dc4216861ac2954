//! Thesis files put together variable by variable: names of channels, event times that are wrong, lengths that differ.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::mat::{MatFormat, Numbers, Variable};
use snug_campaign::{Finding, Severity};

fn vector_of(samples: Vec<f32>) -> Value {
    Value {
        dims: vec![samples.len(), 1],
        content: Content::Numeric {
            real: Numbers::F32(samples),
            imaginary: None,
        },
    }
}

fn text(text: &str) -> Value {
    Value {
        dims: vec![1, text.chars().count()],
        content: Content::Text(text.chars().collect()),
    }
}

fn event_table(times: &[&str]) -> Value {
    let rows = times.len();
    let names = (0..rows).map(|row| text(["Start", "Torque", "Stop"][row % 3]));
    let numbers = (0..rows).map(|row| text(&(row + 1).to_string()));
    Value {
        dims: vec![rows, 3],
        content: Content::Cell(
            numbers
                .chain(names)
                .chain(times.iter().map(|time| text(time)))
                .collect(),
        ),
    }
}

fn mat(variables: Vec<(&str, Value)>) -> MatSelection {
    let mut selection = MatSelection {
        format: MatFormat::Level5,
        variables: Vec::new(),
        present: Vec::new(),
        unreadable: Vec::new(),
    };
    for (name, value) in variables {
        selection.present.push(name.to_owned());
        selection.variables.push(Variable {
            name: name.to_owned(),
            global: false,
            value,
        });
    }
    selection
}

/// 60 samples at 10 Hz, three tightenings of 2 s with gaps in the event clock.
const TIMES: [&str; 9] = [
    "12,5", "13,9", "14,5", "26.5", "27.9", "28.5", "40,50", "41,9", "42,50",
];

fn complete() -> Vec<(&'static str, Value)> {
    vec![
        ("angle_acc_Acc_FIR150", vector_of(vec![1.5; 60])),
        ("Inline", vector_of(vec![2.5; 60])),
        ("Events", event_table(&TIMES)),
        ("File_name", text("TP3_TT_Hard_8")),
    ]
}

fn layout() -> ThesisLayout {
    ThesisLayout {
        sample_rate_hz: 10.0,
        ..ThesisLayout::default()
    }
}

fn read(variables: Vec<(&str, Value)>) -> Result<(Recording, Vec<Finding>), IngestError> {
    let (path, budget) = (Path::new("folder/TP9_QS_Soft_5.mat"), Budget::new(None));
    let mut ingested = layout().within(mat(variables), path, &budget)?;
    Ok((ingested.recordings.remove(0), ingested.findings))
}

fn with(name: &'static str, value: Value) -> Vec<(&'static str, Value)> {
    let mut variables = complete();
    variables.retain(|(other, _)| *other != name);
    variables.push((name, value));
    variables
}

fn places(recording: &Recording) -> Vec<(u32, usize, usize)> {
    recording
        .segments
        .iter()
        .map(|s| (s.number, s.start, s.end))
        .collect()
}

#[test]
fn segments_are_back_to_back_whatever_the_event_clock_says() {
    let (recording, findings) = read(complete()).unwrap();
    assert_eq!(places(&recording), [(1, 0, 20), (2, 20, 40), (3, 40, 60)]);
    assert_eq!(
        recording.segments[1].event_times_s,
        Some([26.5, 27.9, 28.5])
    );
    assert_eq!(recording.label, "TP3_TT_Hard_8");
    assert_eq!(recording.conditions.joint.as_deref(), Some("Hard"));
    assert_eq!(recording.time_base.interval_s, 0.1);
    assert!(!recording.has_force_channel && findings.is_empty());
}

#[test]
fn a_complex_channel_is_called_complex() {
    let complex = Value {
        dims: vec![60, 1],
        content: Content::Numeric {
            real: Numbers::F64(vec![1.0; 60]),
            imaginary: Some(Numbers::F64(vec![0.5; 60])),
        },
    };
    let error = read(vec![
        ("angle_acc_Acc_FIR150", complex),
        ("Inline", vector_of(vec![2.0; 60])),
    ])
    .unwrap_err();
    let text = error.to_string();
    assert!(text.contains("60×1 complex double"), "{text}");
    assert!(text.contains("real vector"), "{text}");
}

#[test]
fn every_channel_name_is_known() {
    for acceleration in ["angle_acc_Acc_FIR150", "Data1_angle_acc_Acc_FIR150"] {
        for torque in ["Inline_Torque", "Inline", "Data1_Inline"] {
            for force in ["F_op_J", "Data1_F_op_J_FIR_Filter_OFFSET"] {
                let (recording, findings) = read(vec![
                    (acceleration, vector_of(vec![1.0; 60])),
                    (torque, vector_of(vec![2.0; 60])),
                    (force, vector_of(vec![3.0; 60])),
                    ("Events", event_table(&TIMES)),
                ])
                .unwrap();
                assert_eq!(recording.torque_nm, [2.0; 60]);
                assert_eq!(
                    recording.motion.acceleration_rad_per_s2.as_deref(),
                    Some(&[1.0; 60][..])
                );
                assert_eq!(recording.grip_force_n.as_deref(), Some(&[3.0; 60][..]));
                assert!(recording.has_force_channel && findings.is_empty());
                assert_eq!(recording.grip_force_channel.as_deref(), Some(force));
                assert_eq!(
                    recording.label, "TP9_QS_Soft_5",
                    "the stem, where the file has no File_name"
                );
            }
        }
    }
}

#[test]
fn a_missing_channel_is_named_with_what_is_there() {
    let mut variables = complete();
    variables.retain(|(name, _)| *name != "Inline");
    variables.push(("Torque_x", vector_of(vec![0.0; 60])));
    let finding = read(variables).unwrap_err().finding();
    assert_eq!(
        (finding.severity, finding.code.as_str()),
        (Severity::LeftOut, "missing_channel")
    );
    for word in ["torque", "Inline_Torque", "Data1_Inline", "Torque_x"] {
        assert!(finding.message.contains(word), "{}", finding.message);
    }
}

#[test]
fn channels_of_the_wrong_kind_are_refused() {
    let square = Value {
        dims: vec![2, 2],
        ..vector_of(vec![1.0; 4])
    };
    for value in [text("12"), square, vector_of(Vec::new())] {
        let error = read(with("Inline", value)).unwrap_err();
        assert_eq!(error.code(), "unusable_channel", "{error}");
    }
}

#[test]
fn nan_stays_and_the_shortest_channel_counts() {
    let mut samples = vec![1.0; 58];
    samples[3] = f32::NAN;
    let (recording, findings) = read(with("Inline", vector_of(samples))).unwrap();
    assert_eq!(recording.torque_nm.len(), 58);
    assert_eq!(recording.motion.acceleration_rad_per_s2.unwrap().len(), 58);
    assert!(recording.torque_nm[3].is_nan());
    assert_eq!(findings[0].code, "unequal_lengths");
    assert!(findings[0].message.contains("60") && findings[0].message.contains("58"));
}

#[test]
fn events_beyond_the_data_keep_their_end() {
    let (recording, findings) = read(vec![
        ("angle_acc_Acc_FIR150", vector_of(vec![1.0; 50])),
        ("Inline", vector_of(vec![1.0; 50])),
        ("Events", event_table(&TIMES)),
    ])
    .unwrap();
    assert_eq!(places(&recording)[2], (3, 40, 60));
    assert_eq!(findings[0].code, "events_and_samples_differ");
}

#[test]
fn one_bad_tightening_leaves_the_others_their_places() {
    for (row, time) in [(3, "abc"), (5, ""), (5, "20,0"), (3, "28,5")] {
        let mut times = TIMES;
        times[row] = time;
        let (recording, findings) = read(with("Events", event_table(&times))).unwrap();
        assert_eq!(places(&recording), [(1, 0, 20), (3, 40, 60)], "{time:?}");
        assert_eq!(findings[0].tightening, Some(2));
        assert_eq!(findings[0].severity, Severity::LeftOut);
        assert!(
            findings[0].message.contains("row"),
            "{}",
            findings[0].message
        );
    }
}

#[test]
fn two_bad_tightenings_hide_what_lies_behind_the_first() {
    let mut times = TIMES;
    times[3] = "?";
    times[8] = "?";
    let (recording, findings) = read(with("Events", event_table(&times))).unwrap();
    assert_eq!(places(&recording), [(1, 0, 20)]);
    assert_eq!(findings.len(), 2);

    times = TIMES;
    times[0] = "?";
    times[3] = "?";
    let (recording, findings) = read(with("Events", event_table(&times))).unwrap();
    assert!(recording.segments.is_empty());
    assert_eq!(findings[2].code, "place_unknown");
}

#[test]
fn a_bad_torque_time_costs_nothing_but_itself() {
    let mut times = TIMES;
    times[4] = "-";
    let (recording, findings) = read(with("Events", event_table(&times))).unwrap();
    assert_eq!(recording.segments.len(), 3);
    assert_eq!(recording.segments[1].event_times_s, None);
    assert!(
        findings[0].message.contains("row 5"),
        "{}",
        findings[0].message
    );
}

#[test]
fn rows_too_many_are_left_out() {
    let mut times = TIMES.to_vec();
    times.push("50");
    let (recording, findings) = read(with("Events", event_table(&times))).unwrap();
    assert_eq!(recording.segments.len(), 3);
    assert_eq!(
        (findings[0].severity, findings[0].code.as_str()),
        (Severity::LeftOut, "event_rows")
    );
}

#[test]
fn numeric_events_and_no_events() {
    let mut numbers = vec![0.0; 6];
    numbers.extend([0.0, 1.0, 3.0]);
    let table = Value {
        dims: vec![3, 3],
        ..vector_of(numbers)
    };
    let (recording, findings) = read(with("Events", table)).unwrap();
    assert_eq!(places(&recording), [(1, 0, 30)]);
    assert_eq!(findings[0].code, "events_and_samples_differ");

    let mut variables = complete();
    variables.retain(|(name, _)| *name != "Events");
    let (recording, findings) = read(variables).unwrap();
    assert_eq!(places(&recording), [(1, 0, 60)]);
    assert_eq!(findings[0].code, "no_events");

    let error = read(with("Events", text("12,5"))).unwrap_err();
    assert_eq!(error.code(), "unusable_events");
}

#[test]
fn the_files_own_rate_counts() {
    let (recording, findings) = read(with("Sample_rate", vector_of(vec![5.0]))).unwrap();
    assert_eq!(recording.time_base.interval_s, 0.2);
    assert_eq!(places(&recording)[0], (1, 0, 10));
    assert_eq!(findings[0].code, "sample_rate_differs");
}
