//! What a run prints at its end: presets, means, agreement, findings, and which files were written, kept or left.

use snug_campaign::words::counted;
use snug_campaign::words::number::significant;
use snug_campaign::words::program::program;
use snug_campaign::{
    CampaignResult, Finding, Moments, Prediction, PresetSummary, Rejection, Severity,
    TighteningResult, Validation,
};
use snug_study::Outcome;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Findings of a kind that are told in full.
const SHOWN: usize = 2;
/// Of what is kept for validation, how many are told one by one.
const VALIDATIONS: usize = 6;

/// What a run came to, on one screen.
pub fn of_run(outcome: &Outcome) -> String {
    let result = &outcome.result;
    let mut text = format!("\n{}\n", result.title);
    headline(&mut text, outcome);
    line(
        &mut text,
        format_args!(
            "  selected: fits well enough to be counted below; each preset asks it in its own way"
        ),
    );
    for preset in &result.presets {
        selection(&mut text, preset);
    }
    corrections(&mut text, result);
    parameters(&mut text, result);
    validation(&mut text, result);
    agreement(&mut text, result);
    findings(&mut text, &result.findings);
    text
}

/// One line of what was found in the recordings themselves, for who is told of the model first; empty where nothing was.
pub fn of_recordings(findings: &[Finding]) -> String {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    let of_one = findings.iter().filter(|one| one.tightening.is_some());
    for finding in of_one.filter(|one| one.severity != Severity::LeftOut) {
        *kinds.entry(&finding.code).or_default() += 1;
    }
    if kinds.is_empty() {
        return String::new();
    }
    let told: Vec<String> = (kinds.iter())
        .map(|(code, count)| format!("{} ({count})", code.replace('_', " ")))
        .collect();
    format!(
        "\nFound in the recordings: {}; findings.json and the report say what and where\n",
        told.join(", ")
    )
}

/// What became of the work: whether it was cut short, what was left out, where the results stand.
pub fn of_results(outcome: &Outcome) -> String {
    let mut text = String::new();
    if outcome.interrupted {
        text.push_str("\nInterrupted: the results cover what was evaluated until then.\n");
    }
    if outcome.left_out > 0 {
        let what = match outcome.left_out {
            1 => "1 file or tightening".to_owned(),
            some => format!("{some} files or tightenings"),
        };
        line(
            &mut text,
            format_args!("\nLeft out: {what} (findings.json and the report say which, and why)"),
        );
    }
    text.push_str("\nWritten:\n");
    for path in &outcome.written {
        line(&mut text, format_args!("  {}", path.display()));
    }
    let listed = |text: &mut String, heading: &str, paths: &[PathBuf]| {
        if !paths.is_empty() {
            line(text, format_args!("\n{heading}:"));
        }
        for path in paths {
            line(text, format_args!("  {}", path.display()));
        }
    };
    listed(
        &mut text,
        "Kept, because it had a result's name and was not as Snug had written it",
        &outcome.set_aside,
    );
    let left = format!(
        "Left by runs that came to no end; `{} recover FILE` makes one whole, or delete it",
        program()
    );
    listed(&mut text, &left, &outcome.unfinished);
    text
}

fn line(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    writeln!(text, "{arguments}").expect("a string takes every write");
}

fn headline(text: &mut String, outcome: &Outcome) {
    let result = &outcome.result;
    let model = if result.effects.is_empty() {
        "base model".to_owned()
    } else {
        format!("base model + {}", result.effects.join(" + "))
    };
    line(
        text,
        format_args!(
            "  {} from {}; {model}, {} fitted",
            counted(result.tightenings.len(), "tightening"),
            counted(outcome.files, "file"),
            result.fitted_output
        ),
    );
}

fn selection(text: &mut String, preset: &PresetSummary) {
    let share = 100.0 * preset.selected as f64 / preset.tightenings.max(1) as f64;
    let reasons: Vec<String> = preset
        .rejections
        .iter()
        .map(|count| format!("{} {}", count.tightenings, words(count.rejection)))
        .collect();
    let why = if reasons.is_empty() {
        String::new()
    } else {
        format!("; rejected: {}", reasons.join(", "))
    };
    line(
        text,
        format_args!(
            "  preset {:<7} selects {} of {} ({share:.0} %){why}",
            preset.preset, preset.selected, preset.tightenings
        ),
    );
}

fn words(rejection: Rejection) -> String {
    rejection.name().replace('_', " ")
}

/// What was measured in the quiet part and taken out, where it is more than chance.
fn corrections(text: &mut String, result: &CampaignResult) {
    let mut sizes: BTreeMap<(&str, &str), Vec<f64>> = BTreeMap::new();
    for correction in result.tightenings.iter().flat_map(|t| &t.corrections) {
        if correction.significant {
            sizes
                .entry((correction.effect.as_str(), correction.unit.as_str()))
                .or_default()
                .push(correction.value.abs());
        }
    }
    for ((effect, unit), mut sizes) in sizes {
        sizes.sort_by(f64::total_cmp);
        line(
            text,
            format_args!(
                "  corrected from the quiet part: {effect} in {} of {} tightenings, median size {} {unit}",
                sizes.len(),
                result.tightenings.len(),
                four_digits(sizes[sizes.len() / 2])
            ),
        );
    }
}

