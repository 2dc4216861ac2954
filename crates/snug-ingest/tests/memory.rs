//! Files made to take more memory than there is, in processes whose address space is limited: each is a finding.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod level5;

use level5::{array, bomb, doubles, element, file, start};
use snug_ingest::csv::{Column, CsvChannel, CsvLayout, Sampling};
use snug_ingest::{Format, Signal, Source, Unit, read};
use std::fs::File;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

const MB: usize = 1 << 20;

/// Runs one of the ignored tests below in a process that may have 1.5 GB.
fn in_a_small_process(test: &str) {
    let this = std::env::current_exe().unwrap();
    let output = Command::new("sh")
        .args([
            "-c",
            "ulimit -v 1500000; exec \"$0\" --exact \"$1\" --ignored",
        ])
        .args([this.as_os_str(), test.as_ref()])
        .output()
        .unwrap();
    assert!(
        output.status.success() && String::from_utf8_lossy(&output.stdout).contains("1 passed"),
        "{output:?}"
    );
}

#[test]
fn bombs() {
    in_a_small_process("bombs_here");
}

#[test]
fn many_at_once() {
    in_a_small_process("many_at_once_here");
}

#[test]
fn files_of_three_gigabytes() {
    in_a_small_process("files_of_three_gigabytes_here");
}

/// What the samples of a recording need, and one variable more.
fn beside(variable: Vec<u8>) -> Vec<u8> {
    let samples = [0.0, 1.0, 2.0];
    file(&[
        doubles("angle_acc_Acc_FIR150", &samples),
        doubles("Inline_Torque", &samples),
        variable,
    ])
}

fn hostile() -> Vec<(&'static str, Vec<u8>)> {
    let zeros = vec![0; MB];
    let empty_cells = [14, 0].map(u32::to_le_bytes).concat().repeat(MB / 8);
    let column = |name, megabytes: u32| start(6, &[megabytes << 17, 1], name);
    let doubles = |name, megabytes| {
        let start = column(name, megabytes);
        bomb(start, Some(9), &zeros, megabytes as usize)
    };
    let bytes_as_doubles = start(6, &[300 << 20, 1], "F_op_J");
    let cells = |count: u32| start(1, &[count << 17, 1], "Events");
    let mut names = start(2, &[0, 0], "Events");
    names.extend(element(5, &1_u32.to_le_bytes()));
    vec![
        ("1.9 GB at once", beside(doubles("Events", 1900))),
        ("9 GB one by one", beside(doubles("F_op_J", 90).repeat(100))),
        (
            "doubles of bytes",
            beside(bomb(bytes_as_doubles, Some(2), &zeros, 300)),
        ),
        ("cells", beside(bomb(cells(80), None, &empty_cells, 80))),
        (
            "field names",
            beside(bomb(names, Some(1), &b"a".repeat(MB), 100)),
        ),
        ("characters", {
            let start = start(4, &[1, 200 << 20], "File_name");
            beside(bomb(start, Some(16), &b"\xff".repeat(MB), 200))
        }),
    ]
}

#[test]
#[ignore = "run by `bombs` in a process of its own"]
fn bombs_here() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in hostile() {
        assert!(bytes.len() < 12 * MB, "{name} has {} bytes", bytes.len());
        let path = folder.path().join("x.mat");
        std::fs::write(&path, bytes).unwrap();
        let began = Instant::now();
        let finding = read(&Source::default(), &path, 0.33).unwrap_err().finding();
        assert_eq!(finding.code, "over_budget", "{name}: {}", finding.message);
        assert!(finding.message.contains("source.memory_mb"));
        assert!(began.elapsed() < Duration::from_secs(20), "{name}");
    }
}

