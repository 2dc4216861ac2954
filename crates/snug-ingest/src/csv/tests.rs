//! CSV dialects, damaged cells and rows, declared columns and times, from text to recording.
#![allow(clippy::unwrap_used)]

use super::*;
use snug_campaign::{Finding, Recording, Severity};

fn channel(column: Column, signal: Signal, unit: Unit) -> CsvChannel {
    CsvChannel {
        column,
        signal,
        unit,
        scale: 1.0,
    }
}

fn named(name: &str) -> Column {
    Column::Name(name.to_owned())
}

/// Torque and angle by name at 100 Hz.
fn layout() -> CsvLayout {
    CsvLayout {
        channels: vec![
            channel(named("M"), Signal::Torque, Unit::NewtonMetre),
            channel(named("phi"), Signal::Displacement, Unit::Degree),
        ],
        sampling: Sampling::Rate { hz: 100.0 },
        ..CsvLayout::default()
    }
}

fn ingested(layout: &CsvLayout, content: &[u8], path: &str) -> Result<Ingested, IngestError> {
    let mut input = std::io::Cursor::new(content.to_vec());
    layout.read(&mut input, Path::new(path), 0.5, &Budget::new(None))
}

fn read(layout: &CsvLayout, content: &[u8]) -> Result<(Recording, Vec<Finding>), IngestError> {
    layout.check()?;
    let mut ingested = ingested(layout, content, "a/run 1.csv")?;
    Ok((ingested.recordings.remove(0), ingested.findings))
}

fn degrees(recording: &Recording) -> Vec<f64> {
    let angles = recording.motion.displacement_rad.as_ref().unwrap();
    angles
        .iter()
        .map(|angle| (angle.to_degrees() * 1e9).round() / 1e9)
        .collect()
}

#[test]
fn every_dialect_gives_the_same_numbers() {
    for content in [
        "M,phi\n1.5,10\n-2,20\n",
        "phi;M\r\n10;1,5\r\n20;-2,0\r\n",
        "\u{feff}phi\tother\tM\n10\tx\t1.5\n20\ty\t-2\n",
        "# made by hand\nM,phi,\n\n1.5,10,\n# between\n-2,20,\n",
        "\"M\" , \"phi\"\n 1.5 , 10 \n -2 , 20\n",
        "m;PHI\nNm;deg\n1,5;1,0e1\n-2;20\n",
    ] {
        let (recording, findings) = read(&layout(), content.as_bytes()).expect(content);
        assert_eq!(recording.torque_nm, [1.5, -2.0], "{content}");
        assert_eq!(degrees(&recording), [10.0, 20.0], "{content}");
        assert!(findings.is_empty(), "{content}: {findings:?}");
        assert_eq!(recording.label, "run 1");
        assert_eq!(recording.segments[0].end, 2);
    }
}

#[test]
fn columns_by_place_with_and_without_a_header() {
    let layout = CsvLayout {
        channels: vec![
            channel(Column::Index(2), Signal::Torque, Unit::NewtonCentimetre),
            channel(
                Column::Index(0),
                Signal::Acceleration,
                Unit::MetrePerSecondSquared,
            ),
        ],
        sampling: Sampling::Rate { hz: 100.0 },
        ..CsvLayout::default()
    };
    for content in ["3,x,150\n4,y,250\n", "a,b,c\n3,x,150\n4,y,250\n"] {
        let (recording, _) = read(&layout, content.as_bytes()).expect(content);
        assert_eq!(recording.torque_nm, [1.5, 2.5], "{content}");
        // a / l with l = 0.5 m
        assert_eq!(
            recording.motion.acceleration_rad_per_s2.unwrap(),
            [6.0, 8.0]
        );
    }
    let header = CsvLayout {
        header: Header::Present,
        ..layout
    };
    let (recording, _) = read(&header, b"3,x,150\n4,y,250\n").unwrap();
    assert_eq!(recording.torque_nm, [2.5]);
}

#[test]
fn cells_that_are_no_numbers_become_nan_and_are_counted() {
    let content = b"M,phi\n1,10\nerr,20\n3\n,40\nNaN,50\n";
    let (recording, findings) = read(&layout(), content).unwrap();
    assert_eq!(
        recording
            .torque_nm
            .iter()
            .filter(|value| value.is_nan())
            .count(),
        3
    );
    assert_eq!(findings.len(), 2);
    assert_eq!(findings[0].channel.as_deref(), Some("M"));
    assert!(
        findings[0].message.contains("2 of 5") && findings[0].message.contains("\"err\" in line 3"),
        "{}",
        findings[0].message
    );
    assert!(findings[1].message.contains("1 of 5") && findings[1].message.contains("line 4"));
}

#[test]
fn missing_columns_are_named_with_those_that_are_there() {
    let error = read(&layout(), b"M;angle\n1;2\n").unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("phi") && message.contains("angle") && message.contains("displacement"),
        "{message}"
    );
    let index = CsvLayout {
        channels: vec![
            channel(Column::Index(0), Signal::Torque, Unit::One),
            channel(Column::Index(5), Signal::Velocity, Unit::One),
        ],
        ..layout()
    };
    assert_eq!(
        read(&index, b"1,2\n3,4\n").unwrap_err().code(),
        "missing_channel"
    );
}

