//! The page as its readers and their browsers get it.
#![allow(clippy::unwrap_used, missing_docs)]

mod markup;
mod specimen;

use snug_campaign::{
    CampaignResult, Finding, Prediction, Rejection, RestartedPrediction, Severity, SignalUnits,
    Validation,
};
use snug_report::html;

/// Text of the page outside scripts and styles, tags taken out.
fn text(page: &str) -> String {
    let mut text = String::new();
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        text.push_str(&rest[..start]);
        rest = &rest[start..];
        let end = ["script", "style"]
            .iter()
            .find(|name| rest[1..].starts_with(**name))
            .map_or(">".to_string(), |name| format!("</{name}>"));
        rest = &rest[rest.find(&end).unwrap() + end.len()..];
        text.push(' ');
    }
    text + rest
}

#[test]
fn every_element_is_closed_and_every_section_is_there() {
    let results = [
        specimen::campaign(24),
        specimen::campaign(1),
        specimen::empty(),
    ];
    let pages = results.map(|result| html(&result));
    for page in &pages {
        markup::start_tags(page).unwrap();
        assert_eq!(markup::sections(page), markup::sections(&pages[0]));
    }
}

#[test]
fn nothing_is_asked_from_outside() {
    let page = html(&specimen::campaign(24));
    for tag in markup::start_tags(&page).unwrap() {
        for (name, allowed) in [("href=\"", &["#", "data:,"][..]), ("src=\"", &[])] {
            for (at, _) in tag.attributes.match_indices(name) {
                let value = &tag.attributes[at + name.len()..];
                assert!(
                    allowed.iter().any(|start| value.starts_with(start)),
                    "{} {}",
                    tag.name,
                    tag.attributes
                );
            }
        }
    }
    // The one address in the page is the name of the SVG vocabulary, which is never fetched.
    let without_vocabulary = page.replace("http://www.w3.org/2000/svg", "");
    for way_out in [
        "http://",
        "https://",
        "@import",
        "fetch(",
        "XMLHttpRequest",
        "url(h",
    ] {
        assert!(!without_vocabulary.contains(way_out), "{way_out}");
    }
}

#[test]
fn hostile_names_stay_text() {
    let attack = "\"><script>alert(1)</script><img src=x onerror='1'>&amp;</title></style>";
    let mut result = specimen::campaign(4);
    let harmless = markup::start_tags(&html(&result)).unwrap().len();
    result.title = attack.into();
    result.study_ron = attack.into();
    result.preset = attack.into();
    result.fitted_output = attack.into();
    result.effects = vec![attack.into()];
    for tightening in &mut result.tightenings {
        tightening.id.file = attack.into();
        tightening.conditions.participant = Some(attack.into());
        for correction in &mut tightening.corrections {
            correction.effect = attack.into();
            correction.unit = attack.into();
        }
        if let Some(estimate) = &mut tightening.estimate {
            estimate.parameters[3].name = attack.into();
            estimate.parameters[3].unit = attack.into();
            estimate.active_constraints = vec![];
        }
    }
    for finding in &mut result.findings {
        finding.message = attack.into();
        finding.channel = Some(attack.into());
        finding.code = attack.into();
    }
    for row in &mut result.tests {
        row.method = attack.into();
        row.note = Some(attack.into());
        for check in &mut row.assumptions {
            check.assumption = attack.into();
            check.method = attack.into();
            check.statistic_name = attack.into();
        }
    }
    let page = html(&result);
    let tags = markup::start_tags(&page).unwrap();
    assert!(tags.len() < 2 * harmless);
    assert!(tags.iter().all(|tag| tag.name != "img"));
    let scripts = |page: &str| page.matches("<script").count();
    assert_eq!(scripts(&page), 2, "the data and the page's own");
    assert!(text(&page).contains("&lt;script&gt;alert(1)"));
}

