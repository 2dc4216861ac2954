//! Broken MAT files: whatever is flipped or cut off, the answer is content or an error; never a panic, never memory
//! out of proportion.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use snug_ingest::IngestError;
use snug_ingest::mat::MatFile;
use std::path::{Path, PathBuf};

/// A multiplicative congruential generator (Knuth's MMIX constants): the same damage in every run.
struct Damage(u64);

impl Damage {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }
}

fn files() -> Vec<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mat");
    let mut folders = vec![own];
    match std::env::var_os("SNUG_DATA") {
        Some(data) => folders.extend(
            ["scipy", "pymatreader"].map(|name| Path::new(&data).join("mat-files").join(name)),
        ),
        None => eprintln!("skipped: the files in SNUG_DATA, which is not set"),
    }
    let mut files: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "mat"))
        .collect();
    files.sort();
    files
}

/// Peak address space of this process [bytes], where the system tells.
fn peak_memory() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmPeak"))?;
    Some(line.split_whitespace().nth(1)?.parse::<usize>().ok()? * 1024)
}

fn rounds(bytes: usize) -> usize {
    let budget = std::env::var("SNUG_CORRUPTIONS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(100);
    // Large files are slower to read, and most of their bytes are plain numbers.
    if bytes > 100_000 { budget / 25 } else { budget }
}

#[test]
fn flipped_bytes() {
    let mut damage = Damage(5);
    for path in files() {
        let intact = std::fs::read(&path).unwrap();
        for _ in 0..rounds(intact.len()) {
            let mut bytes = intact.clone();
            for _ in 0..=damage.below(4) {
                // Headers and tags decide; half of the flips go there.
                let reach = if damage.below(2) == 0 {
                    bytes.len().min(4096)
                } else {
                    bytes.len()
                };
                let place = damage.below(reach);
                bytes[place] = match damage.below(4) {
                    0 => 0xFF,
                    1 => 0x7F,
                    2 => 0,
                    _ => damage.below(256) as u8,
                };
            }
            survives(&path, bytes);
        }
    }
    if let Some(peak) = peak_memory() {
        assert!(
            peak < 1 << 30,
            "{peak} bytes of address space for files below 1 MB"
        );
    }
}

#[test]
fn cut_short() {
    let mut damage = Damage(7);
    for path in files() {
        let intact = std::fs::read(&path).unwrap();
        for _ in 0..rounds(intact.len()) {
            let length = damage.below(intact.len());
            survives(&path, intact[..length].to_vec());
        }
    }
}

fn survives(path: &Path, bytes: Vec<u8>) {
    match MatFile::from_bytes(bytes) {
        Ok(_) => {}
        Err(IngestError::Hdf5Panic) => eprintln!("{}: the HDF5 library panicked", path.display()),
        Err(error) => assert!(error.to_string().len() > 10, "{}: {error}", path.display()),
    }
}

#[test]
fn text_and_pictures_are_no_mat_files() {
    for bytes in [
        b"time;torque\n0,0;1,5\n".repeat(20),
        b"\x89PNG\r\n\x1a\n".repeat(40),
        b"PK\x03\x04".repeat(100),
        vec![0; 500],
        vec![0xFF; 500],
        b"abc".to_vec(),
        Vec::new(),
    ] {
        let start: Vec<u8> = bytes.iter().take(4).copied().collect();
        assert!(MatFile::from_bytes(bytes).is_err(), "{start:?}");
    }
}
