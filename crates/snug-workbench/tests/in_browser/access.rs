//! The page for everybody: on paper-narrow screens, in the dark, with a keyboard alone, and to a screen reader.

use crate::browser::Tab;
use crate::opened::Opened;
use serde_json::json;

/// Faults that axe-core calls serious or critical; `SNUG_AXE` names its script, which then must be there.
fn serious(tab: &Tab, script: &str) -> Vec<String> {
    tab.value(&format!("{script};0"));
    let told = tab
        .value(
            "axe.run().then(found => found.violations.filter(one => ['serious', 'critical'].includes(one.impact))
             .map(one => one.id + ': ' + one.nodes.map(node => node.html.slice(0, 120)).slice(0, 3).join(' | ')))",
        );
    let faults = told.as_array().unwrap().iter();
    faults
        .map(|fault| fault.as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn the_page_is_for_everybody() {
    let Some(opened) = Opened::on_the_mystery() else {
        return;
    };
    let axe = std::env::var_os("SNUG_AXE").map(|path| std::fs::read_to_string(path).unwrap());
    if axe.is_none() {
        println!("skipped: SNUG_AXE names no script of axe-core");
    }
    for (width, scheme) in [
        (1400, "light"),
        (1400, "dark"),
        (390, "light"),
        (390, "dark"),
    ] {
        let address = format!("{}?effects=stretch_reflex&rival=", opened.server.address());
        let tab = opened.browser.open(&address, width, scheme);
        tab.error_is("1.007");
        tab.until("document.querySelector('[data-tested]').dataset.state === 'real'");
        let sideways = tab.value("document.documentElement.scrollWidth");
        assert!(sideways.as_i64() <= Some(width), "{sideways} of {width}");
        if let Some(axe) = &axe {
            let faults = serious(&tab, axe);
            assert!(faults.is_empty(), "{width} {scheme}: {faults:#?}");
        }
        tab.was_well(opened.server.port);
        tab.ask("Page.close", &json!({}));
    }
    opened.close();
}

/// From the top of the page by Tab alone to the switch that promises most, and on by the space bar.
#[test]
fn a_keyboard_is_enough() {
    let Some(opened) = Opened::on_the_mystery() else {
        return;
    };
    let tab = opened.tab();
    tab.is_ready("1.541");
    let at = "document.activeElement.closest('li')?.dataset.effect ?? ''";
    let mut presses = 0;
    while tab.value(at) != "stretch_reflex" {
        tab.press("Tab");
        presses += 1;
        assert!(presses < 60, "the switch is out of reach");
    }
    tab.press(" ");
    tab.error_is("1.007");
    println!("{presses} presses of Tab to the first switch");
    opened.close();
}
