//! `tightenings.csv`: one row per tightening, every digit, SI units.

use crate::grouping::first_seen;
use crate::tables::json;
use snug_campaign::{CampaignResult, Conditions, Estimate, FitMeasures, TighteningResult};

/// The base model's parameters: their values stand among the leading columns.
pub(crate) const BASE_PARAMETERS: [&str; 3] = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];

/// A column: its name and what stands in it for a tightening.
struct Column<'a> {
    name: String,
    field: Box<dyn Fn(&TighteningResult) -> String + 'a>,
}

/// One row per tightening in campaign order.
///
/// Columns: the fifteen leading ones; `_low` and `_high` (95 % interval) of mass, damping and stiffness; each effect
/// parameter with its `_low` and `_high`; then peak torque, the rig, status, active constraints, further measures, the
/// noise, and per correction its size, standard error and significance. A field is empty where there is no finite value.
/// Reasons of rejection are joined by `;`. Names from the measurements that begin with `=`, `+`, `-`, `@` or a control
/// character have an apostrophe in front, so that a spreadsheet shows them and calculates nothing.
pub fn tightenings_csv(result: &CampaignResult) -> String {
    let columns = columns(result);
    let mut writer = csv::WriterBuilder::new()
        .terminator(csv::Terminator::Any(b'\n'))
        .from_writer(Vec::new());
    writer
        .write_record(columns.iter().map(|column| &column.name))
        .expect("writing to memory does not fail");
    for tightening in &result.tightenings {
        writer
            .write_record(columns.iter().map(|column| (column.field)(tightening)))
            .expect("every row has the header's length");
    }
    let bytes = writer.into_inner().expect("flushing memory does not fail");
    String::from_utf8(bytes).expect("all fields are text")
}

fn columns(result: &CampaignResult) -> Vec<Column<'_>> {
    let mut columns = leading(result);
    for name in BASE_PARAMETERS {
        columns.extend(interval(name));
    }
    for name in effect_parameters(result) {
        columns.push(value(name));
        columns.extend(interval(name));
    }
    columns.extend([
        size("peak_torque_nm", |one| Some(one.peak_torque_nm)),
        size("lever_arm_m", |one| Some(one.rig.lever_arm_m)),
        size("known_inertia_kg_m2", |one| {
            Some(one.rig.known_inertia_kg_m2)
        }),
        estimated("status", |estimate| json::name(estimate.status)),
        estimated("active_constraints", |estimate| {
            estimate.active_constraints.join(";")
        }),
    ]);
    columns.extend(measures());
    columns.push(column("noise_source", |one| {
        let noise = one.noise.as_ref();
        noise.map_or_else(String::new, |noise| json::name(noise.source))
    }));
    columns.push(size("noise_standard_deviation", |one| {
        Some(one.noise.as_ref()?.standard_deviation)
    }));
    for effect in corrections(result) {
        columns.extend(correction(effect));
    }
    columns
}

/// The first columns, whose names and order other programs rely on.
fn leading(result: &CampaignResult) -> Vec<Column<'_>> {
    let torque = result.units.input_is_torque();
    vec![
        column("file", |one| text(&one.id.file)),
        column("tightening", |one| one.id.number.to_string()),
        condition("participant", |conditions| &conditions.participant),
        condition("strategy", |conditions| &conditions.strategy),
        condition("joint", |conditions| &conditions.joint),
        size("pace_per_min", |one| one.conditions.pace_per_min),
        size("target_torque_nm", move |one| {
            torque.then_some(one.target_torque_nm)
        }),
        value("mass_kg"),
        value("damping_kg_per_s"),
        value("stiffness_n_per_m"),
        measure("natural_frequency_hz", |fit| fit.natural_frequency_hz),
        measure("fit_percent", |fit| fit.fit_percent),
        column("selected", |one| one.selection.selected().to_string()),
        column("rejection", |one| {
            let reasons = one.selection.rejections.iter();
            reasons
                .map(|reason| reason.name())
                .collect::<Vec<_>>()
                .join(";")
        }),
        measure("error_over_noise", |fit| fit.error_over_noise),
    ]
}