#[test]
fn what_tests_presume_says_what_it_cannot() {
    let mut result = specimen::campaign(24);
    // A test that could not be made is nobody's to read, and a check that could not be made says why.
    for row in &mut result.tests {
        row.p = row.p.filter(|_| row.method != "kruskal_wallis");
        for check in &mut row.assumptions {
            if check.values == 20 && row.factor == "pace_per_min" {
                check.p = None;
                check.note = Some("valid up to 5000".into());
            }
        }
    }
    let page = html(&result);
    assert!(text(&page).contains("unequal variances: no test beside presumes less."));
    assert!(
        page.contains("20 residuals (6 tied): <span class=\"missing\" title=\"valid up to 5000\">")
    );
    // Results of before the checks have no line for them.
    result
        .tests
        .iter_mut()
        .for_each(|row| row.assumptions.clear());
    let page = html(&result);
    assert!(!page.contains("<tr class=\"checks\">") && !text(&page).contains("presume"));
}

#[test]
fn the_headline_says_how_many_and_how_well() {
    let result = specimen::campaign(24);
    let words = text(&html(&result));
    assert!(
        words.contains("20 of 24 tightenings (83.3 %) are usable"),
        "headline"
    );
    assert!(words.contains("plus cubic stiffness"), "model");
    assert!(
        words.contains("24 tightenings in 12 files, by 6 participants"),
        "measured"
    );
}

#[test]
fn validation_windows_are_not_counted_as_failures() {
    let mut result = specimen::campaign(4);
    for index in [1, 2, 3] {
        result.tightenings[index].selection.rejections = vec![Rejection::Validation];
    }
    let words = text(&html(&result));
    assert!(words.contains("1 of 1 tightening (100.0 %)"));
    assert!(words.contains("3 were kept for validation"));
}

/// Both ways of running the model, each with its fit and residual; what could not be restarted says so.
#[test]
fn what_was_kept_for_validation_stands_with_both_numbers() {
    let mut result = specimen::campaign(4);
    result.fitted_output = "velocity".into();
    let of = |fit_percent, rms| Prediction {
        fit_percent: Some(fit_percent),
        rms: Some(rms),
    };
    let restarted = RestartedPrediction {
        every_s: 0.125,
        prediction: of(97.5, 0.0123),
    };
    for (index, restarted) in [(1, Some(restarted)), (2, None)] {
        result.tightenings[index].selection.rejections = vec![Rejection::Validation];
        result.tightenings[index].validation = Some(Validation {
            free_run: of(83.2, 0.0987),
            restarted,
        });
    }
    let words = text(&html(&result));
    assert!(words.contains("How well it predicts what took no part in the fit"));
    for told in [
        "83.2",
        "0.09870",
        "97.5",
        "0.01230",
        "0.125",
        "residual [rad/s]",
    ] {
        assert!(words.contains(told), "{told}");
    }
    let plain = text(&html(&specimen::campaign(4)));
    assert!(!plain.contains("took no part in the fit"));
}

#[test]
fn axes_and_columns_carry_units() {
    let words = text(&html(&specimen::campaign(24)));
    for label in [
        "mass m [kg]",
        "damping c [kg/s]",
        "stiffness k [N/m]",
        "natural frequency fₙ [Hz]",
        "cubic stiffness [N/m³]",
        "angle θ [rad]",
        "acceleration α [rad/s²]",
        "force [N]",
        "joint torque T [Nm]",
        "actual peak torque [Nm]",
        "acceleration bias [rad/s²]",
        "fit [%]",
    ] {
        assert!(words.contains(label), "{label}");
    }
}

/// The facts of every example in the viewer's data: name, value with unit, interval.
fn facts(page: &str) -> Vec<[String; 3]> {
    let data = viewer_data(page);
    let examples = data["examples"].as_array().unwrap().iter();
    examples
        .flat_map(|example| serde_json::from_value::<Vec<[String; 3]>>(example["facts"].clone()))
        .flatten()
        .collect()
}

