//! Invented sizes, gains and chances: candidates of every kind that the page shows differently.

use snug_campaign::{AddedEffect, Detectability, EffectParameter, NegativeControl, RankedEffect};

/// An estimate with its interval, within a plausible range of five times its size.
pub fn parameter(name: &str, unit: &str, value: f64, standard_error: f64) -> EffectParameter {
    EffectParameter {
        name: name.into(),
        meaning: meaning(name).into(),
        unit: unit.into(),
        value,
        low: Some(value - 1.96 * standard_error),
        high: Some(value + 1.96 * standard_error),
        standard_error: Some(standard_error),
        per_tightening: false,
        spread: None,
        minimum: -5.0 * value.abs(),
        maximum: 5.0 * value.abs(),
        by_group: None,
    }
}

/// As the effects say it; the others' names speak for themselves.
fn meaning(name: &str) -> &'static str {
    match name {
        "k3_n_per_m3" => "cubic stiffness",
        "fc_n" => "friction force",
        _ => "",
    }
}

/// A mechanical effect without evidence yet.
pub fn effect(name: &str, size: EffectParameter) -> AddedEffect {
    AddedEffect {
        size: "shared".into(),
        effect: name.into(),
        kind: "mechanical".into(),
        expression: None,
        twins: vec![],
        parameters: vec![size],
        p_family: None,
        heldout_gain: None,
        needed: None,
        explanation: vec![],
        comparisons: vec![],
    }
}

/// A candidate with its evidence.
pub fn ranked(name: &str, kind: &str, behind: f64, gain: f64, error: f64, p: f64) -> RankedEffect {
    RankedEffect {
        effect: name.into(),
        kind: kind.into(),
        unlisted: false,
        expression: None,
        parameters: vec![],
        score: 11.2 - behind,
        p_family: p,
        heldout_gain: gain,
        heldout_gain_error: error,
        error_over_noise: Some((6.42_f64.powi(2) * (1.0 - gain)).sqrt().max(1.018)),
        behind_first: behind,
        supported: p <= 0.05 && gain > error,
        twins: vec![],
        plausible: true,
        explanation: vec![],
    }
}

/// What could be missing beside a hardening spring.
pub fn beside_the_spring() -> Vec<RankedEffect> {
    vec![
        ranked("torque_delay", "measurement", 0.0, 0.47, 0.05, 0.002),
        ranked("co_contraction", "muscular", 4.0, 0.06, 0.05, 0.31),
        ranked("quadratic_stiffness", "mechanical", 5.0, 0.01, 0.03, 0.72),
    ]
}

/// What could be missing in the study's own model.
pub fn candidates() -> Vec<RankedEffect> {
    let mut list = vec![
        ranked("cubic_stiffness", "mechanical", 0.0, 0.83, 0.04, 0.001),
        ranked("quadratic_stiffness", "mechanical", 0.4, 0.81, 0.05, 0.001),
        ranked("co_contraction", "muscular", 3.1, 0.52, 0.06, 0.001),
        ranked("torque_delay", "measurement", 6.2, 0.11, 0.03, 0.004),
        ranked("grip_slip", "mechanical", 7.0, 0.06, 0.04, 0.21),
        ranked("coulomb_friction", "mechanical", 8.5, 0.01, 0.02, 0.43),
        ranked("p*x^2*v", "custom", 8.8, 0.004, 0.02, 0.61),
        ranked("acceleration_bias", "measurement", 9.1, -0.02, 0.01, 1.0),
    ];
    list[0].parameters = vec![parameter("k3_n_per_m3", "N/m^3", 9.9e5, 1.5e4)];
    list[0].twins = vec!["quadratic_stiffness".into()];
    list[0].explanation = vec![
        "The hand's spring becomes stiffer the further it is pushed.".into(),
        "Check at the bench: whether the arm runs into a stop at large targets.".into(),
    ];
    list[1].parameters = vec![parameter("k2_n_per_m2", "N/m^2", 2.31e4, 900.0)];
    list[1].twins = vec!["cubic_stiffness".into()];
    list[2].parameters = vec![
        parameter("rise_ratio", "1", 0.82, 0.11),
        parameter("onset_s", "s", 0.031, 0.004),
        parameter("rise_s", "s", 0.2, 0.01),
    ];
    list[2].parameters[2].standard_error = None;
    list[2].parameters[2].low = None;
    list[2].parameters[2].high = None;
    list[2].plausible = false;
    list[3].parameters = vec![parameter("delay_s", "s", 1.6e-3, 4.1e-4)];
    list[4].parameters = vec![parameter("f_max_n", "N", 212.0, 60.0)];
    list[5].parameters = vec![parameter("fc_n", "N", 0.31, 0.42)];
    list[6].unlisted = true;
    list[6].parameters = vec![parameter("p", "N s/m^3", 44.0, 51.0)];
    list[7].parameters = vec![parameter("bias_rad_per_s2", "rad/s^2", 0.02, 0.01)];
    list[7].parameters[0].per_tightening = true;
    list[7].parameters[0].spread = Some(0.06);
    list
}

/// What is left to rank once the missing effects are in.
pub fn leftovers() -> Vec<RankedEffect> {
    candidates()
        .into_iter()
        .skip(4)
        .map(|mut candidate| {
            candidate.heldout_gain = candidate.heldout_gain.min(0.01);
            candidate.error_over_noise = Some(1.017);
            candidate
        })
        .collect()
}

/// What would have been seen.
pub fn detectability() -> Vec<Detectability> {
    vec![
        Detectability {
            effect: "coulomb_friction".into(),
            parameter: "fc_n".into(),
            meaning: meaning("fc_n").into(),
            unit: "N".into(),
            smallest_detectable: Some(0.83),
            largest_plausible: 30.0,
            in_some_groups: None,
            statement: "Absent or smaller than 0.83 N.".into(),
        },
        Detectability {
            effect: "second_mass".into(),
            parameter: "m2_kg".into(),
            meaning: meaning("m2_kg").into(),
            unit: "kg".into(),
            smallest_detectable: None,
            largest_plausible: 2.0,
            in_some_groups: None,
            statement: "Even the largest plausible size would not be seen in these data.".into(),
        },
    ]
}

/// 2 false alarms in 40 campaigns.
pub fn control() -> NegativeControl {
    NegativeControl {
        campaigns: 40,
        false_alarms: 2,
        nominal_rate: 0.05,
        rate_low: 0.0138,
        rate_high: 0.165,
    }
}
