//! The mystery that ships with Snug, solved by clicking: what promises most is switched on, and the error falls to the noise.

use crate::browser::{Events, get, post, workbench};
use serde_json::{Value, json};

fn choose(port: u16, session: &str, effects: &str) {
    let wish = json!({ "session": session, "kind": "choose", "effects": effects });
    assert_eq!(post(port, "/api/change", &wish).0, 202);
}

fn errors(heard: &[Value]) -> Vec<f64> {
    let steps = heard.iter().filter(|event| event["kind"] == "step");
    steps.map(|step| step["error"].as_f64().unwrap()).collect()
}

#[test]
fn the_effect_that_promises_most_brings_the_error_to_the_noise() {
    let port = workbench();
    let mut page = Events::listen(port, "/api/events?session=one&effects=");
    let begun = page.until("fitted").pop().unwrap();
    assert_eq!(
        (&begun["shown"], &begun["can_undo"]),
        (&json!("1.541"), &json!(false))
    );
    let ranked = page.until("ranked");
    let shares = ranked
        .iter()
        .filter_map(|event| event["shares"].as_array())
        .flatten();
    let best = shares.max_by(|a, b| {
        a["share"]
            .as_f64()
            .partial_cmp(&b["share"].as_f64())
            .unwrap()
    });
    assert_eq!(best.unwrap()["effect"], "stretch_reflex");

    choose(port, "one", "stretch_reflex");
    let heard = page.until("fitted");
    let (steps, found) = (errors(&heard), heard.last().unwrap());
    assert!(steps.len() >= 3, "{steps:?}");
    assert!(steps.windows(2).all(|two| two[1] < two[0]), "{steps:?}");
    assert_eq!(
        (&found["error_before"], &found["shown"]),
        (&json!("1.541"), &json!("1.007"))
    );
    let size = found["sizes"][0]["sizes"][0].as_str().unwrap();
    let size = size.replace('\u{a0}', " ");
    assert_eq!(size, "stiffness of the reflex 638.8 [632.6, 645.0] N/m");
    assert!(
        found["tested"]
            .as_str()
            .unwrap()
            .starts_with("Not yet tested on tightenings")
    );
    // Rivals lose their share once it is in.
    let ranked = page.until("ranked");
    let shares = ranked
        .iter()
        .filter_map(|event| event["shares"].as_array())
        .flatten();
    assert!(
        shares
            .into_iter()
            .all(|one| one["share"].as_f64().unwrap() < 0.02)
    );

    let (status, seen) = get(port, "/api/tightening?number=3&effects=stretch_reflex");
    let seen: Value = serde_json::from_str(&seen).unwrap();
    assert_eq!((status, seen["panels"].as_array().unwrap().len()), (200, 2));
    assert_eq!(seen["told"]["facts"].as_array().unwrap().len(), 3);

    // What was fitted before is not fitted again.
    post(
        port,
        "/api/change",
        &json!({ "session": "one", "kind": "undo" }),
    );
    let back = page.until("fitted");
    assert!(errors(&back).is_empty() && back.last().unwrap()["shown"] == "1.541");
    post(
        port,
        "/api/change",
        &json!({ "session": "one", "kind": "redo" }),
    );
    assert_eq!(page.until("fitted").last().unwrap()["shown"], "1.007");
    // A link shows the same in another tab.
    let mut other = Events::listen(port, "/api/events?session=two&effects=stretch_reflex");
    assert_eq!(other.until("fitted").last().unwrap()["shown"], "1.007");
}

#[test]
fn a_newer_click_ends_the_fit_before() {
    let port = workbench();
    let mut page = Events::listen(port, "/api/events?session=one&effects=");
    page.until("ranked");
    // Play in the grip takes longest; the click behind it is the one that is answered.
    choose(port, "one", "backlash");
    page.until("step");
    choose(port, "one", "torque_delay");
    let heard = page.until("fitted");
    assert_eq!(heard.last().unwrap()["effects"], json!(["torque_delay"]));
    let fitted = |events: &[Value]| {
        events
            .iter()
            .filter(|event| event["kind"] == "fitted")
            .count()
    };
    assert_eq!(fitted(&heard), 1);
    assert_eq!(fitted(&page.until("ranked")), 0);
}

#[test]
fn what_is_not_there_is_said_in_a_sentence() {
    let port = workbench();
    let sentence = |answer: (u16, String), status: u16| {
        assert_eq!(answer.0, status, "{}", answer.1);
        let body: Value = serde_json::from_str(&answer.1).unwrap();
        body["sentence"].as_str().unwrap().to_owned()
    };
    let unknown = sentence(
        get(port, "/api/events?session=one&effects=strech_reflex"),
        400,
    );
    assert!(unknown.contains("stretch_reflex"), "{unknown}");
    let none = sentence(get(port, "/api/tightening?number=25"), 404);
    assert_eq!(none, "there is no tightening 25; there are 1 to 24");
    let fresh = sentence(get(port, "/api/tightening?number=1&effects=backlash"), 404);
    assert!(fresh.contains("not fitted yet"), "{fresh}");
}
