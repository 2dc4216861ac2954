//! From a click to the first lower error on screen, and to the last.

use crate::browser::{Headless, Tab};
use crate::many::study_of;
use crate::server::Server;
use std::path::Path;
use std::time::Instant;
use tempfile::TempDir;

/// Effects that are clicked on a large campaign, each from the study's own model; on a small one all are.
const EFFECTS: [&str; 8] = [
    "stretch_reflex",
    "directional_damping",
    "cubic_stiffness",
    "coulomb_friction",
    "maxwell_branch",
    "torque_delay",
    "voluntary_push",
    "backlash",
];

/// Clicks `selector` and waits until what was asked for is fitted; milliseconds to the first text that the error takes after it, and to
/// the last.
const CLICKED: &str = "(async () => {
  const error = document.querySelector('[data-error]'), begun = performance.now(), times = [];
  const seen = new MutationObserver(() => times.push(performance.now() - begun));
  seen.observe(error, { childList: true });
  document.body.classList.add('fitting');
  document.querySelector(SELECTOR).click();
  while (document.body.classList.contains('fitting')) await new Promise(rest => setTimeout(rest, 1));
  await new Promise(rest => requestAnimationFrame(rest));
  seen.disconnect();
  return [times[0] ?? NaN, times.at(-1) ?? NaN];
})()";

/// Moves a slider by a hundredth and waits for what the tightening makes of it \[ms\].
const DRAGGED: &str = "(async () => {
  const range = document.querySelectorAll('.slider input')[2], says = document.querySelector('[data-by-hand]');
  const was = says.textContent, begun = performance.now();
  range.value = range.value * 0.99;
  range.dispatchEvent(new Event('input'));
  while (says.textContent === was) await new Promise(rest => setTimeout(rest, 1));
  return performance.now() - begun;
})()";

/// Drags of which the median is told.
const DRAGS: usize = 20;

/// The table of a campaign that is so many times the mystery.
pub fn of_clicks(program: &Path, times: usize) {
    let folder = TempDir::new().unwrap();
    let study = study_of(folder.path(), times);
    let begun = Instant::now();
    let server = Server::begin(0, &study);
    let browser = Headless::launch(program.to_owned());
    let tab = browser.open(&server.address(), 1400, "light");
    tab.until("document.querySelector('[data-error]')?.textContent > '1'");
    println!(
        "{} tightenings: first error on screen after {:.1} s, browser started",
        24 * times,
        begun.elapsed().as_secs_f64()
    );
    println!("  click                  first [ms]  last [ms]  then a drag [ms]  longest");
    for effect in of_which(&tab, times) {
        tab.is_quiet();
        let [first, last] = clicked(&tab, &format!("[data-effect={effect}] .switch"));
        tab.is_quiet();
        let [drag, longest] = dragged(&tab);
        println!("  {effect:<26} {first:>6.0} {last:>10.0} {drag:>17.0} {longest:>8.0}");
        clicked(&tab, "[data-undo]");
    }
    tab.is_quiet();
    let [drag, longest] = dragged(&tab);
    println!(
        "  {:<26} {:>6} {:>10} {drag:>17.0} {longest:>8.0}",
        "no effect", "", ""
    );
    tab.was_well(server.port);
    browser.close();
    server.end();
}

/// Every effect of a campaign that is fitted at once, else some.
fn of_which(tab: &Tab, times: usize) -> Vec<String> {
    let all =
        "[...document.querySelectorAll('[data-switches] > li')].map(one => one.dataset.effect)";
    match times {
        1 => serde_json::from_value(tab.value(all)).unwrap(),
        _ => EFFECTS.map(str::to_owned).to_vec(),
    }
}

/// Median and longest of some drags \[ms\].
fn dragged(tab: &Tab) -> [f64; 2] {
    let mut drags = Vec::new();
    for _ in 0..DRAGS {
        drags.push(tab.value(DRAGGED).as_f64().unwrap_or(f64::NAN));
    }
    tab.value("document.querySelector('[data-as-fitted]').click()");
    drags.sort_by(f64::total_cmp);
    [drags[DRAGS / 2], drags[DRAGS - 1]]
}

fn clicked(tab: &Tab, selector: &str) -> [f64; 2] {
    let script = CLICKED.replace("SELECTOR", &format!("'{selector}'"));
    let times = tab.value(&script);
    [0, 1].map(|place| times[place].as_f64().unwrap_or(f64::NAN))
}
