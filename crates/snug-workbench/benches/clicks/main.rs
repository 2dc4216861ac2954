//! How long a click takes in a real browser, and whether a day's use leaves the memory as it was: `cargo xtask bench workbench`.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    dead_code,
    reason = "a benchmark prints its table, and shares what drives the browser with the stories"
)]

mod apart;
#[path = "../../tests/in_browser/browser.rs"]
mod browser;
mod day;
#[path = "../../tests/in_browser/devtools.rs"]
mod devtools;
mod latency;
mod many;
#[path = "../../tests/in_browser/server.rs"]
mod server;

use browser::installed;
use mimalloc::MiMalloc;

/// The program's own: what a day leaves in memory is the allocator's doing, too.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// A workbench on 24 tightenings and on 240, clicked; with `--long` used for a day.
fn main() {
    if apart::is_asked_for() {
        return apart::serve();
    }
    let Some(program) = installed() else { return };
    let is_long = std::env::args().any(|argument| argument == "--long");
    if is_long {
        day::of_use(&program);
    }
    latency::of_clicks(&program, 1);
    latency::of_clicks(&program, 10);
}
