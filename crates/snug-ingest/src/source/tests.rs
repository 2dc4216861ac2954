//! Folders with every kind of entry, disks that fail, and the source as a study file writes it.
#![allow(clippy::unwrap_used)]

use super::*;
use snug_campaign::Severity;
use snug_files::fault::{Fault, FaultyDisk, Lasting};
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

/// Severity, code and what the message tells, by name.
fn said(listing: &Listing) -> Vec<(&str, Severity, &str, &str)> {
    listing
        .findings
        .iter()
        .map(|f| {
            (
                f.file.as_str(),
                f.severity,
                f.code.as_str(),
                f.message.as_str(),
            )
        })
        .collect()
}

#[cfg(unix)]
#[test]
fn every_entry_is_read_or_said() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("b.mat"), "x").unwrap();
    fs::create_dir(at("folder")).unwrap();
    fs::create_dir(at("folder.mat")).unwrap();
    symlink("gone.mat", at("dangling.mat")).unwrap();
    symlink("gone", at("dangling")).unwrap();
    symlink("loop.mat", at("loop.mat")).unwrap();
    symlink(at("b.mat"), at("c.mat")).unwrap();
    fs::hard_link(at("b.mat"), at("d.mat")).unwrap();
    let socket = std::os::unix::net::UnixListener::bind(at("socket.mat")).unwrap();
    let pipe = std::process::Command::new("mkfifo")
        .arg(at("pipe.mat"))
        .status();
    assert!(pipe.unwrap().success());
    let listing = list(&Source::default(), folder.path()).unwrap();
    drop(socket);
    assert_eq!(listing.files, [at("b.mat")]);
    let found = said(&listing);
    let short: Vec<_> = found
        .iter()
        .map(|&(file, severity, code, _)| (file, severity, code))
        .collect();
    use Severity::{LeftOut, Note};
    assert_eq!(
        short,
        [
            ("c.mat", Note, "same_file"),
            ("d.mat", Note, "same_file"),
            ("dangling", Note, "dangling_link"),
            ("dangling.mat", LeftOut, "dangling_link"),
            ("folder", Note, "not_read"),
            ("folder.mat", LeftOut, "not_a_file"),
            ("loop.mat", LeftOut, "link_loop"),
            ("pipe.mat", LeftOut, "not_a_file"),
            ("socket.mat", LeftOut, "not_a_file"),
        ]
    );
    assert!(found[0].3.contains("same file as b.mat"), "{}", found[0].3);
    assert!(found[7].3.contains("a pipe"), "{}", found[7].3);

    for (name, code) in [
        ("dangling.mat", "dangling_link"),
        ("loop.mat", "link_loop"),
        ("pipe.mat", "not_a_file"),
    ] {
        assert_eq!(
            list(&Source::default(), &at(name)).unwrap_err().code(),
            code
        );
        let named = Source {
            files: vec!["b.mat".to_owned(), name.to_owned()],
            ..Source::default()
        };
        assert_eq!(list(&named, folder.path()).unwrap_err().code(), code);
    }
    let twice = Source {
        files: vec!["c.mat".to_owned(), "b.mat".to_owned()],
        ..Source::default()
    };
    let listing = list(&twice, folder.path()).unwrap();
    assert_eq!(listing.files, [at("c.mat")]);
    assert_eq!(said(&listing)[0].0, "b.mat");
}

#[test]
fn a_disk_that_fails_costs_what_it_fails_at() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.csv", "b.csv", "c.csv"] {
        fs::write(folder.path().join(name), "V1,x\n1,2\n").unwrap();
    }
    let source = Source {
        files: Vec::new(),
        ..ron::from_str(STUDY).unwrap()
    };
    let counting = FaultyDisk::counting();
    list_on(&counting, &source, folder.path()).unwrap();
    let calls = counting.calls();
    for (call, fault) in (0..calls).flat_map(|call| Fault::ALL.map(|fault| (call, fault))) {
        let disk = FaultyDisk::new(call, fault, Lasting::Once);
        match list_on(&disk, &source, folder.path()) {
            Ok(listing) => {
                let accounted = listing.files.len() + listing.findings.len();
                assert_eq!(accounted, 3, "{call} {fault:?}");
            }
            Err(error) => assert!(call < 2, "{call} {fault:?}: {error}"),
        }
    }
    let file = folder.path().join("a.csv");
    let counting = FaultyDisk::counting();
    let whole = read_on(&counting, &source, &file, 0.33).unwrap();
    for (call, fault) in
        (0..counting.calls()).flat_map(|call| Fault::ALL.map(|fault| (call, fault)))
    {
        let disk = FaultyDisk::new(call, fault, Lasting::Once);
        match read_on(&disk, &source, &file, 0.33) {
            Ok(read) => assert_eq!(read, whole, "{call} {fault:?}"),
            Err(error) => assert_eq!(error.code(), "unreadable_file", "{call} {fault:?}"),
        }
    }
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