fn viewer_data(page: &str) -> serde_json::Value {
    let start = page.find("id=\"viewer-data\">").unwrap() + "id=\"viewer-data\">".len();
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

#[test]
fn every_number_of_a_tightening_has_an_interval_or_says_what_it_is() {
    let facts = facts(&html(&specimen::campaign(4)));
    let of = |name: &str| facts.iter().find(|fact| fact[0] == name).unwrap();
    assert_eq!(
        of("damped frequency with the tool")[2],
        "[3.062,\u{a0}3.138]"
    );
    assert_eq!(
        of("damping ratio ζ with the tool")[2],
        "[0.348,\u{a0}0.372]"
    );
    assert_eq!(of("|F3|")[2], "largest of this window");
    for fact in &facts {
        assert!(!fact[2].is_empty(), "{fact:?}");
    }
}

#[test]
fn key_numbers_show_one_statistic_with_its_own_interval() {
    let result = specimen::campaign(24);
    let words = text(&html(&result));
    let mass = result.conditions[0].quantities[0]
        .selected
        .as_ref()
        .unwrap();
    let card = &words[words.find("Mass m, mean").unwrap()..];
    let card = &card[..card.find("Damping").unwrap()];
    assert!(card.contains(&format!("{:.2}", mass.mean)), "{card}");
    assert!(card.contains("95 % interval ["), "{card}");
    assert!(!card.contains("median"), "{card}");
}

#[test]
fn bars_say_their_unit() {
    let page = html(&specimen::campaign(24));
    let bar = page.split("<title>").find(|text| {
        text.starts_with(|c: char| c.is_ascii_digit()) && text.contains(" kg</title>")
    });
    assert!(bar.unwrap().contains("tightening"), "{bar:?}");
}

#[test]
fn a_rig_that_measures_volts_shows_volts() {
    let mut result = specimen::campaign(4);
    result.units = SignalUnits {
        input: "V".into(),
        output: "V".into(),
        input_per_nm: 1.0,
        output_per_rad: 1.0,
    };
    let page = html(&result);
    let data = viewer_data(&page).to_string();
    assert!(!data.contains("rad") && !data.contains("Nm") && !data.contains("kg"));
    let words = text(&page);
    // The glossary explains the mechanical terms and says what stands for them.
    let (words, glossary) = words.split_at(words.rfind("Terms, symbols and units").unwrap());
    assert!(glossary.contains("its input in V and its output in V"));
    for label in [
        "output [V]",
        "input [V]",
        "mass m [V/(V/s²)]",
        "stiffness k [V/V]",
    ] {
        assert!(words.contains(label), "{label}");
    }
    for label in [
        "joint torque T [Nm]",
        "mass m [kg]",
        "force [N]",
        "hand and arm",
    ] {
        assert!(!words.contains(label), "{label}");
    }
}

#[test]
fn a_rig_that_measures_lengths_shows_metres() {
    let mut result = specimen::campaign(1);
    result.units.output = "m".into();
    result.units.output_per_rad = 0.5;
    let data = viewer_data(&html(&result));
    assert_eq!(data["panels"][0]["axis"], "displacement of the grip [m]");
    let drawn = data["examples"][0]["signals"][0][0].as_array().unwrap();
    let angle_rad = result.examples[0]
        .1
        .measured
        .displacement_rad
        .as_ref()
        .unwrap();
    let last = drawn.last().unwrap().as_f64().unwrap();
    assert!((last - 0.5 * angle_rad[2999]).abs() <= 5e-6 * last.abs());
}

#[test]
fn small_p_values_are_not_zero_and_untestable_ones_say_why() {
    let page = html(&specimen::campaign(24));
    assert!(text(&page).contains("&lt; 0.001"));
    assert!(page.contains("title=\"each participant has one pace only\""));
}

fn spoiled() -> CampaignResult {
    let mut result = specimen::campaign(4);
    result.findings.clear();
    for tightening in &mut result.tightenings {
        tightening.peak_torque_nm = f64::NAN;
        tightening.target_torque_nm = f64::INFINITY;
        tightening.measures.fit_percent = Some(f64::NAN);
        tightening.measures.error_over_noise = Some(f64::NEG_INFINITY);
        tightening.conditions.pace_per_min = Some(f64::NAN);
        tightening.corrections[0].value = f64::NAN;
        for parameter in tightening
            .estimate
            .iter_mut()
            .flat_map(|e| &mut e.parameters)
        {
            parameter.value = f64::NAN;
            if let Some(interval) = &mut parameter.interval {
                interval.low = f64::NEG_INFINITY;
                interval.high = f64::NAN;
            }
        }
        if let Some(estimate) = &mut tightening.estimate {
            estimate.identifiability.condition = f64::INFINITY;
            estimate.identifiability.strongest_correlation =
                Some(("mass_kg".into(), "stiffness_n_per_m".into(), f64::NAN));
        }
        if let Some(noise) = &mut tightening.noise {
            noise.standard_deviation = f64::NAN;
        }
    }
    for (_, traces) in &mut result.examples {
        traces.torque_nm.fill(f64::NAN);
        traces.force_f1_n[7] = f64::INFINITY;
        traces.force_f2_n.truncate(10);
        traces.force_f3_n.clear();
    }
    for row in result.conditions.iter_mut().flat_map(|c| &mut c.quantities) {
        if let Some(moments) = &mut row.selected {
            moments.mean = f64::NAN;
            moments.standard_deviation = Some(f64::INFINITY);
            moments.mean_interval = None;
        }
    }
    for row in &mut result.tests {
        row.p = Some(f64::NAN);
        row.statistic = Some(f64::INFINITY);
        for check in &mut row.assumptions {
            check.p = Some(f64::NAN);
            check.statistic = Some(f64::INFINITY);
            check.degrees_of_freedom.fill(f64::NAN);
        }
    }
    result
}

#[test]
fn what_is_not_finite_never_reaches_the_reader() {
    let page = html(&spoiled());
    markup::start_tags(&page).unwrap();
    let words = text(&page);
    for word in ["NaN", "inf ", "inf]", "inf,", "∞"] {
        assert!(!words.contains(word), "{word}");
    }
    markup::assert_finite_attributes(&page);
}

#[test]
fn the_data_of_the_viewer_are_the_measured_samples() {
    let result = specimen::campaign(2);
    let page = html(&result);
    let data = viewer_data(&page);
    let example = &data["examples"][1];
    let panel = data["panels"]
        .as_array()
        .unwrap()
        .iter()
        .position(|panel| panel["title"] == "Torque pulse")
        .unwrap();
    let drawn = example["signals"][panel][0].as_array().unwrap();
    let mut sample = 0;
    for (step, value) in example["steps"].as_array().unwrap().iter().zip(drawn) {
        sample += step.as_u64().unwrap() as usize;
        let measured = result.examples[1].1.torque_nm[sample];
        assert!((value.as_f64().unwrap() - measured).abs() <= 5e-6 * measured.abs());
    }
    assert_eq!(sample, 2999, "the last sample is drawn");
}

#[test]
fn a_page_of_24_tightenings_stays_below_3_megabytes() {
    let size = html(&specimen::campaign(24)).len();
    assert!(size < 3_000_000, "{size} bytes");
}

#[test]
fn the_same_result_gives_the_same_bytes() {
    assert_eq!(html(&specimen::campaign(24)), html(&specimen::campaign(24)));
}

#[test]
fn an_empty_campaign_says_so_and_keeps_its_findings() {
    let mut result = specimen::empty();
    result.findings = vec![Finding {
        severity: Severity::LeftOut,
        code: "missing_channel".into(),
        file: "a.mat".into(),
        tightening: None,
        channel: Some("Inline_Torque".into()),
        message: "no torque channel; the file was left out".into(),
    }];
    let words = text(&html(&result));
    assert!(words.contains("No tightening was found"));
    assert!(words.contains("no torque channel; the file was left out"));
}
