//! Studies drafted for tables, variables and trees of which nothing is declared.
#![allow(clippy::unwrap_used)]

use super::*;
use snug_campaign::Quantity;
use snug_ingest::{Format, Signal, Unit};
use tempfile::TempDir;

/// A body on a spring under a force of three tones, sampled at 100 Hz: force, position, speed.
fn moved() -> Vec<[f64; 3]> {
    let (mut x, mut v) = (0.0, 0.0);
    let h = 1e-4;
    let mut rows = Vec::new();
    for step in 0..120_000 {
        let t = f64::from(step) * h;
        let force = (3.0 * t).sin() + (8.0 * t).sin() + (17.0 * t).sin();
        if step % 100 == 0 {
            rows.push([force, x, v]);
        }
        v += h * (force - 0.8 * v - 60.0 * x);
        x += h * v;
    }
    rows
}

fn drafted(name: &str, content: &str) -> (Study, Draft, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), content).unwrap();
    let study_file = folder.path().join("rig.ron");
    let draft = draft(&[folder.path().join(name)], &study_file).unwrap();
    let study = Study::parse(&draft.text, &study_file).unwrap();
    (study, draft, folder)
}

fn table(header: &str, row: impl Fn(usize, [f64; 3]) -> String) -> String {
    let rows = moved()
        .into_iter()
        .enumerate()
        .map(|(place, one)| row(place, one) + "\n");
    std::iter::once(header.to_owned() + "\n")
        .chain(rows)
        .collect()
}

/// Signals and units of a drafted table.
fn signals(study: &Study) -> Vec<(Signal, Unit)> {
    match &study.source.format {
        Format::Csv(layout) => layout
            .channels
            .iter()
            .map(|one| (one.signal, one.unit))
            .collect(),
        Format::Mat(layout) => layout
            .0
            .channels
            .iter()
            .map(|one| (one.signal, one.unit))
            .collect(),
        Format::Json(layout) => layout
            .0
            .channels
            .iter()
            .map(|one| (one.signal, one.unit))
            .collect(),
        _ => Vec::new(),
    }
}

#[test]
fn names_and_units_say_what_columns_are() {
    let content = table(
        "t [ms],Kraft [kN],Weg_mm,speed ref",
        |place, [force, x, v]| format!("{},{},{},{v}", 10 * place, force / 1000.0, 1000.0 * x),
    );
    let (study, draft, _folder) = drafted("a.csv", &content);
    assert_eq!(
        signals(&study),
        [
            (Signal::Force, Unit::Kilonewton),
            (Signal::Displacement, Unit::Millimetre)
        ]
    );
    assert!(draft.text.contains("unit: Millisecond") && draft.text.contains("the file says kN"));
    assert!(
        draft.columns[3].told.contains("what was wanted"),
        "{:?}",
        draft.columns[3].told
    );
    assert_eq!(study.source.path, Path::new("a.csv"));
}

/// Nothing has a name: times rise, one column is the other's derivative, what drives explains the motion.
#[test]
fn numbers_say_what_columns_are() {
    let content = table("", |place, [force, x, v]| {
        format!("{},{force},{x},{v}", place as f64 * 0.01)
    });
    let (study, draft, _folder) = drafted("a.csv", content.trim_start());
    assert_eq!(
        signals(&study),
        [
            (Signal::Displacement, Unit::Radian),
            (Signal::Velocity, Unit::RadianPerSecond),
            (Signal::Torque, Unit::NewtonMetre)
        ]
    );
    assert!(
        draft
            .notes
            .iter()
            .any(|note| note.contains("column 3 is the derivative of column 2")),
        "{:?}",
        draft.notes
    );
    assert_eq!(study.identify.fitted_output, Quantity::Displacement);
}

/// Of an output without a kind the kind is what a body on a spring makes of the input.
#[test]
fn the_kind_of_an_output_is_what_explains_most() {
    for (column, signal) in [(1, Signal::Displacement), (2, Signal::Velocity)] {
        let content = table("u,y", |_, row| format!("{},{}", row[0], row[column]));
        let (study, draft, _folder) = drafted("a.csv", &content);
        assert_eq!(
            signals(&study),
            [(Signal::Torque, Unit::One), (signal, Unit::One)],
            "{:?}",
            draft.notes
        );
        assert!(
            draft
                .notes
                .iter()
                .any(|note| note.starts_with("No time and no rate"))
        );
    }
}

