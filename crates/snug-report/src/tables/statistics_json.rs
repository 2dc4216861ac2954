//! `statistics.json`: both presets, means and spreads per condition, and tests.

use crate::tables::json;
use crate::words::number::share;
use crate::words::quantity;
use serde::Serialize;
use snug_campaign::{
    CampaignResult, ConditionSummary, Interval, Moments, PresetSummary, Rejection, TestRow,
    TighteningResult, Validation,
};

#[derive(Serialize)]
struct Statistics<'a> {
    format: u32,
    title: &'a str,
    preset: &'a str,
    fitted_output: &'a str,
    effects: &'a [String],
    presets: Vec<Preset<'a>>,
    conditions: Vec<Condition<'a>>,
    tests: &'a [TestRow],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    validation: Vec<Validated<'a>>,
}

#[derive(Serialize)]
struct Validated<'a> {
    file: &'a str,
    tightening: u32,
    unit: String,
    #[serde(flatten)]
    validation: Validation,
}

#[derive(Serialize)]
struct Preset<'a> {
    preset: &'a str,
    tightenings: usize,
    selected: usize,
    selected_share: Option<f64>,
    rejections: &'a [snug_campaign::RejectionCount],
    outcomes: Vec<Outcome<'a>>,
}

#[derive(Serialize)]
struct Outcome<'a> {
    file: &'a str,
    tightening: u32,
    selected: bool,
    rejections: &'a [Rejection],
}

#[derive(Serialize)]
struct Condition<'a> {
    factor: &'a str,
    level: &'a str,
    tightenings: usize,
    selected: usize,
    selected_share: Option<f64>,
    selected_share_interval: Option<Interval>,
    quantities: Vec<Quantity<'a>>,
}

#[derive(Serialize)]
struct Quantity<'a> {
    quantity: &'a str,
    unit: String,
    selected: &'a Option<Moments>,
    rejected: &'a Option<Moments>,
}

/// Both presets side by side (counts, reasons, every outcome), per condition the counts, selected share and moments of
/// each quantity over selected and rejected tightenings, every test, and of everything that was kept for validation how well it
/// is predicted in a free run and restarted (`rms` in `unit`). `format` is 1; intervals are 95 %; what is not finite is `null`.
pub fn statistics_json(result: &CampaignResult) -> String {
    let statistics = Statistics {
        format: 1,
        title: &result.title,
        preset: &result.preset,
        fitted_output: &result.fitted_output,
        effects: &result.effects,
        presets: result.presets.iter().map(preset).collect(),
        conditions: result
            .conditions
            .iter()
            .map(|summary| condition(summary, result))
            .collect(),
        tests: &result.tests,
        validation: (result.tightenings.iter())
            .filter_map(|one| validated(one, result))
            .collect(),
    };
    json::text(&statistics)
}

fn validated<'a>(one: &'a TighteningResult, result: &CampaignResult) -> Option<Validated<'a>> {
    Some(Validated {
        file: &one.id.file,
        tightening: one.id.number,
        unit: (result.units.motion_called(&result.fitted_output)).replace('²', "^2"),
        validation: one.validation?.times(result.units.output_per_rad),
    })
}

fn preset(summary: &PresetSummary) -> Preset<'_> {
    Preset {
        preset: &summary.preset,
        tightenings: summary.tightenings,
        selected: summary.selected,
        selected_share: share(summary.selected, summary.tightenings),
        rejections: &summary.rejections,
        outcomes: summary
            .outcomes
            .iter()
            .map(|(id, rejections)| Outcome {
                file: &id.file,
                tightening: id.number,
                selected: rejections.is_empty(),
                rejections,
            })
            .collect(),
    }
}

fn condition<'a>(summary: &'a ConditionSummary, result: &CampaignResult) -> Condition<'a> {
    Condition {
        factor: &summary.factor,
        level: &summary.level,
        tightenings: summary.tightenings,
        selected: summary.selected,
        selected_share: share(summary.selected, summary.tightenings),
        selected_share_interval: summary.selected_share_interval,
        quantities: summary
            .quantities
            .iter()
            .map(|row| Quantity {
                quantity: &row.quantity,
                unit: quantity::unit(&row.quantity, result),
                selected: &row.selected,
                rejected: &row.rejected,
            })
            .collect(),
    }
}
