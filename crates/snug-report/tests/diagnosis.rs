//! The page's sections about what is missing in the model.
#![allow(clippy::unwrap_used, missing_docs)]

mod diagnosed;
mod markup;
mod specimen;

use snug_campaign::words::headline::{Fall, Headline, Left};
use snug_campaign::{CampaignResult, Comparison, Diagnosis, Location, WorkDone};
use snug_report::html;

/// Names of the sections that a page has because of its diagnosis.
fn found(page: &str) -> Vec<&str> {
    let plain = html(&specimen::empty());
    let usual = markup::sections(&plain);
    let mut sections = markup::sections(page);
    sections.retain(|name| !usual.contains(name));
    sections
}

/// The markup of one section; `None` when the page does not have it.
fn section<'a>(page: &'a str, anchor: &str) -> Option<&'a str> {
    let start = page.find(&format!("<section id=\"{anchor}\""))?;
    let end = page[start..].find("</section>").unwrap();
    Some(&page[start..start + end])
}

/// Text of one section, tags, pictures' titles and inlined data taken out, spaces made plain.
fn words(page: &str, anchor: &str) -> String {
    let mut rest = section(page, anchor).unwrap();
    let mut text = String::new();
    while let Some(start) = rest.find('<') {
        text.push_str(&rest[..start]);
        let tag = &rest[start..];
        let close = if tag.starts_with("<script") {
            "</script>"
        } else {
            ">"
        };
        rest = &tag[tag.find(close).unwrap() + close.len()..];
        text.push(' ');
    }
    let text = (text + rest).replace('\u{a0}', " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn has(page: &str, anchor: &str, sentences: &[&str]) {
    let words = words(page, anchor);
    for sentence in sentences {
        assert!(
            words.contains(sentence),
            "{anchor} lacks “{sentence}”: {words}"
        );
    }
}

fn with(change: impl Fn(&mut Diagnosis)) -> CampaignResult {
    let mut result = diagnosed::improve();
    change(result.diagnosis.as_mut().unwrap());
    result
}

#[test]
fn sections_stand_as_one_asks_and_only_with_a_diagnosis() {
    let page = html(&diagnosed::improve());
    let sections = markup::sections(&page);
    let asked = [
        "comparison",
        "location",
        "verdict",
        "ranking",
        "before-after",
        "ladder",
        "detectability",
    ];
    assert_eq!(sections[0], "overview");
    assert!(sections[1..].starts_with(&asked), "{sections:?}");
    assert_eq!(sections.last(), Some(&"effort"));
    assert_eq!(found(&page), [&asked[..], &["effort"]].concat());
}

#[test]
fn the_ladder_is_drawn() {
    let page = html(&diagnosed::improve());
    let picture = section(&page, "ladder").unwrap();
    // The bars of three rungs on a logarithmic axis: a longer error is a longer bar, and equal factors equal lengths.
    let bars = picture.split("g class=\"bars c-faint\"").nth(1).unwrap();
    let width = |bar: usize| -> f64 {
        let rect = bars.split("<rect").nth(bar + 1).unwrap();
        rect.split("width=\"")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap()
            .parse()
            .unwrap()
    };
    let per_factor = (width(0) - width(2)) / (6.42_f64 / 1.018).ln();
    let middle = (width(1) - width(2)) / (1.38_f64 / 1.018).ln();
    assert!(
        (per_factor - middle).abs() < 0.01 * per_factor,
        "{per_factor} {middle}"
    );
}

#[test]
fn without_noise_the_ladder_is_in_the_output_s_unit() {
    let page = html(&with(|diagnosis| {
        for rung in &mut diagnosis.ladder {
            rung.error_over_noise = None;
            rung.heldout_error_over_noise = None;
        }
    }));
    has(
        &page,
        "ladder",
        &[
            "root mean square of the residual [rad/s²]",
            "how much of that is noise is not known",
        ],
    );
}

#[test]
fn before_and_after_hold_the_measured_and_both_simulated_samples() {
    let result = diagnosed::improve();
    let page = html(&result);
    let worst = &result.diagnosis.as_ref().unwrap().comparison.tightenings[0];
    let mut examples = result.examples.iter();
    let (_, traces) = examples
        .find(|(index, _)| result.tightenings[*index].id == worst.id)
        .unwrap();
    has(
        &page,
        "before-after",
        &[
            &worst.id.to_string(),
            "24 of 24 tightenings",
            "measured − simulated [rad/s²]",
        ],
    );
    let start = page.find("id=\"showcase-data\">").unwrap() + "id=\"showcase-data\">".len();
    let end = start + page[start..].find("</script>").unwrap();
    let data: serde_json::Value = serde_json::from_str(&page[start..end]).unwrap();
    let example = &data["examples"][0];
    let acceleration = data["panels"]
        .as_array()
        .unwrap()
        .iter()
        .position(|panel| panel["axis"] == "acceleration α [rad/s²]")
        .unwrap();
    let read = |line: usize| example["signals"][acceleration][line].as_array().unwrap();
    let mut sample = 0;
    for (point, step) in example["steps"].as_array().unwrap().iter().enumerate() {
        sample += step.as_u64().unwrap() as usize;
        for (line, motion) in [
            (0, &traces.measured),
            (1, &traces.before),
            (2, &traces.simulated),
        ] {
            let truth = motion.acceleration_rad_per_s2.as_ref().unwrap()[sample];
            let drawn = read(line)[point].as_f64().unwrap();
            assert!(
                (drawn - truth).abs() <= 5e-6 * truth.abs(),
                "{line} {sample}"
            );
        }
    }
    assert_eq!(sample, 2999, "the last sample is drawn");
}

#[test]
fn the_places_of_failure_are_drawn() {
    let page = html(&diagnosed::improve());
    // k3 x³ at the map's largest displacement, 33 mm: 35.6 N; the scale is a quarter of it.
    has(&page, "location", &["27 to 36 N"]);
    let map = section(&page, "location").unwrap();
    assert!(map.contains("x = 33.0 mm"), "the cell's words");
    assert!(map.contains("heat unsure"), "cells whose band holds zero");
}

#[test]
fn errors_stand_by_tightening() {
    let page = html(&diagnosed::improve());
    let comparison = section(&page, "comparison").unwrap();
    assert_eq!(
        comparison.matches("data-v=").count(),
        24 * 7,
        "three quantities with rms and fit, one with error over noise"
    );
}

#[test]
fn absent_parts_leave_their_sections_out() {
    let mut result = with(|diagnosis| {
        diagnosis.ladder.clear();
        diagnosis.ranking.clear();
        diagnosis.added.clear();
        diagnosis.corrected.clear();
        diagnosis.removals.clear();
        diagnosis.drift.clear();
        diagnosis.reasons.clear();
        diagnosis.detectability.clear();
        diagnosis.comparison = Comparison::default();
        diagnosis.location = Location::default();
        diagnosis.final_location = None;
        diagnosis.control = None;
        diagnosis.work = WorkDone::default();
        diagnosis.stopped = None;
    });
    for (_, traces) in &mut result.examples {
        traces.before = snug_campaign::Motion::default();
    }
    let page = html(&result);
    markup::start_tags(&page).unwrap();
    assert_eq!(found(&page), ["verdict"]);
}

#[test]
fn what_is_not_finite_never_reaches_the_reader() {
    let mut result = with(|diagnosis| {
        for rung in &mut diagnosis.ladder {
            rung.error_over_noise = Some(f64::NAN);
            rung.rms_fitted_output = f64::INFINITY;
            rung.selected_fraction = f64::NAN;
        }
        for candidate in &mut diagnosis.ranking {
            candidate.heldout_gain = f64::NAN;
            candidate.p_family = f64::NAN;
            candidate.parameters[0].value = f64::NAN;
        }
        for part in diagnosis
            .location
            .aspects
            .iter_mut()
            .flat_map(|aspect| &mut aspect.parts)
        {
            part.error_over_noise = f64::NAN;
            part.share_of_excess = f64::NAN;
            part.to = Some(f64::INFINITY);
        }
        diagnosis.location.force_over_time.low_n.fill(f64::NAN);
        diagnosis
            .location
            .force_over_time
            .force_n
            .fill(f64::INFINITY);
        diagnosis.location.force_map.force_n.fill(Some(f64::NAN));
        diagnosis.drift[0].change_percent = f64::NAN;
        diagnosis.comparison.pooled[0].rms = f64::NAN;
        diagnosis.detectability[0].smallest_detectable = Some(f64::INFINITY);
    });
    let (_, traces) = &mut result.examples[0];
    let simulated = &mut traces.simulated.acceleration_rad_per_s2;
    simulated.as_mut().unwrap().truncate(7);
    let before = &mut traces.before.displacement_rad;
    before.as_mut().unwrap().fill(f64::NAN);
    let page = html(&result);
    markup::assert_finite_attributes(&page);
    for anchor in found(&page) {
        let words = words(&page, anchor);
        for word in ["NaN", " inf", "∞"] {
            assert!(!words.contains(word), "{anchor}: {words}");
        }
    }
}

#[test]
fn hostile_names_stay_text() {
    let attack = "\"></script><script>alert(1)</script><img src=x onerror='1'>";
    let harmless = html(&diagnosed::unlisted()).matches("<script").count();
    let mut result = diagnosed::unlisted();
    let diagnosis = result.diagnosis.as_mut().unwrap();
    diagnosis.headline = Headline::Lacks {
        effect: diagnosed::named(attack),
        fall: Fall {
            before: Left::over_noise(2.0),
            after: Left::over_noise(1.0),
        },
    };
    diagnosis.compared_output = attack.into();
    diagnosis.noise.source = attack.into();
    diagnosis.ranking[0].effect = attack.into();
    diagnosis.ranking[0].twins = vec![attack.into()];
    diagnosis.ranking[0].parameters[0].unit = attack.into();
    diagnosis.location.aspects[1].aspect = attack.into();
    diagnosis.location.aspects[1].parts[0].part = attack.into();
    diagnosis.comparison.pooled[0].quantity = attack.into();
    diagnosis.comparison.tightenings[0].id.file = attack.into();
    diagnosis.unlisted.as_mut().unwrap().ron = attack.into();
    let page = html(&result);
    let tags = markup::start_tags(&page).unwrap();
    assert!(tags.iter().all(|tag| tag.name != "img"));
    assert_eq!(page.matches("<script").count(), harmless);
}
