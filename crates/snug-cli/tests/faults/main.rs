//! What a crash, a full disk, two runs at once, a signal or a hostile folder can and cannot do to results: tried with the
//! real program.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a failing story should say where")]
#![allow(clippy::print_stdout, reason = "a skipped check says so")]

mod drafts;
mod entries;
mod full_disk;
mod inputs;
mod kills;
mod memory;
mod program;
mod signals;
mod streams;
mod study_file;
mod two_at_once;
