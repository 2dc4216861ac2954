//! A stretch of every window has a workbench of its own.

use crate::browser::{Events, get, post, workbench};
use serde_json::{Value, json};

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
