//! The installed program: started in an empty folder, with an empty home and no cargo, as by somebody who has no checkout.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a failing story should say where")]
#![allow(clippy::print_stdout, reason = "a skipped check says so")]

mod completions;
mod evaluation;
mod help;
mod machine;
mod plant;
mod workbench;
