//! Reading the reference tables, and comparing with them.

use serde_json::Value;

/// Parses a table of the folder `reference`.
pub fn table(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// The cases of a table.
pub fn cases(text: &str) -> Vec<Value> {
    table(text)["cases"].as_array().unwrap().clone()
}

/// A JSON array as numbers.
pub fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

/// A JSON array as ids.
pub fn ids(value: &Value) -> Vec<usize> {
    numbers(value).iter().map(|x| *x as usize).collect()
}

/// A JSON array as text.
pub fn texts(value: &Value) -> Vec<String> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_str().unwrap().to_owned())
        .collect()
}

/// Asserts agreement relative to the larger of the expected value and `floor`.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, relative: f64, floor: f64, what: &str) {
    let allowed = relative * expected.abs().max(floor);
    assert!(
        (found - expected).abs() <= allowed,
        "{what}: found {found:e}, expected {expected:e}, off by {:e} > {allowed:e}",
        (found - expected).abs()
    );
}

/// [`assert_near`] over two slices of one length.
#[track_caller]
pub fn assert_all_near(found: &[f64], expected: &[f64], relative: f64, floor: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: lengths");
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_near(
            *found,
            *expected,
            relative,
            floor,
            &format!("{what}[{index}]"),
        );
    }
}
