//! A stretch of time that is dragged over is fitted alone, saved as a study, and left again.

use crate::opened::Opened;
use snug_study::{RunSettings, Study, run};
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

#[test]
fn a_stretch_is_fitted_alone_and_saved() {
    let Some(opened) = Opened::on_the_mystery() else {
        return;
    };
    let tab = opened.tab();
    tab.is_ready("1.541");
    tab.drag(0.1, 0.5);
    tab.click("[data-alone]");
    tab.until("document.querySelector('header').textContent.includes('s of every window alone')");
    tab.until("Number(document.querySelector('[data-error]')?.textContent) > 1");
    // Effects that are still being sorted would move away from under the click.
    tab.is_quiet();
    let whole = "document.querySelector('[data-error]').textContent === '1.541'";
    assert_eq!(tab.value(whole), false);
    tab.click("[data-effect=stretch_reflex] .switch");
    tab.until(
        "document.querySelector('[data-says]').textContent === 'Nothing but the noise is left.'",
    );
    tab.click("[data-save]");
    tab.until("document.querySelector('[data-saved]').textContent.startsWith('Saved as ')");
    tab.click("[data-whole]");
    tab.error_is("1.007");
    tab.was_well(opened.server.port);
    let folder = opened.close();

    // The same as a command: nothing after the stretch is there, and nothing before it is scored.
    let study = Study::read(&folder.path().join("mystery.workbench.ron")).unwrap();
    let stretch = study.preprocess.stretch.unwrap();
    assert!(0.0 < stretch.from_s && stretch.from_s < stretch.to_s && stretch.to_s < 0.3);
    let out = TempDir::new().unwrap();
    let never = AtomicBool::new(false);
    let outcome = run(&study, &RunSettings::new(out.path()), &|_| (), &never).unwrap();
    let errors: Vec<f64> = (outcome.result.tightenings.iter())
        .filter_map(|one| one.measures.error_over_noise)
        .collect();
    assert_eq!(errors.len(), 24);
    let mean = errors.iter().sum::<f64>() / 24.0;
    assert!((mean - 1.0).abs() < 0.05, "{errors:?}");
}
