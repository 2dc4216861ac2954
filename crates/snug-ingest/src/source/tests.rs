#![allow(clippy::unwrap_used)]

use super::*;
use std::fs;

#[test]
fn folders_are_listed_by_name_and_other_data_is_named() {
    let folder = tempfile::tempdir().unwrap();
    for name in [
        "b.mat",
        "A.MAT",
        "c.mcap",
        "README.md",
        "notes.csv",
        "._b.mat",
    ] {
        fs::write(folder.path().join(name), "x").unwrap();
    }
    fs::create_dir(folder.path().join("d.mat")).unwrap();
    let listing = list(&Source::default(), folder.path()).unwrap();
    let names: Vec<_> = listing
        .files
        .iter()
        .map(|file| file.file_name().unwrap().to_str().unwrap())
        .collect();
    assert_eq!(names, ["A.MAT", "b.mat"]);
    let others: Vec<_> = listing
        .findings
        .iter()
        .map(|finding| (finding.file.as_str(), finding.code.as_str()))
        .collect();
    assert_eq!(
        others,
        [
            ("._b.mat", "not_read"),
            ("README.md", "not_read"),
            ("c.mcap", "recording_beside_mat"),
            ("d.mat", "not_a_file"),
            ("notes.csv", "other_format")
        ]
    );

    fs::remove_file(folder.path().join("A.MAT")).unwrap();
    fs::remove_file(folder.path().join("b.mat")).unwrap();
    let listing = list(&Source::default(), folder.path()).unwrap();
    assert_eq!(listing.files, [folder.path().join("c.mcap")]);
}

#[test]
fn nothing_to_read_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let missing = list(&Source::default(), &folder.path().join("nowhere")).unwrap_err();
    assert!(missing.to_string().contains("nowhere"), "{missing}");
    let device = Path::new("/dev/null");
    if device.exists() {
        let error = list(&Source::default(), device).unwrap_err().to_string();
        assert!(
            error.contains("is a device; it must be a folder or a file"),
            "{error}"
        );
    }
    fs::write(folder.path().join("notes.csv"), "x").unwrap();
    let empty = list(&Source::default(), folder.path()).unwrap_err();
    assert!(
        empty.to_string().contains(".mat or .mcap")
            && empty.to_string().contains("there are notes.csv;"),
        "{empty}"
    );
    let named = Source {
        files: vec!["gone.mat".to_owned()],
        ..Source::default()
    };
    assert!(
        list(&named, folder.path())
            .unwrap_err()
            .to_string()
            .contains("gone.mat")
    );
}

#[test]
fn a_bad_file_is_a_finding_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("broken.mat");
    fs::write(&file, b"MATLAB 5.0 MAT-file, but not really").unwrap();
    let finding = read(&Source::default(), &file, 0.33).unwrap_err().finding();
    assert_eq!(
        (finding.file.as_str(), finding.code.as_str()),
        ("broken.mat", "unreadable_file")
    );
    assert!(
        finding.message.contains("not a MAT file"),
        "{}",
        finding.message
    );
}

const STUDY: &str = r#"(
    path: "../data",
    files: ["SNLS80mV.csv"],
    format: Csv((
        channels: [
            (column: Name("V1"), signal: Torque, unit: One),
            (column: Index(1), signal: Displacement, unit: One, scale: -1),
        ],
        sampling: Rate(hz: 610.3515625),
        ranges: [(name: "estimation", start: 40650, end: 105712), (name: "test", start: 105712, end: 127400)],
    )),
)"#;

#[test]
fn a_source_is_written_and_read_as_ron() {
    let source: Source = ron::from_str(STUDY).unwrap();
    source.check().unwrap();
    assert_eq!(source.ranges()[1].name, "test");
    for source in [source, Source::default()] {
        let text = ron::to_string(&source).unwrap();
        assert_eq!(ron::from_str::<Source>(&text).unwrap(), source);
    }
}

#[test]
fn typing_errors_are_named_with_their_place() {
    for (right, wrong, hint) in [
        ("files:", "flies:", "flies"),
        ("unit: One", "unit: Furlong", "Furlong"),
        ("hz:", "herz:", "herz"),
        ("ranges:", "rangs:", "rangs"),
        ("scale:", "skale:", "skale"),
    ] {
        let error = ron::from_str::<Source>(&STUDY.replacen(right, wrong, 1)).unwrap_err();
        assert!(
            error.to_string().contains(hint) && error.span.start.line > 1,
            "{error}"
        );
    }
    let error = ron::from_str::<Source>("(format: Thesis((conditions: (template: \"{who}\"))))")
        .unwrap_err();
    assert!(error.to_string().contains("{participant}"), "{error}");
}
