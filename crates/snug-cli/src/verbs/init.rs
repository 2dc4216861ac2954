//! `init`: shows what measurement files hold and writes the study that was drafted for them.

use super::run::refused;
use crate::exit;
use crate::terminal::say;
use snug_campaign::words::program::program;
use snug_study::{Draft, DraftColumn};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Drafts a study for `files` and writes it to `study`, over a file that is there with `write` only.
pub fn init(files: &[PathBuf], study: &Path, write: bool) -> ExitCode {
    let draft = match snug_study::draft(files, study) {
        Ok(draft) => draft,
        Err(error) => return refused(&error.into()),
    };
    let text = told(&draft);
    if let Err(error) = snug_study::write_draft(&draft, study, write) {
        say(&text, exit::DONE);
        return refused(&error.into());
    }
    let name = study.display();
    say(
        &format!(
            "{text}\nWritten: {name}. Read it and correct what is wrong; then\n  {} compare --study {name}\n",
            program()
        ),
        exit::DONE,
    )
}

/// Every column with its picture, then what was found out.
fn told(draft: &Draft) -> String {
    let mut text = String::new();
    for column in &draft.columns {
        _ = writeln!(text, "{}", column.place);
        _ = writeln!(text, "  {}  {}", picture(column), extent(&column.values));
        _ = writeln!(text, "  {}", column.told);
    }
    text.push('\n');
    for note in &draft.notes {
        _ = writeln!(text, "{note}");
    }
    text
}

/// Letters of a picture.
const WIDTH: usize = 60;
/// Heights of a letter.
const LEVELS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// A column's course: the mean of every sixtieth, between the smallest and the largest of them.
fn picture(column: &DraftColumn) -> String {
    let width = WIDTH.min(column.values.len());
    let means: Vec<f64> = (0..width)
        .map(|place| {
            let (start, end) = (
                place * column.values.len() / width,
                (place + 1) * column.values.len() / width,
            );
            let numbers = column.values[start..end]
                .iter()
                .filter(|value| value.is_finite());
            let (sum, count) =
                numbers.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
            sum / f64::from(count)
        })
        .collect();
    let least = means.iter().copied().fold(f64::INFINITY, f64::min);
    let most = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let letter = |mean: &f64| {
        if !mean.is_finite() {
            return ' ';
        }
        // Means of equal numbers differ by their rounding.
        let moves = most - least > 1e-9 * most.abs().max(least.abs());
        let share = if moves {
            (mean - least) / (most - least)
        } else {
            0.0
        };
        LEVELS[((share * LEVELS.len() as f64) as usize).min(LEVELS.len() - 1)]
    };
    means.iter().map(letter).collect()
}

/// How many numbers, from where to where.
fn extent(values: &[f64]) -> String {
    let numbers = values.iter().copied().filter(|value| value.is_finite());
    let least = numbers.clone().fold(f64::INFINITY, f64::min);
    let most = numbers.fold(f64::NEG_INFINITY, f64::max);
    format!(
        "{} samples, {} to {}",
        values.len(),
        digits(least),
        digits(most)
    )
}

fn digits(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_rises_and_gaps_are_blank() {
        let column = |values: Vec<f64>| DraftColumn {
            place: String::new(),
            told: String::new(),
            values,
        };
        let ramp: Vec<f64> = (0..8).map(f64::from).collect();
        assert_eq!(picture(&column(ramp)), "▁▂▃▄▅▆▇█");
        assert_eq!(picture(&column(vec![1.0, f64::NAN, 1.0])), "▁ ▁");
        assert_eq!(
            extent(&[0.123_456, f64::NAN, -2.0]),
            "3 samples, -2 to 0.1235"
        );
    }
}
