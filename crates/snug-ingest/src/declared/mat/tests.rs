//! Declared variables of MAT files: structs, rows and columns, sparse matrices, and what is not there.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::layout::Layout as _;
use crate::mat::{Field, MatFormat, Numbers, UnreadableVariable, Variable};
use snug_campaign::{Finding, Recording};

fn value(dims: &[usize], content: Content) -> Value {
    let dims = dims.to_vec();
    Value { dims, content }
}

fn doubles(dims: &[usize], numbers: &[f64]) -> Value {
    let real = Numbers::F64(numbers.to_vec());
    let imaginary = None;
    value(dims, Content::Numeric { real, imaginary })
}

fn structure(fields: &[(&str, Vec<Value>)]) -> Value {
    let count = fields[0].1.len();
    let fields = fields.iter().map(|(name, values)| Field {
        name: (*name).to_owned(),
        values: values.clone(),
    });
    let fields = fields.collect();
    let class_name = None;
    value(&[1, count], Content::Struct { class_name, fields })
}

/// A file with everything; `broken` is damaged.
fn file() -> MatSelection {
    let inner = structure(&[("torque", vec![doubles(&[1, 3], &[1.0, 2.0, 3.0])])]);
    let sparse = Content::Sparse(Sparse {
        rows: vec![0, 2],
        columns: vec![0, 0],
        real: vec![1.0, 1.0],
        imaginary: None,
        logical: true,
    });
    let runs = (
        "w",
        vec![doubles(&[1, 1], &[5.0]), doubles(&[1, 1], &[6.0])],
    );
    let variables = [
        ("row", doubles(&[1, 3], &[10.0, 20.0, 30.0])),
        ("table", doubles(&[3, 2], &[0.1, 0.2, 0.3, 7.0, 8.0, 9.0])),
        ("run", structure(&[("graph", vec![inner])])),
        ("runs", structure(&[runs])),
        ("brake", value(&[3, 1], sparse)),
        (
            "cells",
            value(
                &[1, 1],
                Content::Cell(vec![doubles(&[3, 1], &[4.0, 5.0, 6.0])]),
            ),
        ),
        ("deep", doubles(&[1, 1, 3], &[1.0, 1.5, 2.0])),
        (
            "text",
            value(&[1, 3], Content::Text("abc".chars().collect())),
        ),
        ("fs", doubles(&[1, 1], &[500.0])),
        ("none", doubles(&[0, 0], &[])),
    ];
    let variables: Vec<Variable> = (variables.into_iter())
        .map(|(name, value)| Variable {
            name: name.to_owned(),
            global: false,
            value,
        })
        .collect();
    let mut present: Vec<String> = variables.iter().map(|one| one.name.clone()).collect();
    present.push("broken".to_owned());
    MatSelection {
        format: MatFormat::Level5,
        variables,
        present,
        unreadable: vec![UnreadableVariable {
            name: "broken".to_owned(),
            reason: IngestError::SparseParts { offset: 7 },
        }],
    }
}

/// The layout with an input at one place and a speed at another, and what the file gives by it.
fn read(input: &str, motion: &str) -> Result<(Recording, Vec<Finding>), IngestError> {
    read_all(
        &format!(
            "(path: {input}, signal: Torque, unit: NewtonMetre), (path: {motion}, signal: Velocity, unit: RadianPerSecond)"
        ),
        "Rate(hz: 100.0)",
    )
}

fn read_all(channels: &str, sampling: &str) -> Result<(Recording, Vec<Finding>), IngestError> {
    let text = format!("(channels: [{channels}], sampling: {sampling})");
    let layout: MatLayout = ron::from_str(&text).unwrap();
    layout.check()?;
    let (file, budget) = (file(), Budget::new(None));
    let wanted = layout.0.wanted();
    let found = wanted
        .iter()
        .map(|one| samples(&file, one, &budget))
        .collect();
    let log = FindingLog::new("a.mat".as_ref());
    let mut ingested = layout
        .0
        .recording(found, "a.mat".as_ref(), 0.5, &budget, log)?;
    Ok((ingested.recordings.remove(0), ingested.findings))
}

