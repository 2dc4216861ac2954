//! Declared places of JSON files: lists, lists of objects, tables, gaps, and what is no JSON.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::layout::Layout as _;
use snug_campaign::{Finding, Recording};

fn read(
    content: &str,
    input: &str,
    sampling: &str,
) -> Result<(Recording, Vec<Finding>), IngestError> {
    let text = format!(
        "(channels: [(path: {input}, signal: Torque, unit: NewtonMetre), (path: \"w\", signal: Velocity, unit: RadianPerSecond)], \
         sampling: {sampling})"
    );
    let layout: JsonLayout = ron::from_str(&text).unwrap();
    layout.check()?;
    let mut content = std::io::Cursor::new(content.as_bytes().to_vec());
    let mut ingested = layout.read(&mut content, "a.json".as_ref(), 0.5, &Budget::new(Some(64)))?;
    Ok((ingested.recordings.remove(0), ingested.findings))
}

const RATE: &str = "Rate(hz: 100.0)";

#[test]
fn every_kind_of_place_is_read() {
    for (content, input) in [
        (r#"{"w": [1, 2, 3], "t": [0.1, 2, -3e0]}"#, r#""t""#),
        (
            r#"{"a b": [{"no": 1}, {"graph": {"t.x": [0.1, 2, -3], "u": 1}}], "w": [1, 2, 3]}"#,
            r#""a b[1].graph[\"t.x\"]""#,
        ),
        (
            r#"{"w": [1, 2, 3], "s": [{"t": 0.1, "x": [[[[1]]]]}, {"t": "2"}, {"t": -3}]}"#,
            r#""s[].t""#,
        ),
        (
            r#"{"w": [1, 2, 3], "s": [[9, 0.1], [9, 2], [9, -3]]}"#,
            r#""s", part: Column(1)"#,
        ),
        (
            r#"{"w": [1, 2, 3], "s": [[9, 9, 9], [0.1, 2, -3]]}"#,
            r#""s", part: Row(1)"#,
        ),
        (
            r#"{"w": [1, 2, 3], "s": [[9, 9, 9], [0.1, 2, -3]]}"#,
            r#""s[1]""#,
        ),
        (
            "\u{feff}{\"w\": [1, 2, 3], \"t\": [0.1, 2, -3]}\n",
            r#""t""#,
        ),
    ] {
        let (recording, findings) = read(content, input, RATE).unwrap();
        assert_eq!(recording.torque_nm, [0.1, 2.0, -3.0], "{content}");
        assert_eq!(
            recording.motion.velocity_rad_per_s.unwrap(),
            [1.0, 2.0, 3.0]
        );
        assert!(findings.is_empty(), "{findings:?}");
    }
}

#[test]
fn numbers_are_what_was_written() {
    let text = "2.2250738585072011e-308";
    let content = format!(r#"{{"w": [1, 1], "t": [{text}, 0.1]}}"#);
    let (recording, _) = read(&content, r#""t""#, RATE).unwrap();
    assert_eq!(recording.torque_nm, [text.parse().unwrap(), 0.1]);
}

#[test]
fn gaps_stay_gaps_and_are_told() {
    let (recording, findings) =
        read(r#"{"w": [1, 2, 3], "t": [1, null, "off"]}"#, r#""t""#, RATE).unwrap();
    assert!(recording.torque_nm[1].is_nan() && recording.torque_nm[2].is_nan());
    assert!(
        findings[0]
            .message
            .starts_with("2 of 3 values are no numbers")
    );
    let (recording, findings) = read(r#"{"w": [1, 2, 3], "t": [1, 2]}"#, r#""t""#, RATE).unwrap();
    assert_eq!(
        (recording.torque_nm.len(), findings[0].code.as_str()),
        (2, "unequal_lengths")
    );
}

#[test]
fn times_stand_in_the_file() {
    let content = r#"{"w": [1, 2, 3], "t": [1, 2, 3], "ms": [0, 2, 4], "fs": 250}"#;
    let interval_s = |sampling| {
        read(content, r#""t""#, sampling)
            .unwrap()
            .0
            .time_base
            .interval_s
    };
    assert!((interval_s(r#"Times(path: "ms", unit: Millisecond)"#) - 0.002).abs() < 1e-15);
    assert_eq!(interval_s(r#"RateAt(path: "fs")"#), 0.004);
}

#[test]
fn what_cannot_be_read_says_why() {
    for (content, input, expected) in [
        (
            r#"{"w": [1], "run": {"torque": [1]}}"#,
            r#""run.torqe""#,
            "did you mean `run.torque`",
        ),
        (
            r#"{"w": [1], "runs": [{"t": [1]}]}"#,
            r#""runs[1].t""#,
            "the file holds runs[0]",
        ),
        (r#"{"w": [1], "t": {"v": [1]}}"#, r#""t""#, "t is an object"),
        (
            r#"{"w": [1], "t": [[1, 2], [3]]}"#,
            r#""t""#,
            "lists of different lengths",
        ),
        (
            r#"{"w": [1], "t": [[1, 2], 3]}"#,
            r#""t""#,
            "a list of numbers and lists",
        ),
        (
            r#"{"w": [1], "t": [1, [3]]}"#,
            r#""t""#,
            "a list of numbers and lists",
        ),
        (
            r#"{"w": [1], "t": [[[1]]]}"#,
            r#""t""#,
            "a list of lists of lists",
        ),
        (
            r#"{"w": [1], "t": [[1, 2], [3, 4]]}"#,
            r#""t""#,
            "a list of 2 lists of 2 numbers, of which no row or column",
        ),
        (
            r#"{"w": [1], "t": [null, "x"]}"#,
            r#""t""#,
            "without any number in 2 values",
        ),
        (r#"{"w": [1], "t": []}"#, r#""t""#, "a list of 0 numbers"),
        (
            "{\"w\": [1],\n \"t\": [1, NaN]}",
            r#""t""#,
            "line 2, column 11: no JSON: NaN is no number in JSON",
        ),
        (
            r#"{"w": [1], "t": [1"#,
            r#""t""#,
            "line 1, column 18: no JSON: EOF while parsing a list",
        ),
        (r#"{"w": [1], "t": [1]} x"#, r#""t""#, "trailing characters"),
        (" \n", r#""t""#, "the file is empty"),
        ("{\"w\": \u{0}}", r#""t""#, "byte 6 is zero"),
    ] {
        let told = read(content, input, RATE).unwrap_err().to_string();
        assert!(told.contains(expected), "{content}: {told}");
    }
}

#[test]
fn depth_and_size_are_bounded() {
    let nested = format!(
        r#"{{"x": {}1{}, "w": [1], "t": [1]}}"#,
        "[".repeat(100_000),
        "]".repeat(100_000)
    );
    assert!(
        read(&nested, r#""t""#, RATE).is_ok(),
        "what is not wanted may be as deep as it likes"
    );
    assert!(read(&nested, r#""x""#, RATE).is_err());
    let long = format!(r#"{{"w": [1], "t": [{}1]}}"#, "1,".repeat(6_000_000));
    let told = read(&long, r#""t""#, RATE).unwrap_err().to_string();
    assert!(told.contains("source.memory_mb"), "{told}");
}
