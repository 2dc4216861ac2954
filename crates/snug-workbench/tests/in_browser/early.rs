//! A click by somebody who is faster than the page's line to the server.

use crate::opened::Opened;
use serde_json::json;

/// A line that is made a second late, as over a slow machine.
const LATE: &str = "
const Prompt = EventSource;
window.EventSource = function (address) {
  const late = { close() { this.line?.close(); } };
  setTimeout(() => {
    late.line = new Prompt(address);
    late.line.onmessage = message => late.onmessage(message);
    late.line.onerror = error => late.onerror(error);
  }, 1000);
  return late;
};";

#[test]
fn a_click_before_the_server_knows_the_page_counts() {
    let Some(opened) = Opened::on_the_mystery() else {
        return;
    };
    // Read, so that the page is there at once.
    opened.tab().is_ready("1.541");
    let tab = opened.browser.open("about:blank", 1400, "light");
    tab.ask(
        "Page.addScriptToEvaluateOnNewDocument",
        &json!({"source": LATE}),
    );
    tab.goto(&opened.server.address());
    let switch = "[data-effect=stretch_reflex] .switch";
    tab.until(&format!("document.querySelector('{switch}') !== null"));
    tab.click(switch);
    let early = "document.querySelector('[data-error]').textContent";
    assert_eq!(tab.value(early), "…");
    tab.error_is("1.007");
    tab.was_well(opened.server.port);
    opened.close();
}
