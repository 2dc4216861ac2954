//! A click by somebody who is faster than the page's line to the server.

use crate::opened::Opened;
use chromiumoxide::cdp::browser_protocol::page::AddScriptToEvaluateOnNewDocumentParams;
use std::time::Duration;

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

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_click_before_the_server_knows_the_page_counts() {
    let Some(opened) = Opened::on_the_mystery().await else {
        return;
    };
    // Read, so that the page is there at once.
    opened.tab().await.is_ready("1.541").await;
    let tab = opened.browser.open("about:blank", 1400, "light").await;
    let script = AddScriptToEvaluateOnNewDocumentParams::new(LATE);
    tab.page.execute(script).await.unwrap();
    let going = tab.page.goto(opened.server.address());
    (tokio::time::timeout(Duration::from_secs(1), going).await).ok();
    tab.click("[data-effect=stretch_reflex] .switch").await;
    let early = "document.querySelector('[data-error]').textContent";
    assert_eq!(tab.value(early).await, "…");
    tab.until("document.querySelector('[data-error]').textContent === '1.007'")
        .await;
    tab.was_well(opened.server.port);
    opened.close().await;
}
