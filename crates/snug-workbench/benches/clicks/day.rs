//! A day's use: two tabs, 500 clicks, 50 reloads; what the server's memory and the page's come to.

use crate::apart::Apart;
use crate::browser::{Headless, Tab};
use crate::many::study_of;
use std::path::Path;
use tempfile::TempDir;

const CLICKS: usize = 500;
/// Clicks from one reload to the next.
const BETWEEN_RELOADS: usize = 10;
/// Clicks from one line of the table to the next.
const BETWEEN_LINES: usize = 50;

/// Effects that are switched on together, at most: who tries more has lost the thread.
const MOST_ON: usize = 3;

/// What is clicked in turn, beside a switch now and then.
const BUTTONS: [&str; 4] = [
    "[data-undo]",
    "[data-redo]",
    "[data-worse='1']",
    "[data-pin]",
];

/// Clicks and reloads; the table of memory.
pub fn of_use(program: &Path) {
    let folder = TempDir::new().unwrap();
    let server = Apart::begin(&study_of(folder.path(), 1));
    let browser = Headless::launch(program.to_owned());
    let tabs = [
        browser.open(&server.address(), 1400, "light"),
        browser.open(&server.address(), 1400, "dark"),
    ];
    for tab in &tabs {
        tab.is_ready("1.541");
    }
    println!("a day's use      server [MB]  page [MB]  nodes");
    let mut memory = Vec::new();
    for click in 0..CLICKS {
        if click % BETWEEN_LINES == 0 {
            memory.push(line(click, &server, &tabs[0]));
        }
        let tab = &tabs[click % 2];
        tab.to_front();
        let on = "document.querySelectorAll('.switch[aria-checked=true]').length";
        let is_full = tab.value(on).as_u64() >= Some(MOST_ON as u64);
        let selector = match (click % 3, is_full) {
            (0, true) => ".switch[aria-checked=true]".to_owned(),
            (0, false) => format!(".effect:nth-child({}) .switch", 1 + click / 3 % 20),
            _ => BUTTONS[click / 2 % BUTTONS.len()].to_owned(),
        };
        tab.value(&format!("document.querySelector(\"{selector}\").click()"));
        if click % 5 == 4 {
            tab.has_fitted();
        }
        if click % BETWEEN_RELOADS == BETWEEN_RELOADS - 1 {
            tab.reload();
            tab.until("(document.querySelector('[data-error]')?.textContent ?? '…') !== '…'");
        }
    }
    memory.push(line(CLICKS, &server, &tabs[0]));
    println!(
        "  grown by {:.0} MB over the second half",
        grown_mb(&memory)
    );
    for tab in &tabs {
        tab.was_well(server.port);
    }
    browser.close();
    server.end();
}

/// One line of the table; what the server has in memory once it rests \[MB\].
fn line(click: usize, server: &Apart, tab: &Tab) -> f64 {
    tab.to_front();
    let heap = tab.value("performance.memory.usedJSHeapSize");
    let nodes = tab.value("document.getElementsByTagName('*').length");
    server.rests();
    let memory_mb = server.memory_mb();
    println!(
        "  {click:>3} clicks    {memory_mb:>10.0} {:>10.1} {:>6}",
        heap.as_f64().unwrap_or(f64::NAN) / 1e6,
        nodes.as_f64().unwrap_or(f64::NAN)
    );
    memory_mb
}

/// From the middle of a day to its end \[MB\].
fn grown_mb(memory: &[f64]) -> f64 {
    memory[memory.len() - 1] - memory[memory.len() / 2]
}
