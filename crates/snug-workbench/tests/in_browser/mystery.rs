//! The mystery solved with a mouse: the error falls on screen, and what is saved can be run.

use crate::browser::Tab;
use crate::opened::Opened;
use crate::server::Server;
use serde_json::Value;
use snug_study::{RunSettings, Study, run};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

/// Notes every text that the error takes, and when, since the switch was clicked \[ms\].
const WATCH: &str = "(() => {
  const error = document.querySelector('[data-error]');
  window.fallen = [];
  document.addEventListener('click', () => { window.clicked = performance.now(); }, { capture: true, once: true });
  new MutationObserver(() => fallen.push([performance.now() - window.clicked, Number(error.textContent)])).observe(error, { childList: true });
})()";

/// Longest until the first lower error is on screen, and until the fit has ended \[ms\]. Chosen: what is aimed at is 200 and 1000 on a
/// machine that does nothing else; the tests of a whole workspace run beside this one.
const AT_FIRST_MS: f64 = 2000.0;
const AT_LAST_MS: f64 = 10_000.0;

#[test]
fn the_mystery_is_solved_by_clicking() {
    let Some(opened) = Opened::on_the_mystery() else {
        return;
    };
    let tab = opened.tab();

    // The misfit is seen, and what promises most stands first.
    tab.is_ready("1.541");
    assert!(tab.text("says").starts_with("More than the noise is left"));
    let usable = tab.text("usable");
    assert_eq!(usable, "usable tightenings: 7 of 24");
    let first = "document.querySelector('[data-switches] > li').dataset.effect";
    assert_eq!(tab.value(first), "stretch_reflex");
    tab.click("[data-effect=stretch_reflex] [data-signature]");
    tab.until("[...document.querySelectorAll('.toggle')].some(key => key.textContent.includes('would leave'))");

    // One click, and the error falls step by step.
    tab.value(WATCH);
    tab.click("[data-effect=stretch_reflex] .switch");
    tab.error_is("1.007");
    tab.has_fitted();
    let fallen = tab.value("fallen");
    let fallen: Vec<(f64, f64)> = (fallen.as_array().unwrap().iter())
        .map(|one| (one[0].as_f64().unwrap(), one[1].as_f64().unwrap()))
        .collect();
    assert!(fallen.len() >= 2, "{fallen:?}");
    assert!(
        fallen.windows(2).all(|pair| pair[1].1 <= pair[0].1),
        "{fallen:?}"
    );
    let (at_first, at_last) = (fallen[0].0, fallen[fallen.len() - 1].0);
    println!("first lower error after {at_first:.0} ms, the last after {at_last:.0} ms");
    assert!(at_first < AT_FIRST_MS && at_last < AT_LAST_MS, "{fallen:?}");
    assert_eq!(tab.text("says"), "Nothing but the noise is left.");

    // Whether it is real is said by tightenings that it was not fitted to.
    tab.until("document.querySelector('[data-tested]').dataset.state === 'real'");
    assert_eq!(tab.text("tested"), "Tested: stretch reflex is real.");
    assert_eq!(tab.text("usable"), "usable tightenings: 7 → 24 of 24");

    are_drawn(&tab);
    look_closer(&tab);

    // A number follows the keyboard, and the curve the number.
    tab.focus(".slider input");
    tab.press("ArrowRight");
    tab.until("document.querySelector('[data-by-hand]').textContent.startsWith('By hand: error ')");
    tab.click("[data-as-fitted]");

    // Undone and done again with the keyboard, saved, and run as any study is.
    for (button, error) in [("undo", "1.541"), ("redo", "1.007")] {
        let selector = format!("[data-{button}]");
        tab.focus(&selector);
        tab.press("Enter");
        tab.error_is(error);
    }
    // A model so far is a way back to it, and what came after it a way on.
    for (selector, error) in [("[data-ladder] button", "1.541"), ("[data-redo]", "1.007")] {
        tab.click(selector);
        tab.error_is(error);
    }
    tab.click("[data-save]");
    tab.until("document.querySelector('[data-saved]').textContent.startsWith('Saved as ')");
    reproduces(&opened.folder.path().join("mystery.workbench.ron"));

    // A reload shows the same.
    tab.reload();
    tab.error_is("1.007");
    assert_eq!(switched_on(&tab.value(ON)), ["stretch_reflex"]);
    tab.was_well(opened.server.port);
    opened.close();
}

