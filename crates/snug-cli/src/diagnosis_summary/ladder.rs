//! The ladder for a terminal: a line per model with its error and a bar.

use super::{Page, shortened};
use snug_campaign::words::number::significant;
use snug_campaign::{Diagnosis, Rung};

/// Columns of the longest bar.
const BAR: usize = 36;
/// Columns of a line beside the model's name, a short bar among them.
const BESIDE: usize = 44;

/// What the columns are where the noise is known, and where it is not.
const OVER_NOISE: &str = "error: of all tightenings; unseen: of such as the sizes were not fitted to; selected: share of \
    tightenings that fit well enough to be used. Bars begin at the noise and are logarithmic.";
const IN_UNITS: &str =
    "error: of all tightenings; selected: share of tightenings that fit well enough to be used.";

/// Each model with its error, and a bar.
pub fn ladder(page: &mut Page, diagnosis: &Diagnosis) {
    let mut rungs = diagnosis.ladder.iter();
    if diagnosis.ladder.is_empty() {
        return;
    }
    if rungs.any(|rung| rung.error_over_noise.is_some()) {
        page.heading("How far the model misses the measurement, as a multiple of the noise (1.0 = nothing left but noise)");
        page.paragraph("  ", OVER_NOISE);
        table(page, diagnosis, true);
    } else {
        page.heading(&format!(
            "How far the model misses the measurement: residual of the {}, root mean square (the noise is unknown)",
            diagnosis.compared_output
        ));
        page.paragraph("  ", IN_UNITS);
        table(page, diagnosis, false);
    }
    if let Some(stopped) = &diagnosis.stopped {
        page.paragraph("  Stopped: ", &stopped.to_string());
    }
    for removal in &diagnosis.removals {
        page.paragraph("  Tried without: ", &removal.statement);
    }
}

/// A line per model; errors are over noise where that is known.
fn table(page: &mut Page, diagnosis: &Diagnosis, known: bool) {
    let names = page.width.saturating_sub(BESIDE).clamp(12, 32);
    let longest = page.width.saturating_sub(names + BESIDE - 8).min(BAR);
    let unseen = if known { "unseen" } else { "" };
    page.line(&format!(
        "  {:<names$} {:>9} {unseen:>9} {:>9}",
        "model", "error", "selected"
    ));
    let error = |rung: &Rung| match known {
        true => rung.error_over_noise,
        false => Some(rung.rms_fitted_output),
    };
    let errors: Vec<Option<f64>> = diagnosis.ladder.iter().map(error).collect();
    let floor = if known { 1.0 } else { 0.0 };
    let number =
        |value: Option<f64>| value.map_or_else(|| "?".to_owned(), |value| significant(value, 4));
    let mut before = &diagnosis.ladder[0];
    for (rung, error) in diagnosis.ladder.iter().zip(&errors) {
        let unseen = match known {
            true => number(rung.heldout_error_over_noise),
            false => String::new(),
        };
        let line = format!(
            "  {:<names$} {:>9} {unseen:>9} {:>7.0} %  {}",
            shortened(&step(before, rung, diagnosis), names),
            number(*error),
            100.0 * rung.selected_fraction,
            bar(*error, &errors, floor, longest, page.terminal)
        );
        page.line(&line);
        before = rung;
    }
}

/// What a rung changes against the one before it.
fn step(before: &Rung, rung: &Rung, diagnosis: &Diagnosis) -> String {
    let called = |effect: &String| diagnosis.label(effect);
    let gained = rung.effects.iter().filter(|e| !before.effects.contains(e));
    let lost = before.effects.iter().filter(|e| !rung.effects.contains(e));
    let steps: Vec<String> = gained
        .map(|effect| format!("+ {}", called(effect)))
        .chain(lost.map(|effect| format!("- {}", called(effect))))
        .collect();
    match (steps.is_empty(), rung.effects.is_empty()) {
        (true, true) => "base model: mass, damper, spring".into(),
        (true, false) => {
            let effects: Vec<String> = rung.effects.iter().map(called).collect();
            format!("base + {}", effects.join(" + "))
        }
        (false, _) => steps.join(" "),
    }
}

/// A bar from the floor to the error: over noise logarithmic, else straight.
fn bar(
    error: Option<f64>,
    errors: &[Option<f64>],
    floor: f64,
    longest_columns: usize,
    terminal: bool,
) -> String {
    let length = |error: f64| {
        if floor > 0.0 {
            (error / floor).ln().max(0.0)
        } else {
            error
        }
    };
    let longest = errors
        .iter()
        .flatten()
        .map(|error| length(*error))
        .fold(0.0, f64::max);
    let share = match error {
        Some(error) if longest > 0.0 => length(error) / longest.max(0.05),
        _ => 0.0,
    };
    if !share.is_finite() {
        return "|".into();
    }
    let blocks = (share * longest_columns as f64).round() as usize;
    format!("|{}", if terminal { "█" } else { "#" }.repeat(blocks))
}
