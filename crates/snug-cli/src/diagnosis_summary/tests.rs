//! Made-up diagnoses on the screen: width, digits, bars, and the next command that every verdict leads to.
#![allow(clippy::unwrap_used)]

use super::{Following, WIDTH, text};
use crate::terminal;
use snug_campaign::words::effect_name::Named;
use snug_campaign::words::headline::{Fall, Headline, Left};
use snug_campaign::words::reason::Reason;
use snug_campaign::words::remark::Remark;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::*;

const FOLLOWING: Following = Following {
    options: "--study rig.ron",
    written: "out/study.ron",
};

fn parameter(name: &str, unit: &str, value: f64, low: f64, high: f64) -> EffectParameter {
    EffectParameter {
        name: name.into(),
        meaning: "cubic stiffness".into(),
        unit: unit.into(),
        value,
        low: Some(low),
        high: Some(high),
        standard_error: None,
        per_tightening: false,
        spread: None,
        minimum: -1e7,
        maximum: 1e7,
        by_group: None,
    }
}

fn candidate(effect: &str, gain: f64, p: f64, size: EffectParameter) -> RankedEffect {
    RankedEffect {
        effect: effect.into(),
        kind: "mechanical".into(),
        unlisted: false,
        expression: None,
        parameters: vec![size],
        score: 9.0,
        p_family: p,
        heldout_gain: gain,
        heldout_gain_error: 0.04,
        error_over_noise: Some(1.4),
        behind_first: 0.0,
        supported: p <= 0.05,
        twins: vec!["quadratic_stiffness".into()],
        plausible: true,
        explanation: vec![format!("How {effect} shows in a measurement.")],
    }
}

fn rung(effects: &[&str], error: Option<f64>, selected: f64) -> Rung {
    Rung {
        effects: effects.iter().map(|name| (*name).into()).collect(),
        error_over_noise: error,
        heldout_error_over_noise: error.map(|error| 1.01 * error),
        heldout_target_error_over_noise: None,
        heldout_participant_error_over_noise: None,
        rms_fitted_output: 3.0 * selected,
        rms_displacement_rad: None,
        fit_percent_median: None,
        selected_fraction: selected,
        ranking: vec![],
    }
}

/// So many that the headline takes more than a line.
const TWINS: [&str; 5] = [
    "quadratic_stiffness",
    "directional_damping",
    "coulomb_friction",
    "stretch_reflex",
    "end_stop",
];

fn named(effect: &str, twins: &[&str]) -> Named {
    Named {
        effect: effect.into(),
        expression: None,
        says: None,
        twins: twins.iter().map(|twin| named(twin, &[])).collect(),
    }
}

fn missing() -> Diagnosis {
    Diagnosis {
        verb: "diagnose".into(),
        verdict: Verdict::MissingEffect,
        headline: Headline::Lacks {
            effect: named("cubic_stiffness", &TWINS),
            fall: Fall {
                before: Left::over_noise(6.4),
                after: Left::over_noise(1.38),
            },
        },
        reasons: vec![Reason::Error {
            tightenings: 24,
            error: 6.4,
            is_at_floor: false,
            hardly_repeats: false,
        }],
        stopped: None,
        level: 0.05,
        interrupted: false,
        tightenings: 24,
        noise: NoiseStatement {
            source: "pre_roll".into(),
            acceleration_rad_per_s2: Some(0.5),
        },
        compared_output: "acceleration".into(),
        added: vec![],
        corrected: vec![],
        ladder: vec![
            rung(&[], Some(6.4), 0.42),
            rung(&["cubic_stiffness"], Some(1.38), 0.88),
            rung(&["cubic_stiffness", "torque_delay"], Some(1.0), 0.96),
        ],
        ranking: (0..11)
            .map(|place| {
                let size = parameter("k3_n_per_m3", "N/m^3", 9.9e5, 9.606e5, 1.0194e6);
                candidate(&format!("effect_{place}"), 0.83, 0.0004, size)
            })
            .collect(),
        removals: vec![],
        comparison: Comparison::default(),
        location: Location {
            remarks: vec![Remark::Repeats(0.97)],
            ..Location::default()
        },
        final_location: None,
        drift: vec![],
        detectability: vec![],
        control: Some(NegativeControl {
            campaigns: 40,
            false_alarms: 2,
            nominal_rate: 0.05,
            rate_low: 0.014,
            rate_high: 0.165,
        }),
        unlisted: None,
        experiment: None,
        work: WorkDone::default(),
    }
}

fn blocks(text: &str, line: &str) -> usize {
    let line = text.lines().find(|l| l.contains(line)).unwrap();
    line.matches('#').count()
}