/// Step responses of the model before and the present one, and how measured and simulated motion answer the torque over frequency.
fn are_drawn(tab: &Tab) {
    tab.until(
        "document.querySelectorAll('[data-panel]')[2].querySelectorAll('path.line').length === 2",
    );
    let axis =
        "document.querySelectorAll('[data-panel]')[2].querySelector('text.axis').textContent";
    assert_eq!(tab.value(axis), "time since the step [ms]");
    for (figure, lines) in [("Gain", 3), ("Phase", 3), ("Coherence", 1)] {
        tab.until(&format!(
            "document.querySelectorAll('[data-force] svg.broad[aria-label^={figure}] path.line').length === {lines}"
        ));
    }
}

/// A stretch of time is brushed, and a cell of the map of the missing force chosen by keyboard: each counts alone.
fn look_closer(tab: &Tab) {
    tab.drag(0.3, 0.6);
    tab.click("[data-brush]");
    tab.until("document.querySelector('[data-closer]').textContent.includes('from ')");
    tab.click("[data-everything]");
    tab.until("document.querySelector('[data-closer]').textContent === ''");

    tab.until("document.querySelectorAll('[data-cell]').length > 1");
    tab.focus("[data-cell][tabindex='0']");
    tab.press("ArrowRight");
    tab.press("Enter");
    tab.until(
        "document.querySelector('[data-closer]').textContent.includes('where the grip is at')",
    );
    let is_kept = tab.value("location.search.includes('cell=')");
    assert_eq!(is_kept, Value::Bool(true));
    tab.click("[data-everything]");
    tab.until("document.querySelector('[data-closer]').textContent === ''");
}

const ON: &str = "[...document.querySelectorAll('.switch[aria-checked=true]')].map(on => on.closest('li').dataset.effect)";

fn switched_on(value: &Value) -> Vec<String> {
    let names = value.as_array().unwrap().iter();
    names
        .map(|name| name.as_str().unwrap().to_owned())
        .collect()
}

/// The saved study, run: every tightening is used, and only noise is left.
fn reproduces(study_file: &Path) {
    let study = Study::read(study_file).unwrap();
    assert_eq!(study.model.effects, ["stretch_reflex"]);
    let out = TempDir::new().unwrap();
    let never = AtomicBool::new(false);
    let outcome = run(&study, &RunSettings::new(out.path()), &|_| (), &never).unwrap();
    let mut errors: Vec<f64> = (outcome.result.tightenings.iter())
        .filter_map(|one| one.measures.error_over_noise)
        .collect();
    errors.sort_by(f64::total_cmp);
    assert_eq!(errors.len(), 24);
    let median = 0.5 * (errors[11] + errors[12]);
    assert!((median - 1.0).abs() < 0.02, "{errors:?}");
}

#[test]
fn a_server_that_goes_and_comes_back_loses_nothing() {
    let Some(opened) = Opened::on_the_mystery() else {
        return;
    };
    let (tab, other) = (opened.tab(), opened.tab());
    let port = opened.server.port;
    for (tab, effect) in [(&tab, "stretch_reflex"), (&other, "cubic_stiffness")] {
        tab.is_ready("1.541");
        tab.click(&format!("[data-effect={effect}] .switch"));
        tab.until("document.querySelector('[data-error]').textContent < '1.541'");
        tab.has_fitted();
    }
    opened.server.end();
    tab.until("!document.querySelector('[data-fault]').hidden");
    assert!(tab.text("fault").contains("Is it still running?"));
    let again = Server::begin(port, &opened.study_file);
    for (tab, effect) in [(&tab, "stretch_reflex"), (&other, "cubic_stiffness")] {
        tab.until("document.querySelector('[data-fault]').hidden");
        tab.has_fitted();
        assert_eq!(switched_on(&tab.value(ON)), [effect]);
    }
    opened.browser.close();
    again.end();
}