#[test]
fn a_tree_is_drafted_and_others_of_its_folder_are_left_out() {
    let lists = |at: usize| {
        moved()
            .iter()
            .map(|row| row[at].to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    let content = format!(
        r#"{{"fs": 100, "run": {{"torque unit": "Nm", "torque values": [{}], "angle values": [{}]}}}}"#,
        lists(0),
        lists(1)
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("1.json"), content).unwrap();
    std::fs::write(folder.path().join("2.json"), "{}").unwrap();
    let study_file = folder.path().join("rig.ron");
    let draft = draft(&[folder.path().to_path_buf()], &study_file).unwrap();
    let study = Study::parse(&draft.text, &study_file).unwrap();
    assert_eq!(
        signals(&study),
        [
            (Signal::Torque, Unit::NewtonMetre),
            (Signal::Displacement, Unit::Radian)
        ]
    );
    assert!(draft.text.contains("hz: 100.0") && draft.text.contains("the file says fs = 100"));
    assert_eq!(
        (study.source.files.as_slice(), study.source.path.as_path()),
        (&["1.json".to_owned()][..], Path::new("."))
    );
}

/// A drive that turns against friction under a torque that was counted as the load's.
#[test]
fn a_load_becomes_a_drive() {
    let content = table("time,torque,angle", |place, row| {
        format!(
            "{},{},{}",
            0.01 * place as f64,
            row[0] - 4.0,
            place as f64 + row[1]
        )
    });
    let (study, draft, _folder) = drafted("a.csv", &content);
    assert!(
        draft.text.contains("unit: NewtonMetre, scale: -1.0"),
        "{}",
        draft.text
    );
    assert!(
        draft
            .notes
            .iter()
            .any(|note| note.contains("The sign of torque is turned"))
    );
    assert!(study.check().is_ok());
}

/// A sensor that counts the other way.
#[test]
fn a_turned_sign_is_turned_back() {
    let content = table("torque,angle", |_, row| format!("{},{}", -row[0], row[1]));
    let (study, draft, _folder) = drafted("a.csv", &content);
    assert!(draft.text.contains("scale: -1.0") && study.check().is_ok());
}

/// One pulse in every file, at about the same time.
#[test]
fn tightenings_are_told_from_recordings() {
    let folder = tempfile::tempdir().unwrap();
    for file in 0..3 {
        let start = 1000 + 10 * file;
        let rows = (0..3000).map(|row: i32| {
            let k = row - start;
            let is_pulse = (0..100).contains(&k);
            let torque = if is_pulse {
                (f64::from(k) * 0.01 * std::f64::consts::PI).sin()
            } else {
                0.0
            };
            let after = if k > 0 {
                (f64::from(k) * 0.01).sin() * (f64::from(-k) * 0.002).exp()
            } else {
                0.0
            };
            format!("{},{torque},{after}\n", f64::from(row) * 0.001)
        });
        let content: String = std::iter::once("time,torque,speed\n".to_owned())
            .chain(rows)
            .collect();
        std::fs::write(folder.path().join(format!("{file}.csv")), content).unwrap();
    }
    let study_file = folder.path().join("rig.ron");
    let draft = draft(&[folder.path().to_path_buf()], &study_file).unwrap();
    assert!(
        draft.text.contains("window: Pulse(start_s: 0.984"),
        "{}",
        draft.text
    );
    assert!(
        draft
            .notes
            .iter()
            .any(|note| note.starts_with("Each recording is a tightening"))
    );
    Study::parse(&draft.text, &study_file)
        .unwrap()
        .check()
        .unwrap();
}

#[test]
fn what_cannot_be_drafted_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let told = |paths: &[PathBuf]| draft(paths, Path::new("rig.ron")).unwrap_err().to_string();
    let path = folder.path().to_path_buf();
    assert!(
        told(std::slice::from_ref(&path)).contains("no .csv"),
        "{}",
        told(std::slice::from_ref(&path))
    );
    let flat: String = (0..30).map(|_| "1,2\n").collect();
    std::fs::write(path.join("a.csv"), flat).unwrap();
    assert!(told(&[path.join("a.csv")]).contains("column 0 (does not change)"));
    assert!(
        told(&[path.join("a.csv"), PathBuf::from("b.csv")]).contains("no file of the same folder")
    );
    let thesis = Path::new(env!("CARGO_MANIFEST_DIR")).join("../snug-ingest/tests/data/thesis");
    assert!(told(&[thesis]).contains("need no study: snug run --data"));
}

#[test]
fn a_clock_that_counts_since_1970_is_told_by_its_size() {
    for (start, each, unit) in [
        (1_700_000_000.0, 0.01, "Second"),
        (1_700_000_000_000.0, 10.0, "Millisecond"),
        (1_700_000_000_000_000.0, 10_000.0, "Microsecond"),
    ] {
        let content = table("timestamp,torque,speed", |place, [torque, _, speed]| {
            format!("{:.2},{torque},{speed}", start + each * place as f64)
        });
        let (_, draft, _folder) = drafted("a.csv", &content);
        assert!(
            draft.text.contains(&format!("unit: {unit}")),
            "{}",
            draft.text
        );
        assert!(
            draft.columns[0].told.contains("100 Hz"),
            "{}",
            draft.columns[0].told
        );
    }
}

/// A run leaves a record with such a gap out; that says nothing of its columns.
#[test]
fn what_cannot_be_tried_is_not_called_badly_explained() {
    let content = table("t,torque,angle", |place, [torque, x, _]| {
        let angle = if (300..400).contains(&place) {
            f64::NAN
        } else {
            x
        };
        format!("{},{torque},{angle}", 0.01 * place as f64)
    });
    let (_, draft, _folder) = drafted("a.csv", &content);
    assert!(draft.text.contains("could not be tried"), "{}", draft.text);
    assert!(!draft.text.contains("0 %"), "{}", draft.text);
}