#[test]
fn the_verdict_leads_and_the_next_command_closes() {
    let text = text(&missing(), &FOLLOWING, Vocabulary::Hand, None);
    let first = text.trim_start().lines().next().unwrap();
    assert_eq!(first, "Verdict: an effect is missing");
    assert!(text.contains("    snug add effect_0 --study rig.ron\n"));
    assert!(text.trim_end().ends_with("snug improve --study rig.ron"));
    assert!(text.contains("97 % of the misfit can be predicted"));
}

#[test]
fn on_a_narrow_terminal_no_line_is_wider_and_no_bar_is_broken() {
    let told = text(&missing(), &FOLLOWING, Vocabulary::Hand, Some(80));
    let shown = terminal::wrapped(&told, 80);
    for line in shown.lines() {
        let is_command = line.trim_start().starts_with("cargo ");
        assert!(is_command || terminal::visible(line) <= 80, "{line}");
    }
    let bars = |text: &str| text.lines().filter(|line| line.contains("%  |")).count();
    assert_eq!(bars(&shown), missing().ladder.len());
}

#[test]
fn columns_are_explained_before_they_are_used() {
    let told = text(&missing(), &FOLLOWING, Vocabulary::Hand, None);
    for (explained, used) in [
        ("unseen: ", " unseen "),
        ("selected: ", " selected\n"),
        ("chance: ", " chance "),
    ] {
        let first = |words: &str| told.find(words).unwrap();
        assert!(first(explained) < first(used), "{used}: {told}");
    }
}

#[test]
fn lines_keep_their_width_and_plain_text_has_no_colours() {
    let plain = text(&missing(), &FOLLOWING, Vocabulary::Hand, None);
    for line in plain.lines() {
        assert!(line.chars().count() <= WIDTH + 2, "{line}");
    }
    assert!(!plain.contains('\u{1b}') && !plain.contains('█'));
    assert!(text(&missing(), &FOLLOWING, Vocabulary::Hand, Some(200)).contains('\u{1b}'));
}

#[test]
fn sizes_stand_with_unit_and_interval() {
    let text = text(&missing(), &FOLLOWING, Vocabulary::Hand, None);
    assert!(text.contains("cubic stiffness 9.90 × 10⁵ [9.61, 10.19] × 10⁵ N/m³"));
    assert!(text.contains("83 ± 4 %"));
    assert!(text.contains("< 0.001"));
    assert!(text.contains("effect_7") && !text.contains("effect_8"));
    assert!(text.contains("the best 8 of 11 candidates"));
}

/// What it is, how it shows, what to check; and twins of the first only, since the others are no question any more.
#[test]
fn what_is_missing_is_explained() {
    let mut diagnosis = missing();
    diagnosis.ranking[0].explanation = vec!["The hand's spring becomes stiffer.".into()];
    diagnosis.ranking[0].heldout_gain = 1.73;
    let text = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(text.contains("What effect 0 is\n  - The hand's spring becomes stiffer.\n"));
    assert_eq!(text.matches("cannot be told from").count(), 1);
    assert!(text.contains("100 ± 4 %") && !text.contains("173"));
}

fn said(size: &EffectParameter) -> String {
    size.size().to_string().replace('\u{a0}', " ")
}

#[test]
fn zero_is_zero_and_units_follow_the_value() {
    let mut size = parameter("gap_m", "m", 1.3e-7, 0.0, 3.1e-7);
    assert_eq!(
        said(&size),
        "cubic stiffness 1.3 × 10⁻⁷ [0.0, 3.1] × 10⁻⁷ m"
    );
    size.low = None;
    assert_eq!(said(&size), "cubic stiffness 1.300 × 10⁻⁷ m (no interval)");
    let size = parameter("bias", "rad/s^2", 0.13, -0.001, 0.26);
    assert!(said(&size).contains("[0.00, 0.26]"));
}

#[test]
fn terms_in_no_catalogue_stand_only_among_the_first_and_unsure_shares_are_no_percentage() {
    let mut diagnosis = missing();
    for place in [1, 4, 6] {
        diagnosis.ranking[place].unlisted = true;
        diagnosis.ranking[place].expression = Some(format!("p*x^{place}"));
    }
    diagnosis.ranking[0].heldout_gain = 0.72;
    diagnosis.ranking[0].heldout_gain_error = 6.17;
    let text = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(text.contains("  force p*x^1 "));
    assert!(!text.contains("p*x^4") && !text.contains("p*x^6"));
    assert!(text.contains("3 of the candidates are simple forces"));
    assert!(text.contains("nothing sure") && !text.contains("617"));
}