fn parameters(text: &mut String, result: &CampaignResult) {
    let Some(all) = result.conditions.first() else {
        return;
    };
    let rows: Vec<(String, &Moments)> = all
        .quantities
        .iter()
        .filter_map(|q| Some((called(&q.quantity, result), q.selected.as_ref()?)))
        .collect();
    let Some(width) = rows.iter().map(|(name, _)| name.chars().count()).max() else {
        return;
    };
    let width = width.max(24);
    line(
        text,
        format_args!(
            "\n  {:<width$} {:>11} {:>11} {:>25}",
            "selected", "mean", "SD", "95 % of the mean"
        ),
    );
    for (name, moments) in rows {
        let sd = moments
            .standard_deviation
            .map_or_else(|| "–".to_owned(), four_digits);
        let interval = moments.mean_interval.map_or_else(
            || "–".to_owned(),
            |i| format!("{} to {}", four_digits(i.low), four_digits(i.high)),
        );
        line(
            text,
            format_args!(
                "  {name:<width$} {:>11} {sd:>11} {interval:>25}",
                four_digits(moments.mean)
            ),
        );
    }
}

/// A column of the tables by its name; a parameter of an effect by what it is: `coulomb friction: friction force [N]`.
fn called(column: &str, result: &CampaignResult) -> String {
    let Some(told) = result.meanings.iter().find(|told| told.name == column) else {
        return column.to_owned();
    };
    let words = told.words();
    let estimates = result
        .tightenings
        .iter()
        .filter_map(|t| t.estimate.as_ref());
    let unit = (estimates.flat_map(|estimate| &estimate.parameters))
        .find(|parameter| parameter.name == column)
        .map_or("", |parameter| parameter.unit.as_str());
    match unit {
        "" | "1" => words,
        unit => format!("{words} [{unit}]"),
    }
}

/// Four significant digits.
fn four_digits(value: f64) -> String {
    significant(value, 4)
}

/// How well what was kept for validation is predicted, of so many one by one.
fn validation(text: &mut String, result: &CampaignResult) {
    let kept: Vec<(&TighteningResult, Validation)> = (result.tightenings.iter())
        .filter_map(|one| Some((one, one.validation?.times(result.units.output_per_rad))))
        .collect();
    for (one, found) in kept.iter().take(VALIDATIONS) {
        line(
            text,
            format_args!("  validation {}: {}", one.id, predicted(found, result)),
        );
    }
    let more = kept.len().saturating_sub(VALIDATIONS);
    if more > 0 {
        let mut fits: Vec<f64> = (kept.iter())
            .filter_map(|(_, found)| found.free_run.fit_percent)
            .collect();
        fits.sort_by(f64::total_cmp);
        let median = fits.get(fits.len() / 2).copied().unwrap_or(f64::NAN);
        line(
            text,
            format_args!(
                "  validation: {more} more in the report; median fit of all {} in a free run {median:.1} %",
                kept.len()
            ),
        );
    }
}

/// `fit of the velocity 93.1 % in a free run (residual 0.0123 rad/s rms), 98.4 % restarted every 0.125 s (0.003 rad/s)`.
fn predicted(found: &Validation, result: &CampaignResult) -> String {
    let unit = result.units.motion_called(&result.fitted_output);
    let percent = |one: &Prediction| {
        let fit = one.fit_percent;
        fit.map_or_else(|| "– %".to_owned(), |fit| format!("{fit:.1} %"))
    };
    let rms = |one: &Prediction| one.rms.map_or_else(|| "–".to_owned(), four_digits);
    let restarted = found.restarted.map_or_else(String::new, |restarted| {
        let (every_s, one) = (significant(restarted.every_s, 3), &restarted.prediction);
        let fit = percent(one);
        format!(", {fit} restarted every {every_s} s ({} {unit})", rms(one))
    });
    let free = &found.free_run;
    format!(
        "fit of the {} {} in a free run (residual {} {unit} rms){restarted}",
        result.fitted_output,
        percent(free),
        rms(free)
    )
}

fn agreement(text: &mut String, result: &CampaignResult) {
    let median = |value: fn(&TighteningResult) -> Option<f64>| {
        let fitted = result
            .tightenings
            .iter()
            .filter(|one| one.validation.is_none());
        let mut values: Vec<f64> = fitted.filter_map(value).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied()
    };
    let fit = median(|t| t.measures.fit_percent);
    let noise = median(|t| t.measures.error_over_noise);
    if let Some(fit) = fit {
        line(
            text,
            format_args!("\n  median fit of the displacement {fit:.1} %"),
        );
    }
    if let Some(noise) = noise {
        line(
            text,
            format_args!("  median error over noise {noise:.3} (1 = nothing left but noise)"),
        );
    }
}

fn findings(text: &mut String, findings: &[Finding]) {
    let mut kinds: BTreeMap<(std::cmp::Reverse<Severity>, &str), Vec<&Finding>> = BTreeMap::new();
    for finding in findings {
        let kind = (std::cmp::Reverse(finding.severity), finding.code.as_str());
        kinds.entry(kind).or_default().push(finding);
    }
    if kinds.is_empty() {
        return;
    }
    text.push_str("\n  findings (all in findings.json and in the report)\n");
    for ((std::cmp::Reverse(severity), code), alike) in kinds {
        let count = alike.len();
        let severity = match severity {
            Severity::LeftOut => "left out",
            Severity::Repaired => "repaired",
            Severity::Note => "note",
        };
        line(
            text,
            format_args!("  {count:>6} {severity:<9} {}", code.replace('_', " ")),
        );
        for finding in alike.iter().take(SHOWN) {
            let number = finding.tightening.map(|number| format!(" #{number}"));
            line(
                text,
                format_args!(
                    "                     {}{}: {}",
                    finding.file,
                    number.unwrap_or_default(),
                    finding.message
                ),
            );
        }
    }
}