#[test]
#[ignore = "run by `many_at_once` in a process of its own"]
fn many_at_once_here() {
    let folder = tempfile::tempdir().unwrap();
    // Each takes 160 MB to read, and there are eight; with one at a time they fit.
    let column = |name| bomb(start(6, &[5 << 17, 1], name), Some(9), &vec![0; MB], 5);
    let torque = bomb(
        start(6, &[60 << 17, 1], "Inline"),
        Some(9),
        &vec![0; MB],
        60,
    );
    let path = folder.path().join("x.mat");
    std::fs::write(&path, file(&[column("angle_acc_Acc_FIR150"), torque])).unwrap();
    std::thread::scope(|scope| {
        let readers: Vec<_> = (0..8)
            .map(|_| {
                scope.spawn(|| {
                    let ingested = read(&Source::default(), &path, 0.33).unwrap();
                    ingested.recordings[0].torque_nm.len()
                })
            })
            .collect();
        for reader in readers {
            assert_eq!(reader.join().unwrap(), 5 << 17);
        }
    });
}

#[test]
#[ignore = "run by `files_of_three_gigabytes` in a process of its own"]
fn files_of_three_gigabytes_here() {
    let folder = tempfile::tempdir().unwrap();
    let csv = Source {
        format: Format::Csv(numbers()),
        ..Source::default()
    };
    for (name, source) in [
        ("x.mat", &Source::default()),
        ("x.mcap", &Source::default()),
        ("x.csv", &csv),
    ] {
        let path = folder.path().join(name);
        File::create(&path).unwrap().set_len(3 << 30).unwrap();
        let began = Instant::now();
        let finding = read(source, &path, 0.33).unwrap_err().finding();
        assert!(
            finding.message.starts_with("file left out: "),
            "{finding:?}"
        );
        assert!(began.elapsed() < Duration::from_millis(500), "{name}");
    }
}

fn numbers() -> CsvLayout {
    let channel = |index, signal| CsvChannel {
        column: Column::Index(index),
        signal,
        unit: Unit::One,
        scale: 1.0,
    };
    CsvLayout {
        channels: vec![channel(0, Signal::Torque), channel(1, Signal::Displacement)],
        sampling: Sampling::Rate { hz: 100.0 },
        ..CsvLayout::default()
    }
}

#[test]
fn the_budget_is_the_settings_where_there_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let (mat, text) = (folder.path().join("x.mat"), folder.path().join("x.csv"));
    let samples: Vec<f64> = (0..100_000).map(f64::from).collect();
    let channels = ["angle_acc_Acc_FIR150", "Inline_Torque"].map(|name| doubles(name, &samples));
    std::fs::write(&mat, file(&channels)).unwrap();
    std::fs::write(&text, "1;2\n".repeat(100_000)).unwrap();
    for (path, format) in [(&mat, Format::default()), (&text, Format::Csv(numbers()))] {
        let of = |memory_mb| Source {
            format: format.clone(),
            memory_mb,
            ..Source::default()
        };
        let code = |memory_mb| read(&of(memory_mb), path, 0.33).map_err(|e| e.code());
        assert_eq!(code(Some(1)).unwrap_err(), "over_budget", "{path:?}");
        assert!(code(Some(20)).is_ok() && code(None).is_ok(), "{path:?}");
    }
    let none = Source {
        memory_mb: Some(0),
        ..Source::default()
    };
    assert_eq!(none.check().unwrap_err().code(), "bad_setting");
}

/// A shape is a claim, not elements.
#[test]
fn shapes_without_elements_take_no_memory() {
    let no_fields = [element(5, &8_u32.to_le_bytes()), element(1, &[])];
    let huge = [0x7FFF_FFFF, 3];
    for events in [
        array(2, &huge, "Events", &no_fields),
        array(4, &huge, "Events", &[element(16, &[])]),
        array(99, &huge, "Events", &[]),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.mat");
        std::fs::write(&path, beside(events)).unwrap();
        let finding = read(&Source::default(), Path::new(&path), 0.33)
            .unwrap_err()
            .finding();
        assert_eq!(finding.code, "unusable_events");
    }
}
