//! One target, tried until its time is over.

use crate::mutation::Mutation;
use crate::targets::{TARGETS, Target};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Longest time that one input may take: the readers take milliseconds.
const PATIENCE: Duration = Duration::from_secs(20);

/// Tries a target; a panic, an abort or an endless input ends the process.
pub fn work(name: &str, seconds: u64, seed: u64) -> ExitCode {
    let target = TARGETS
        .iter()
        .find(|target| target.name == name)
        .expect("a target of that name");
    let tried = watched();
    let corpus = corpus(name);
    let started = Instant::now();
    for input in &corpus {
        attempt(target, input, tried);
    }
    let mut mutation = Mutation::new(seed, corpus);
    while started.elapsed() < Duration::from_secs(seconds) {
        let input = (target.mutate)(&mut mutation);
        attempt(target, &input, tried);
    }
    println!("ok ({} inputs)", tried.load(Ordering::Relaxed));
    ExitCode::SUCCESS
}

/// Tries one input that failed before.
pub fn reproduce(name: &str, file: &Path) -> ExitCode {
    match TARGETS.iter().find(|target| target.name == name) {
        Some(target) => {
            let input = std::fs::read(file).unwrap();
            let folder = tempfile::tempdir().unwrap();
            std::env::set_current_dir(&folder).unwrap();
            attempt(target, &input, watched());
            println!("it does no harm");
            ExitCode::SUCCESS
        }
        None => {
            let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
            eprintln!("there is no target {name}; there are {}", names.join(", "));
            ExitCode::from(2)
        }
    }
}

fn attempt(target: &Target, input: &[u8], tried: &AtomicU64) {
    let file = PathBuf::from(target.file);
    std::fs::write(&file, input).unwrap();
    (target.attempt)(&file, input);
    tried.fetch_add(1, Ordering::Relaxed);
}

/// Counts inputs, and ends the process when one takes too long.
fn watched() -> &'static AtomicU64 {
    static TRIED: AtomicU64 = AtomicU64::new(0);
    std::thread::spawn(|| {
        let (mut last, mut since) = (0, Instant::now());
        loop {
            std::thread::sleep(Duration::from_millis(200));
            let tried = TRIED.load(Ordering::Relaxed);
            if tried != last {
                (last, since) = (tried, Instant::now());
            } else if since.elapsed() > PATIENCE {
                println!("input {tried} takes longer than {} s", PATIENCE.as_secs());
                std::process::exit(1);
            }
        }
    });
    &TRIED
}

/// Where mutations start, and what crashed before.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../fixtures/fuzz")
        .join(name);
    // A target that makes its inputs itself has a folder only once something has crashed.
    let entries = std::fs::read_dir(&folder).into_iter().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
        .iter()
        .map(|file| std::fs::read(file).unwrap())
        .collect()
}
