//! `tightenings.csv`: one row per tightening, every digit, SI units.

use crate::json;
use snug_campaign::{CampaignResult, Estimate, FitMeasures, SignalUnits, TighteningResult};

/// The first columns, whose names and order other programs rely on.
const LEADING: [&str; 15] = [
    "file",
    "tightening",
    "participant",
    "strategy",
    "joint",
    "pace_per_min",
    "target_torque_nm",
    "mass_kg",
    "damping_kg_per_s",
    "stiffness_n_per_m",
    "natural_frequency_hz",
    "fit_percent",
    "selected",
    "rejection",
    "error_over_noise",
];

/// The base model's parameters: their values stand among the leading columns.
pub(crate) const BASE_PARAMETERS: [&str; 3] = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];

/// A measure's column and how it is read.
type Measure = (&'static str, fn(&FitMeasures) -> Option<f64>);

/// Measures that follow the parameters.
const MEASURES: [Measure; 16] = [
    ("natural_frequency_hz_low", |measures| {
        measures.natural_frequency_low_hz
    }),
    ("natural_frequency_hz_high", |measures| {
        measures.natural_frequency_high_hz
    }),
    ("fit_percent_fitted_output", |measures| {
        measures.fit_percent_fitted_output
    }),
    ("rms_displacement_rad", |measures| {
        measures.rms_displacement_rad
    }),
    ("euler_accuracy_percent", |measures| {
        measures.euler_accuracy_percent
    }),
    ("damped_frequency_hz", |measures| {
        measures.damped_frequency_hz
    }),
    ("damped_frequency_hz_low", |measures| {
        measures.damped_frequency_low_hz
    }),
    ("damped_frequency_hz_high", |measures| {
        measures.damped_frequency_high_hz
    }),
    ("damping_ratio", |measures| measures.damping_ratio),
    ("damping_ratio_low", |measures| measures.damping_ratio_low),
    ("damping_ratio_high", |measures| measures.damping_ratio_high),
    ("thesis_damping_ratio", |measures| {
        measures.thesis_damping_ratio
    }),
    ("peak_force_f1_n", |measures| measures.peak_force_f1_n),
    ("peak_force_f2_n", |measures| measures.peak_force_f2_n),
    ("peak_force_f3_n", |measures| measures.peak_force_f3_n),
    ("peak_grip_force_n", |measures| measures.peak_grip_force_n),
];

/// One row per tightening in campaign order.
///
/// Columns: the fifteen leading ones; `_low` and `_high` (95 % interval) of mass, damping and stiffness; each effect
/// parameter with its `_low` and `_high`; then peak torque, the rig, status, active constraints, further measures, the
/// noise, and per correction its size, standard error and significance. A field is empty where there is no finite value.
/// Reasons of rejection are joined by `;`. Names from the measurements that begin with `=`, `+`, `-`, `@` or a control
/// character have an apostrophe in front, so that a spreadsheet shows them and calculates nothing.
pub fn tightenings_csv(result: &CampaignResult) -> String {
    let effect_parameters = effect_parameters(result);
    let corrections = corrections(result);
    let mut writer = csv::WriterBuilder::new()
        .terminator(csv::Terminator::Any(b'\n'))
        .from_writer(Vec::new());
    writer
        .write_record(header(&effect_parameters, &corrections))
        .expect("writing to memory does not fail");
    for tightening in &result.tightenings {
        writer
            .write_record(row(
                tightening,
                &result.units,
                &effect_parameters,
                &corrections,
            ))
            .expect("every row has the header's length");
    }
    let bytes = writer.into_inner().expect("flushing memory does not fail");
    String::from_utf8(bytes).expect("all fields are text")
}

fn header(effect_parameters: &[&str], corrections: &[&str]) -> Vec<String> {
    let mut columns: Vec<String> = LEADING.iter().map(|name| (*name).into()).collect();
    for name in BASE_PARAMETERS {
        columns.extend([format!("{name}_low"), format!("{name}_high")]);
    }
    for name in effect_parameters {
        columns.extend([
            (*name).into(),
            format!("{name}_low"),
            format!("{name}_high"),
        ]);
    }
    columns.extend(
        [
            "peak_torque_nm",
            "lever_arm_m",
            "known_inertia_kg_m2",
            "status",
            "active_constraints",
        ]
        .map(String::from),
    );
    columns.extend(MEASURES.iter().map(|(name, _)| (*name).into()));
    columns.extend(["noise_source", "noise_standard_deviation"].map(String::from));
    for effect in corrections {
        columns.extend([
            format!("corrected_{effect}"),
            format!("corrected_{effect}_standard_error"),
            format!("corrected_{effect}_significant"),
        ]);
    }
    columns
}

fn row(
    tightening: &TighteningResult,
    units: &SignalUnits,
    effect_parameters: &[&str],
    corrections: &[&str],
) -> Vec<String> {
    let estimate = tightening.estimate.as_ref();
    let mut fields = leading_fields(tightening, units);
    for name in BASE_PARAMETERS {
        fields.extend(interval_fields(estimate, name));
    }
    for name in effect_parameters {
        fields.push(number(estimate.and_then(|estimate| estimate.value(name))));
        fields.extend(interval_fields(estimate, name));
    }
    fields.extend([
        number(Some(tightening.peak_torque_nm)),
        number(Some(tightening.rig.lever_arm_m)),
        number(Some(tightening.rig.known_inertia_kg_m2)),
        estimate.map_or_else(String::new, |estimate| json::name(estimate.status)),
        estimate.map_or_else(String::new, |estimate| {
            estimate.active_constraints.join(";")
        }),
    ]);
    fields.extend(
        MEASURES
            .iter()
            .map(|(_, read)| number(read(&tightening.measures))),
    );
    let noise = tightening.noise.as_ref();
    fields.push(noise.map_or_else(String::new, |noise| json::name(noise.source)));
    fields.push(number(noise.map(|noise| noise.standard_deviation)));
    for effect in corrections {
        let correction = tightening
            .corrections
            .iter()
            .find(|correction| correction.effect == *effect);
        fields.extend([
            number(correction.map(|correction| correction.value)),
            number(correction.map(|correction| correction.standard_error)),
            correction.map_or_else(String::new, |correction| correction.significant.to_string()),
        ]);
    }
    fields
}

fn leading_fields(tightening: &TighteningResult, units: &SignalUnits) -> Vec<String> {
    let conditions = &tightening.conditions;
    let measures = &tightening.measures;
    let value = |name| {
        number(
            tightening
                .estimate
                .as_ref()
                .and_then(|estimate| estimate.value(name)),
        )
    };
    let reasons: Vec<&str> = tightening
        .selection
        .rejections
        .iter()
        .map(|rejection| rejection.name())
        .collect();
    vec![
        text(&tightening.id.file),
        tightening.id.number.to_string(),
        text(conditions.participant.as_deref().unwrap_or_default()),
        text(conditions.strategy.as_deref().unwrap_or_default()),
        text(conditions.joint.as_deref().unwrap_or_default()),
        number(conditions.pace_per_min),
        number(
            units
                .input_is_torque()
                .then_some(tightening.target_torque_nm),
        ),
        value("mass_kg"),
        value("damping_kg_per_s"),
        value("stiffness_n_per_m"),
        number(measures.natural_frequency_hz),
        number(measures.fit_percent),
        tightening.selection.selected().to_string(),
        reasons.join(";"),
        number(measures.error_over_noise),
    ]
}

fn interval_fields(estimate: Option<&Estimate>, name: &str) -> [String; 2] {
    let interval = estimate
        .and_then(|estimate| estimate.parameter(name))
        .and_then(|parameter| parameter.interval);
    [
        number(interval.map(|interval| interval.low)),
        number(interval.map(|interval| interval.high)),
    ]
}

/// The shortest text that reads back as the same number; empty when there is none or it is not finite.
fn number(value: Option<f64>) -> String {
    match value.filter(|value| value.is_finite()) {
        Some(value) if value != 0.0 && !(1e-5..1e15).contains(&value.abs()) => format!("{value:e}"),
        Some(value) => value.to_string(),
        None => String::new(),
    }
}

/// Text of the measurement files, which no spreadsheet may take for a formula: it gets an apostrophe in front where it
/// begins as one does.
fn text(words: &str) -> String {
    match words.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        true => format!("'{words}"),
        false => words.to_owned(),
    }
}

/// Names of all parameters beyond the base model's, in order of first appearance.
pub(crate) fn effect_parameters(result: &CampaignResult) -> Vec<&str> {
    first_seen(
        result
            .tightenings
            .iter()
            .filter_map(|tightening| tightening.estimate.as_ref())
            .flat_map(|estimate| &estimate.parameters)
            .map(|parameter| parameter.name.as_str())
            .filter(|name| !BASE_PARAMETERS.contains(name)),
    )
}

fn corrections(result: &CampaignResult) -> Vec<&str> {
    first_seen(
        result
            .tightenings
            .iter()
            .flat_map(|tightening| &tightening.corrections)
            .map(|correction| correction.effect.as_str()),
    )
}

/// Every item once, in order of first appearance.
pub(crate) fn first_seen<T: PartialEq>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut seen = Vec::new();
    for item in items {
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    seen
}