#[test]
fn every_kind_of_place_is_read() {
    for (input, expected) in [
        (r#""row""#, [10.0, 20.0, 30.0]),
        (r#""table", part: Column(1)"#, [7.0, 8.0, 9.0]),
        (r#""run.graph.torque""#, [1.0, 2.0, 3.0]),
        (r#""run[0].graph.torque""#, [1.0, 2.0, 3.0]),
        (r#""brake""#, [1.0, 0.0, 1.0]),
        (r#""cells[0]""#, [4.0, 5.0, 6.0]),
        (r#""deep""#, [1.0, 1.5, 2.0]),
    ] {
        let (recording, findings) = read(input, r#""table", part: Column(0)"#).unwrap();
        assert_eq!(recording.torque_nm, expected, "{input}");
        assert_eq!(
            recording.motion.velocity_rad_per_s.unwrap(),
            [0.1, 0.2, 0.3]
        );
        assert!(findings.is_empty(), "{findings:?}");
    }
    let (recording, _) = read(r#""runs[].w""#, r#""table", part: Row(2)"#).unwrap();
    assert_eq!(recording.torque_nm, [5.0, 6.0]);
    assert_eq!(recording.motion.velocity_rad_per_s.unwrap(), [0.3, 9.0]);
}

#[test]
fn what_is_not_there_is_named_with_what_is() {
    for (input, expected) in [
        (r#""tabel", part: Column(1)"#, "did you mean `table`"),
        (r#""run.graph.torqe""#, "did you mean `run.graph.torque`"),
        (r#""run.Graph.torque""#, "run.graph"),
        (r#""runs.w""#, "runs[0], runs[1]"),
        (r#""runs[2].w""#, "runs[0], runs[1]"),
        (r#""row.x""#, "row (1×3 double)"),
        (
            r#""table""#,
            "3×2 double, of which no row or column is declared",
        ),
        (
            r#""table", part: Column(2)"#,
            "3×2 double, which has no column 2",
        ),
        (r#""text""#, "is 1×3 char; expected"),
        (r#""none""#, "is 0×0 double; expected"),
        (r#""broken""#, "is damaged (the parts of the sparse matrix"),
        (r#""runs[1]""#, "runs[1].w"),
        (
            r#""a..b""#,
            "source setting channels.path is a..b; allowed: names between points",
        ),
        (
            r#""run(2).torque""#,
            "counted from 0: MATLAB's run(2).torque is run[1].torque",
        ),
    ] {
        let told = read(input, r#""row""#).unwrap_err().to_string();
        assert!(told.contains(expected), "{input}: {told}");
    }
}

/// Only the input and one motion are needed.
#[test]
fn one_bad_variable_costs_that_variable() {
    let speed = r#"(path: "row", signal: Velocity, unit: RevolutionPerMinute)"#;
    let broken = r#"(path: "broken", signal: Displacement, unit: Radian)"#;
    let input = r#"(path: "deep", signal: Torque, unit: NewtonMetre)"#;
    let (recording, findings) =
        read_all(&format!("{broken}, {speed}, {input}"), "Rate(hz: 100.0)").unwrap();
    assert!(
        recording.motion.displacement_rad.is_none()
            && recording.motion.velocity_rad_per_s.is_some()
    );
    assert_eq!(findings.len(), 1);
    assert_eq!(
        (findings[0].code.as_str(), findings[0].channel.as_deref()),
        ("unusable_channel", Some("broken"))
    );
    assert!(read_all(&format!("{broken}, {input}"), "Rate(hz: 100.0)").is_err());
}

#[test]
fn times_and_rates_stand_in_the_file() {
    let channels = r#"(path: "row", signal: Velocity, unit: RadianPerSecond), (path: "deep", signal: Torque, unit: NewtonMetre)"#;
    let interval_s = |sampling| {
        read_all(channels, sampling).map(|(recording, _)| recording.time_base.interval_s)
    };
    assert_eq!(interval_s(r#"RateAt(path: "fs")"#).unwrap(), 0.002);
    let times = r#"Times(path: "table", part: Column(1), unit: Millisecond)"#;
    assert!((interval_s(times).unwrap() - 1e-3).abs() < 1e-12);
    let told = interval_s(r#"RateAt(path: "row")"#)
        .unwrap_err()
        .to_string();
    assert_eq!(
        told,
        "the sample rate row is 3 numbers; expected one positive number"
    );
}
