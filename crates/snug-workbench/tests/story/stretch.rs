//! A stretch of every window has a workbench of its own.

use crate::browser::{Events, get, post, workbench};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

const PART: &str = "/stretch/0.05/0.2";

/// What comes after the stretch is not there, what comes before it is drawn and counts nowhere: the same stiffness of the reflex within
/// what fewer samples know.
#[test]
fn a_stretch_is_fitted_beside_whole_windows() {
    let port = workbench();
    let mut reading = Events::listen(port, &format!("{PART}/api/reading"));
    reading.until("ready");
    let (status, page) = get(port, PART);
    assert_eq!(status, 200);
    assert!(page.contains(&format!("data-root=\"{PART}\"")));
    assert!(page.contains("from 0.05000 to 0.2000 s of every window alone"));

    let mut events = Events::listen(port, &format!("{PART}/api/events?session=one&effects="));
    events.until("fitted");
    let wish = json!({ "session": "one", "kind": "choose", "effects": "stretch_reflex" });
    assert_eq!(post(port, &format!("{PART}/api/change"), &wish).0, 202);
    let found = events.until("fitted").pop().unwrap();
    let size = found["sizes"][0]["sizes"][0].as_str().unwrap();
    let size = size.replace('\u{a0}', " ");
    let numbers: Vec<f64> = size
        .split([' ', '[', ']', ','])
        .filter_map(|word| word.parse().ok())
        .collect();
    let [value, low, high] = numbers[..] else {
        panic!("{size}")
    };
    assert!(low < 639.7 && 639.7 < high && low < value, "{size}");
    assert!(
        high - low > 646.0 - 633.4,
        "fewer samples know less: {size}"
    );

    let seen = get(port, &format!("{PART}/api/tightening?number=3"));
    let seen: Value = serde_json::from_str(&seen.1).unwrap();
    let example = &seen["example"];
    let steps = example["steps"].as_array().unwrap().iter();
    let steps: f64 = steps.map(|step| step.as_f64().unwrap()).sum();
    let last_ms = example["step"].as_f64().unwrap() * steps;
    assert!((last_ms - 200.0).abs() < 0.2, "{last_ms}");
    // Whole windows stay what they are.
    let mut whole = Events::listen(port, "/api/events?session=two&effects=");
    assert_eq!(whole.until("fitted").pop().unwrap()["shown"], "1.541");
}

/// A stretch that a page shows is never forgotten for another; where there is no room, the page says so, until another page is closed.
#[test]
fn more_stretches_than_there_is_room_for_wait_for_a_page_to_be_closed() {
    let port = workbench();
    let part = |number: usize| format!("/stretch/0.0{number}/0.2");
    let ready = |number: usize| {
        let mut reading = Events::listen(port, &format!("{}/api/reading", part(number)));
        reading.until("ready");
        reading
    };
    let mut shown: Vec<Events> = (1..=6).map(ready).collect();
    for number in 1..=6 {
        let (status, _) = get(port, &format!("{}/api/tightening?number=3", part(number)));
        assert_eq!(status, 200);
    }
    let (status, page) = get(port, &format!("{}?effects=stretch_reflex", part(7)));
    assert_eq!(status, 503);
    assert!(page.contains("close one of these pages first"), "{page}");
    assert!(page.contains("href=\"/?effects=stretch_reflex\""), "{page}");
    shown.remove(2);
    let patience = Instant::now();
    while get(port, &part(7)).0 != 200 {
        assert!(patience.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(100));
    }
    ready(7);
    // Those that are still shown need not be read again.
    for number in [1, 2, 4, 5, 6] {
        let (status, _) = get(port, &format!("{}/api/tightening?number=3", part(number)));
        assert_eq!(status, 200);
    }
}

#[test]
fn a_stretch_beyond_every_window_says_so_and_leads_back() {
    let port = workbench();
    let address = "/stretch/5/6?effects=stretch_reflex";
    Events::listen(port, "/stretch/5/6/api/reading").until("failed");
    let (status, page) = get(port, address);
    assert_eq!(status, 200);
    for told in [
        "24 tightenings took no part",
        "Only what is from 5 to 6 s in a window counts (preprocess.stretch)",
        "href=\"/?effects=stretch_reflex\"",
    ] {
        assert!(page.contains(told), "{page}");
    }
}

#[test]
fn what_is_no_stretch_is_refused() {
    let port = workbench();
    for address in [
        "/stretch/0.2/0.1",
        "/stretch/a/0.1",
        "/stretch/-1/0.1",
        "/stretch/0/inf",
    ] {
        let (status, told) = get(port, address);
        assert_eq!(status, 400, "{address}");
        assert!(told.contains("no stretch of time"), "{told}");
    }
}
