//! Where tests find measurements that are not part of the repository.
#![allow(clippy::print_stdout, reason = "a skipped check says so")]

use std::path::PathBuf;

/// The folder of real measurements and certified sets (`SNUG_DATA`), or a printed word that the check was skipped.
pub fn data(what: &str) -> Option<PathBuf> {
    folder("SNUG_DATA", what)
}

/// The folder of practice campaigns with known truth (`SNUG_PRACTICE`), or a printed word that the check was skipped.
pub fn practice(what: &str) -> Option<PathBuf> {
    folder("SNUG_PRACTICE", what)
}

/// Whether checks with many cases were asked for (`cargo xtask test --many`).
pub fn many() -> bool {
    std::env::var_os("SNUG_MANY").is_some()
}

/// Whether a long story was asked for, as [`many`] cases are, or a printed word that it was skipped.
pub fn long(story: &str) -> bool {
    let is_asked_for = many();
    if !is_asked_for {
        println!("skipped: {story} (it takes long: `cargo xtask test --many`)");
    }
    is_asked_for
}

fn folder(variable: &str, what: &str) -> Option<PathBuf> {
    let folder = std::env::var_os(variable).map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: {what} ({variable} is not set)");
    }
    folder
}

/// Whether every effect is to be hidden and found (`SNUG_BLIND` is set, or `cargo xtask test --blind`).
pub fn blind() -> bool {
    std::env::var_os("SNUG_BLIND").is_some()
}