#[test]
fn files_without_data_are_refused() {
    for content in ["", "  \n", "M,phi\n", "M,phi\nx,1\ny,2\n"] {
        let error = read(&layout(), content.as_bytes()).expect_err(content);
        assert!(
            matches!(error.code(), "no_data" | "unusable_channel"),
            "{content:?}: {error}"
        );
    }
}

#[test]
fn what_is_no_text_is_refused_by_its_start() {
    let utf16: Vec<u8> = "M;phi\n1;2\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let error = read(&layout(), &utf16).unwrap_err();
    assert!(
        matches!(error, IngestError::NotText { offset: 1 }),
        "{error}"
    );
}

#[test]
fn rows_without_end_are_refused() {
    for tail in [
        "\"".to_owned() + &"1;2\n".repeat(400_000),
        ";".repeat(3_000_000),
    ] {
        let error = read(&layout(), format!("M;phi\n1;2\n{tail}").as_bytes()).unwrap_err();
        assert!(
            matches!(error, IngestError::RowTooLong { line: 3, .. }),
            "{error}"
        );
    }
}

#[test]
fn rows_that_an_open_quote_swallows_are_said() {
    let (recording, findings) = read(&layout(), b"M;phi\n1;2\n2;\"3\n3;4\n4;5\n").unwrap();
    assert_eq!(recording.torque_nm, [1.0, 2.0]);
    let lost = findings.iter().find(|f| f.code == "quoted_lines").unwrap();
    assert_eq!(lost.severity, Severity::LeftOut);
    assert!(lost.message.starts_with("2 lines"), "{}", lost.message);
    // A remark of two lines is none of them.
    let remark = b"M;phi;remark\n1;2;\"two\nlines\"\n2;3;one\n";
    let (recording, findings) = read(&layout(), remark).unwrap();
    assert_eq!((recording.torque_nm.len(), findings.len()), (2, 0));
}

#[test]
fn messages_show_no_more_than_a_few_words_of_a_file() {
    let long = "x".repeat(100_000);
    let gap = format!("M;phi\n1;{long}\n1;2\n");
    let (_, findings) = read(&layout(), gap.as_bytes()).unwrap();
    assert!(findings[0].message.len() < 300, "{}", findings[0].message);
    let names = format!("M;{}\n1;2\n", [long.as_str(); 9].join(";"));
    let error = read(&layout(), names.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("xxx…") && error.len() < 2000, "{error}");
}

#[test]
fn times_at_the_end_of_all_numbers_give_no_samples() {
    let layout = CsvLayout {
        sampling: Sampling::TimeColumn {
            column: named("t"),
            unit: TimeUnit::Second,
            tolerance_ratio: 0.1,
        },
        ..layout()
    };
    let error = read(&layout, b"t;M;phi\n-1e308;1;2\n1e308;1;2\n").unwrap_err();
    assert_eq!(error.code(), "unusable_time");
}

/// Any clock at all would be even by such a measure.
#[test]
fn an_infinite_tolerance_is_refused() {
    for tolerance_ratio in [f64::INFINITY, f64::NAN, 0.0] {
        let layout = CsvLayout {
            sampling: Sampling::TimeColumn {
                column: named("t"),
                unit: TimeUnit::Second,
                tolerance_ratio,
            },
            ..layout()
        };
        let error = read(&layout, b"t;M;phi\n0;1;2\n1;1;2\n").unwrap_err();
        assert!(
            error.to_string().contains("sampling.tolerance_ratio"),
            "{error}"
        );
    }
}

#[test]
fn times_in_milliseconds_with_a_gap() {
    let layout = CsvLayout {
        sampling: Sampling::TimeColumn {
            column: named("t"),
            unit: TimeUnit::Millisecond,
            tolerance_ratio: 0.1,
        },
        skip_lines: 2,
        ..layout()
    };
    let mut content = "export of 2020\n\nt;M;phi\n".to_owned();
    for sample in (0..40).filter(|sample| *sample != 20) {
        content += &format!("{};{},5;{sample}\n", 100 + 10 * sample, sample);
    }
    let (recording, findings) = read(&layout, content.as_bytes()).unwrap();
    assert_eq!(recording.torque_nm.len(), 40);
    assert!((recording.torque_nm[20] - 20.5).abs() < 1e-9);
    assert!((recording.time_base.start_s - 0.1).abs() < 1e-12);
    assert_eq!(
        (findings[0].severity, findings[0].code.as_str()),
        (Severity::Repaired, "resampled")
    );

    let error = read(&layout, b"\n\nt;M;phi\n5;1;1\n4;1;1\n3;1;1\n").unwrap_err();
    assert!(error.to_string().contains("line 5"), "{error}");
}

#[test]
fn scale_turns_the_sign() {
    let mut layout = layout();
    layout.channels[0].scale = -2.0;
    let (recording, _) = read(&layout, b"M,phi\n1,10\n2,20\n").unwrap();
    assert_eq!(recording.torque_nm, [-2.0, -4.0]);
}

#[test]
fn conditions_from_the_name_only_where_a_pattern_is_declared() {
    let layout = CsvLayout {
        conditions: Some(ConditionPattern::default()),
        ..layout()
    };
    let content = b"M,phi\n1,10\n";
    let ingested = ingested(&layout, content, "TP3_TT_Hard_8.csv").unwrap();
    assert_eq!(
        ingested.recordings[0].conditions.participant.as_deref(),
        Some("TP3")
    );
    assert!(ingested.findings.is_empty());
}
