//! Made-up structs that say the units of their numbers, or do not.

use super::*;

/// The lines of the fields that a file is refused for.
fn refused(text: &[&str]) -> Vec<String> {
    refused_at("crates/swing/src/rope.rs", text)
}

fn refused_at(path: &str, text: &[&str]) -> Vec<String> {
    let outcome = check(&[SourceFile::of(path, &text.join("\n"))]);
    let problems = outcome.problems.into_iter();
    problems.map(|problem| problem.file).collect()
}

/// A public struct with one documented field.
fn rope<'a>(words: &'a str, field: &'a str) -> [&'a str; 4] {
    ["pub struct Rope {", words, field, "}"]
}

#[test]
fn a_suffix_is_a_unit() {
    for field in [
        "    pub length_m: f64,",
        "    pub time_s: Vec<f64>,",
        "    pub force_n: Option<Vec<f64>>,",
        "    pub ends_m: [f64; 2],",
        "    pub stretch_ratio: f32,",
        "    pub error_over_noise: Option<f64>,",
        "    pub p_adjusted: Option<f64>,",
    ] {
        assert_eq!(
            refused(&rope("    /// How long.", field)),
            [""; 0],
            "{field}"
        );
    }
}

#[test]
fn numbers_without_a_unit_are_refused_with_their_place() {
    for field in [
        "    pub length: f64,",
        "    pub m: f64,",
        "    pub rates: &'a [f64],",
        "    pub ends: (f64, f64),",
        "    pub knots: [[f64; KNOTS]; 3],",
        "    pub turns: Option<Vec<Option<f64>>>,",
    ] {
        let found = refused(&rope("    /// How long.", field));
        assert_eq!(found, ["crates/swing/src/rope.rs:3"], "{field}");
    }
}

#[test]
fn documentation_may_give_the_unit_or_say_that_there_is_none() {
    for words in [
        "    /// How long \\[m\\].",
        "    /// How long, in the unit of the measurement.",
        "    /// Turns: a count, no unit.",
        "    /// Share of the length that is knots.",
        "    /// Standard errors beyond which it counts.",
    ] {
        assert_eq!(
            refused(&rope(words, "    pub length: f64,")),
            [""; 0],
            "{words}"
        );
    }
}

#[test]
fn a_struct_may_say_it_for_all_its_fields() {
    let fields = ["    /// How long.", "    pub length: f64,", "}"];
    let head = [
        "/// All in the unit of the rope.",
        "#[derive(Debug)]",
        "pub struct Rope {",
    ];
    assert_eq!(refused(&[&head[..], &fields].concat()), [""; 0]);
    let head = [
        "pub struct Rope {",
        "    /// Of the length.",
        "    pub unit: String,",
    ];
    assert_eq!(refused(&[&head[..], &fields].concat()), [""; 0]);
    let other = [
        "/// In the unit of the rope.",
        "fn swing() {}",
        "",
        "pub struct Rope {",
    ];
    assert_eq!(refused(&[&other[..], &fields].concat()).len(), 1);
}

#[test]
fn words_belong_to_the_field_below_them() {
    let text = [
        "pub struct Rope {",
        "    /// How heavy \\[kg\\].",
        "    #[serde(",
        "        default,",
        "    )]",
        "    weight: f64,",
        "    /// How long.",
        "    pub length: f64,",
        "}",
    ];
    assert_eq!(refused(&text), ["crates/swing/src/rope.rs:8"]);
}

#[test]
fn what_no_other_crate_sees_and_what_is_no_number_is_passed_over() {
    for field in [
        "    pub(crate) length: f64,",
        "    length: f64,",
        "    pub knots: usize,",
        "    pub named: Vec<(String, f64)>,",
        "    pub law: fn(f64) -> f64,",
    ] {
        assert_eq!(
            refused(&rope("    /// How long.", field)),
            [""; 0],
            "{field}"
        );
    }
    assert_eq!(
        refused(&rope("", "    pub length: f64,")),
        [""; 0],
        "undocumented"
    );
    let hidden = [
        "pub(crate) struct Rope {",
        "    /// Long.",
        "    pub length: f64,",
        "}",
    ];
    assert_eq!(refused(&hidden), [""; 0]);
}

#[test]
fn libraries_are_looked_at_but_for_those_of_no_field() {
    let text = rope("    /// How long.", "    pub length: f64,");
    assert_eq!(refused_at("crates/swing/src/rope/knot.rs", &text).len(), 1);
    for path in [
        "crates/swing/tests/rope.rs",
        "xtask/src/rope.rs",
        "crates/snug-statistics/src/rank.rs",
    ] {
        assert_eq!(refused_at(path, &text), [""; 0], "{path}");
    }
}