/// Measures that follow the parameters.
fn measures<'a>() -> [Column<'a>; 16] {
    [
        measure("natural_frequency_hz_low", |fit| {
            fit.natural_frequency_low_hz
        }),
        measure("natural_frequency_hz_high", |fit| {
            fit.natural_frequency_high_hz
        }),
        measure("fit_percent_fitted_output", |fit| {
            fit.fit_percent_fitted_output
        }),
        measure("rms_displacement_rad", |fit| fit.rms_displacement_rad),
        measure("euler_accuracy_percent", |fit| fit.euler_accuracy_percent),
        measure("damped_frequency_hz", |fit| fit.damped_frequency_hz),
        measure("damped_frequency_hz_low", |fit| fit.damped_frequency_low_hz),
        measure("damped_frequency_hz_high", |fit| {
            fit.damped_frequency_high_hz
        }),
        measure("damping_ratio", |fit| fit.damping_ratio),
        measure("damping_ratio_low", |fit| fit.damping_ratio_low),
        measure("damping_ratio_high", |fit| fit.damping_ratio_high),
        measure("thesis_damping_ratio", |fit| fit.thesis_damping_ratio),
        measure("peak_force_f1_n", |fit| fit.peak_force_f1_n),
        measure("peak_force_f2_n", |fit| fit.peak_force_f2_n),
        measure("peak_force_f3_n", |fit| fit.peak_force_f3_n),
        measure("peak_grip_force_n", |fit| fit.peak_grip_force_n),
    ]
}

fn column<'a>(
    name: impl Into<String>,
    field: impl Fn(&TighteningResult) -> String + 'a,
) -> Column<'a> {
    Column {
        name: name.into(),
        field: Box::new(field),
    }
}

fn size<'a>(
    name: impl Into<String>,
    read: impl Fn(&TighteningResult) -> Option<f64> + 'a,
) -> Column<'a> {
    column(name, move |one| number(read(one)))
}

fn measure<'a>(name: &str, read: fn(&FitMeasures) -> Option<f64>) -> Column<'a> {
    size(name, move |one| read(&one.measures))
}

fn condition<'a>(name: &str, read: fn(&Conditions) -> &Option<String>) -> Column<'a> {
    column(name, move |one| {
        text(read(&one.conditions).as_deref().unwrap_or_default())
    })
}

fn estimated<'a>(name: &str, read: fn(&Estimate) -> String) -> Column<'a> {
    column(name, move |one| {
        one.estimate.as_ref().map_or_else(String::new, read)
    })
}

/// A parameter's value.
fn value(name: &str) -> Column<'_> {
    size(name, move |one| one.estimate.as_ref()?.value(name))
}

/// Both ends of a parameter's interval.
fn interval(name: &str) -> [Column<'_>; 2] {
    let of = move |one: &TighteningResult| one.estimate.as_ref()?.parameter(name)?.interval;
    [
        size(format!("{name}_low"), move |one| Some(of(one)?.low)),
        size(format!("{name}_high"), move |one| Some(of(one)?.high)),
    ]
}

/// Size, standard error and significance of what was corrected.
fn correction(effect: &str) -> [Column<'_>; 3] {
    let of = move |one: &TighteningResult| {
        let mut corrections = one.corrections.iter();
        corrections.find(|one| one.effect == effect).cloned()
    };
    [
        size(format!("corrected_{effect}"), move |one| {
            Some(of(one)?.value)
        }),
        size(format!("corrected_{effect}_standard_error"), move |one| {
            Some(of(one)?.standard_error)
        }),
        column(format!("corrected_{effect}_significant"), move |one| {
            of(one).map_or_else(String::new, |correction| correction.significant.to_string())
        }),
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
