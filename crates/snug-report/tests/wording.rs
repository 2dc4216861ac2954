//! What page and verdict.json say of invented results, word for word.
//!
//! `INSTA_UPDATE=always cargo test --package snug-report --test wording` takes over what was changed on purpose.
#![allow(clippy::unwrap_used, missing_docs)]

mod diagnosed;
mod specimen;

use insta::assert_snapshot;
use serde_json::{Value, json};
use snug_campaign::CampaignResult;
use snug_report::{html, verdict_json};

/// What a reader sees of markup, pictures left out: a line per paragraph, entry or row.
fn text(markup: &str) -> String {
    let mut text = String::new();
    let mut rest = markup;
    while let Some(start) = rest.find('<') {
        text.push_str(&rest[..start].replace(['\n', '\u{a0}'], " "));
        rest = &rest[start + 1..];
        let name: String = rest
            .chars()
            .take_while(|one| !" >".contains(*one))
            .collect();
        text.push_str(match name.as_str() {
            "/p" | "/li" | "/tr" | "/h1" | "/h2" | "/h3" | "/summary" | "/caption" | "/dt"
            | "/dd" | "/figcaption" | "/div" | "/pre" | "/label" => "\n",
            "/td" | "/th" => " | ",
            _ => " ",
        });
        let end = match name.as_str() {
            "script" | "style" | "svg" => format!("</{name}>"),
            _ => ">".to_owned(),
        };
        rest = &rest[rest.find(&end).unwrap() + end.len()..];
    }
    let lines = text.lines().map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        words.join(" ").trim_end_matches([' ', '|']).to_owned()
    });
    let lines: Vec<String> = lines.filter(|line| !line.is_empty()).collect();
    let signs = [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&amp;", "&"),
    ];
    signs.iter().fold(lines.join("\n"), |text, (name, sign)| {
        text.replace(name, sign)
    })
}

/// The chapters that stand between the result and the single tightenings.
fn diagnosis(result: &CampaignResult) -> String {
    let page = html(result);
    let start = page.find("<div class=\"chapter\" id=\"compare\"").unwrap();
    let end = page.find("<div class=\"chapter\" id=\"each\"").unwrap();
    text(&page[start..end])
}

/// Of long lists the first three, of numbers the first six digits: the rest is the invented campaign's.
fn shortened(value: Value) -> Value {
    match value {
        Value::Array(list) => {
            let more = list.len().saturating_sub(3);
            let mut shown: Vec<Value> = list.into_iter().take(3).map(shortened).collect();
            shown.extend((more > 0).then(|| json!(format!("… {more} more"))));
            Value::Array(shown)
        }
        Value::Object(fields) => {
            let fields = fields.into_iter();
            Value::Object(fields.map(|(key, one)| (key, shortened(one))).collect())
        }
        Value::Number(number) if number.is_f64() => {
            let rounded = format!("{:.5e}", number.as_f64().unwrap());
            json!(rounded.parse::<f64>().unwrap())
        }
        other => other,
    }
}

fn verdict(result: &CampaignResult) -> String {
    let json = verdict_json(result.diagnosis.as_ref().unwrap(), result.vocabulary);
    serde_json::to_string_pretty(&shortened(serde_json::from_str(&json).unwrap())).unwrap()
}

#[test]
fn the_page_of_a_campaign() {
    assert_snapshot!(text(&html(&specimen::campaign(4))));
}

#[test]
fn the_page_of_nothing() {
    let mut result = specimen::empty();
    result.tests.clear();
    assert_snapshot!(text(&html(&result)));
}

#[test]
fn what_was_added_until_only_noise_was_left() {
    assert_snapshot!("improve", diagnosis(&diagnosed::improve()));
    assert_snapshot!("improve.json", verdict(&diagnosed::improve()));
}

#[test]
fn what_is_missing() {
    assert_snapshot!("diagnose", diagnosis(&diagnosed::diagnose()));
    assert_snapshot!("diagnose.json", verdict(&diagnosed::diagnose()));
}

#[test]
fn what_is_missing_and_in_no_catalogue() {
    assert_snapshot!("unlisted", diagnosis(&diagnosed::unlisted()));
    assert_snapshot!("unlisted.json", verdict(&diagnosed::unlisted()));
}