#[test]
fn bars_shrink_to_nothing_at_the_floor() {
    let text = text(&missing(), &FOLLOWING, Vocabulary::Hand, None);
    let base = blocks(&text, "base model");
    let middle = blocks(&text, "+ cubic_stiffness");
    assert_eq!(base, 36);
    // ln 1.38 / ln 6.4 = 0.1735 of 36 columns.
    assert_eq!(middle, 6);
    assert_eq!(blocks(&text, "+ torque_delay"), 0);
}

#[test]
fn without_noise_the_error_has_the_output_s_name() {
    let mut diagnosis = missing();
    diagnosis.ladder = vec![rung(&[], None, 1.0), rung(&["sin"], None, 0.5)];
    let text = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(text.contains("residual of the acceleration"));
    assert_eq!(blocks(&text, "base model"), 36);
    assert_eq!(blocks(&text, "+ sin"), 18);
}

fn damping_with_x2() -> UnlistedTerm {
    UnlistedTerm {
        expression: "p*x^2*v".into(),
        ron: "(name: \"x2v\")".into(),
        heldout_gain: 0.7,
        statement: "A damping that grows with x².".into(),
    }
}

#[test]
fn every_verdict_says_what_to_do() {
    let mut diagnosis = missing();
    diagnosis.verb = "compare".into();
    assert!(
        text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None)
            .trim_end()
            .ends_with("snug diagnose --study rig.ron")
    );
    diagnosis.verdict = Verdict::Undecided;
    let compared = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(compared.contains("Verdict: the model leaves more than the noise"));
    assert!(!compared.contains("too little data"));
    diagnosis.verb = "improve".into();
    diagnosis.verdict = Verdict::Adequate;
    assert!(
        text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None).contains("Nothing needs to be added")
    );
    diagnosis.verdict = Verdict::Undecided;
    assert!(
        text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None).contains("how much more would decide")
    );
    diagnosis.verdict = Verdict::UnlistedEffect;
    diagnosis.unlisted = Some(damping_with_x2());
    let found = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(found.contains("    (name: \"x2v\")\n"));
    assert!(!found.contains("snug improve"), "it was already asked to");
    diagnosis.verb = "diagnose".into();
    let found = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    let last = "snug improve --study rig.ron";
    assert!(found.trim_end().ends_with(last));
}

/// What is explained is the law that the verdict names, as long as it is not in the model; never another of its kind.
#[test]
fn only_a_law_that_is_still_missing_is_explained() {
    let mut diagnosis = missing();
    diagnosis.verdict = Verdict::UnlistedEffect;
    diagnosis.unlisted = Some(damping_with_x2());
    diagnosis.ranking[0].unlisted = true;
    diagnosis.ranking[0].expression = Some("p*v^3".into());
    let added = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(!added.contains("What force") && added.contains("What else was tried"));
    diagnosis.ranking[2].unlisted = true;
    diagnosis.ranking[2].expression = Some("p*x^2*v".into());
    let named = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(named.contains("What force p*x^2*v is") && !named.contains("What force p*v^3 is"));
    assert!(!named.contains("What else was tried"));
}

/// Who stopped the climb is told so at once, and how to go on.
#[test]
fn a_climb_that_was_stopped_says_so_and_how_to_go_on() {
    let mut diagnosis = missing();
    diagnosis.verb = "improve".into();
    diagnosis.verdict = Verdict::Undecided;
    diagnosis.interrupted = true;
    let text = text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None);
    assert!(
        text.contains("Verdict: stopped before there was a verdict"),
        "{text}"
    );
    assert!(
        text.ends_with("snug improve --study out/study.ron\n"),
        "{text}"
    );
}

/// `INSTA_UPDATE=always cargo test --package snug-cli --lib` takes over what was changed on purpose.
#[test]
fn every_verdict_word_for_word() {
    let told = |change: fn(&mut Diagnosis)| {
        let mut diagnosis = missing();
        change(&mut diagnosis);
        text(&diagnosis, &FOLLOWING, Vocabulary::Hand, None)
    };
    insta::assert_snapshot!("missing", told(|_| ()));
    insta::assert_snapshot!(
        "compared",
        told(|one| {
            one.verb = "compare".into();
            one.verdict = Verdict::Undecided;
        })
    );
    insta::assert_snapshot!(
        "adequate",
        told(|one| {
            one.verb = "improve".into();
            one.verdict = Verdict::Adequate;
        })
    );
    insta::assert_snapshot!(
        "unlisted",
        told(|one| {
            one.verdict = Verdict::UnlistedEffect;
            one.unlisted = Some(damping_with_x2());
        })
    );
    insta::assert_snapshot!(
        "interrupted",
        told(|one| {
            one.verb = "improve".into();
            one.verdict = Verdict::Undecided;
            one.interrupted = true;
        })
    );
}
