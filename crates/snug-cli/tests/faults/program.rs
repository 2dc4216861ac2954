//! The program as a user starts it, and what it leaves.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// `snug` with these words.
pub fn snug(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snug"));
    command
        .args(words)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// The same below a shell's limit or redirection, as in `ulimit -v 1000000; exec "$0" "$@"`.
pub fn snug_below(shell: &str, words: &[&str]) -> Command {
    let mut command = Command::new("bash");
    command
        .args(["-c", shell, env!("CARGO_BIN_EXE_snug")])
        .args(words)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// Runs it to its end: exit code (−1 for a signal) and everything it said.
pub fn ended(command: &mut Command) -> (i32, String) {
    let output = command.output().unwrap();
    (output.status.code().unwrap_or(-1), said(&output))
}

pub fn said(output: &Output) -> String {
    let mut text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.push_str(&String::from_utf8_lossy(&output.stderr));
    text
}

/// A campaign that ships with Snug: `campaign` or `mystery`.
pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../fixtures")
        .join(name)
}

/// A folder with the first files of the embedded campaign.
pub fn few_files(count: usize) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut files: Vec<PathBuf> = std::fs::read_dir(fixture("campaign"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    for file in &files[..count] {
        std::fs::copy(file, folder.path().join(file.file_name().unwrap())).unwrap();
    }
    folder
}

/// A verb on data, with a folder for its results.
pub fn words<'a>(verb: &'a str, data: &'a Path, out: &'a Path) -> [&'a str; 5] {
    [verb, "--data", text(data), "--out", text(out)]
}

pub fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Every result of a folder by name; unfinished recordings and Snug's own marks are none.
pub type Results = BTreeMap<String, Vec<u8>>;

pub fn results(folder: &Path) -> Results {
    let mut results = Results::new();
    for path in entries(folder) {
        let name = path.file_name().unwrap().to_str().unwrap();
        if !name.starts_with(".snug-") && !name.contains(".partial-") {
            results.insert(name.to_owned(), std::fs::read(&path).unwrap());
        }
    }
    results
}

/// The recordings that runs left unfinished.
pub fn partials(folder: &Path) -> Vec<PathBuf> {
    let mut all = entries(folder);
    all.retain(|path| path.to_string_lossy().contains(".partial-"));
    all
}

pub fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// What a run of this data leaves in a folder of its own.
pub fn expected(data: &Path) -> Results {
    let out = tempfile::tempdir().unwrap();
    let (code, said) = ended(&mut snug(&words("run", data, out.path())));
    assert_eq!(code, 0, "{said}");
    results(out.path())
}

/// Names of those results that are neither the old nor the new ones.
pub fn differing<'a>(found: &'a Results, wanted: &'a Results) -> Vec<&'a str> {
    let names = found.keys().chain(wanted.keys());
    let mut names: Vec<&str> = names
        .filter(|name| found.get(*name) != wanted.get(*name))
        .map(String::as_str)
        .collect();
    names.dedup();
    names
}
