//! Mutated inputs for everything that reads a stranger's bytes: no panic, no hang, no memory without bound.
//!
//! Every target runs in a process of its own below a memory limit. Each input lies in a file before it is tried, so that what
//! kills the process is at hand. Inputs in `fixtures/fuzz/TARGET/` are where mutations start, and are tried themselves: a
//! crash becomes one of them.
//!
//! `SNUG_FUZZ_SECONDS` says how long each target is tried (default 2), `SNUG_FUZZ_SEED` which mutations (default 0).
#![allow(clippy::unwrap_used, reason = "a failure should say where")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it reports")]

mod mutation;
mod targets;
mod worker;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::Mutex;
use targets::TARGETS;

/// Memory of the process that tries a target \[KB\]: a small machine's.
const MEMORY_KB: u64 = 2_000_000;
/// Names the target to a process that is to try it.
const WORKER: &str = "SNUG_FUZZ_WORKER";

fn main() -> ExitCode {
    let seconds = number("SNUG_FUZZ_SECONDS", 2);
    if let Ok(name) = std::env::var(WORKER) {
        return worker::work(&name, seconds, number("SNUG_FUZZ_SEED", 0));
    }
    let mut words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'));
    let filter = words.next();
    if let (Some(name), Some(file)) = (&filter, words.next()) {
        return worker::reproduce(name, Path::new(&file));
    }
    let chosen: Vec<&str> = (TARGETS.iter())
        .map(|target| target.name)
        .filter(|name| {
            filter
                .as_ref()
                .is_none_or(|filter| format!("fuzz::{name}").contains(filter))
        })
        .collect();
    let failed = Mutex::new(Vec::new());
    let next = Mutex::new(chosen.iter());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(name) = { next.lock().unwrap().next() } {
                    match attempt(name) {
                        Ok(said) => print!("fuzz::{name} ... {said}"),
                        Err(said) => {
                            print!("fuzz::{name} ... FAILED\n{said}");
                            failed.lock().unwrap().push(*name);
                        }
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap();
    println!(
        "{} passed, {} failed",
        chosen.len() - failed.len(),
        failed.len()
    );
    match failed.is_empty() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}

fn number(variable: &str, default: u64) -> u64 {
    let text = std::env::var(variable).ok();
    text.map_or(default, |text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{variable} is {text}; allowed is a whole number"))
    })
}

/// Tries a target in a process of its own; what it said, with the input at hand where it failed.
fn attempt(name: &str) -> Result<String, String> {
    let folder = tempfile::tempdir_in("/dev/shm")
        .or_else(|_| tempfile::tempdir())
        .unwrap();
    let program = std::env::current_exe().unwrap();
    let limit = format!("ulimit -v {MEMORY_KB}; exec \"$0\"");
    let output = Command::new("sh")
        .args(["-c", &limit])
        .arg(program)
        .env(WORKER, name)
        .env("RUST_BACKTRACE", "0")
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(said);
    }
    let input = keep(name, folder.path());
    Err(format!(
        "{said}{}\n{}\nthe input is kept: {}\nto see it again: cargo xtask fuzz {name} {}\n",
        String::from_utf8_lossy(&output.stderr),
        output.status,
        input.display(),
        input.display()
    ))
}

/// The input at hand when a process failed, under a name of its own.
fn keep(name: &str, folder: &Path) -> PathBuf {
    let found = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let input = found
        .filter(|path| path.is_file())
        .max_by_key(|path| path.metadata().unwrap().modified().unwrap());
    let kept = std::env::temp_dir().join(format!("snug-fuzz-{name}-{}.bin", std::process::id()));
    if let Some(input) = input {
        std::fs::copy(input, &kept).unwrap();
    }
    kept
}
