//! The study as text, every guess beside its reason.

use super::choice::{Choice, Clock, Taken};
use super::events::Pulse;
use crate::error::StudyError;
use crate::study::Study;
use snug_campaign::words::program::program;
use snug_ingest::Signal;
use snug_ingest::csv::Column;
use snug_ingest::declared::Part;
use snug_ingest::survey::{SurveyedFormat, SurveyedPlace};
use std::fmt::Write as _;
use std::path::{Component, Path};

/// The study file that says what was chosen; `path` leads to the data, `files` are named where not all are read.
pub(super) fn study(choice: &Choice, path: &str, files: &[String], title: &str) -> String {
    let mut text = format!(
        "// Written by `{} init`: guesses from names and numbers, each with its reason. Correct what is wrong.\n",
        program()
    );
    for note in &choice.notes {
        _ = writeln!(text, "// {}", one_line(note));
    }
    _ = writeln!(
        text,
        "(\n    title: {title:?},\n    source: (\n        path: {path:?},"
    );
    if !files.is_empty() {
        _ = writeln!(text, "        files: {files:?},");
    }
    let format = match choice.format {
        SurveyedFormat::Mat => "Mat",
        SurveyedFormat::Json => "Json",
        _ => "Csv",
    };
    _ = writeln!(text, "        format: {format}(\n            channels: [");
    for taken in &choice.taken {
        _ = writeln!(text, "{}", channel(taken));
    }
    _ = writeln!(
        text,
        "            ],\n{}        ),\n    ),",
        sampling(&choice.clock)
    );
    _ = writeln!(text, "{}", rig(choice));
    let (fitted, why) = choice.fitted();
    _ = writeln!(
        text,
        "    identify: (\n        // Which motion is fitted: {why}."
    );
    _ = writeln!(
        text,
        "        fitted_output: {fitted:?},\n        constraints: [Positive],\n    ),\n)"
    );
    text
}

impl Choice {
    /// The study as it would be written for data at the path that stands for none.
    pub(super) fn study(&self) -> Result<Study, StudyError> {
        let text = study(self, "", &[], "");
        Study::parse(&text, Path::new("study.ron"))
    }
}

fn channel(taken: &Taken) -> String {
    let place = match &taken.column.place {
        SurveyedPlace::Column(column) => format!("column: {}", column_text(column)),
        SurveyedPlace::Path(path, part) => format!("path: {path:?}{}", part_text(*part)),
    };
    let scale = match taken.scale == 1.0 {
        true => String::new(),
        false => format!(", scale: {:?}", taken.scale),
    };
    format!(
        "                // {}.\n                ({place}, signal: {:?}, unit: {:?}{scale}),",
        one_line(&taken.why),
        taken.signal,
        taken.unit
    )
}

fn column_text(column: &Column) -> String {
    match column {
        Column::Index(place) => format!("Index({place})"),
        other => format!("Name({:?})", other.to_string()),
    }
}

fn part_text(part: Part) -> String {
    match part {
        Part::Whole => String::new(),
        part => format!(", part: {part:?}"),
    }
}

fn sampling(clock: &Clock) -> String {
    match clock {
        Clock::Rate { hz, why } => {
            format!(
                "            // {}.\n            sampling: Rate(hz: {hz:?}),\n",
                one_line(why)
            )
        }
        Clock::Column(column, unit) => {
            let (kind, place) = match &column.place {
                SurveyedPlace::Column(place) => {
                    ("TimeColumn", format!("column: {}", column_text(place)))
                }
                SurveyedPlace::Path(path, part) => {
                    ("Times", format!("path: {path:?}{}", part_text(*part)))
                }
            };
            format!("            sampling: {kind}({place}, unit: {unit:?}),\n")
        }
    }
}

/// How recordings are cut, and the rig's constants.
fn rig(choice: &Choice) -> String {
    let is_linear = choice.taken.iter().any(|one| one.signal == Signal::Force);
    let lever = if is_linear {
        "Forces and lengths are those of the grip: m, c, k do not depend on this length."
    } else {
        "At 1 m mass_kg is the inertia in kg m², damping in N m s/rad, stiffness in N m/rad; where a hand or a load holds the \
         lever's end, write its length."
    };
    let (why, window) = match choice.pulse {
        Some(Pulse { start_s, length_s }) => (
            "One pulse each, behind a quiet part that measures bias and noise; Whole takes recordings as they are.",
            format!("Pulse(start_s: {start_s:?}, length_s: {length_s:?})"),
        ),
        None => (
            "Every recording as a whole; Pulse(start_s: …, length_s: …) where each holds one pulse behind a quiet part.",
            "Whole".to_owned(),
        ),
    };
    format!(
        "    preprocess: (\n        // {why}\n        window: {window},\n        // {lever}\n        // What turns with the tool \
         and is known (kg m²) goes into known_inertia; 0: all of it is identified.\n        rig: (lever_arm_m: 1.0, \
         known_inertia: Fixed(0.0)),\n    ),"
    )
}

/// A comment is one line, and says nothing that ends it.
fn one_line(text: &str) -> String {
    text.chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .collect()
}

/// The data's path as the study file names it: from its own folder where they lie below it, else in full.
pub(super) fn path_from(study_file: &Path, data: &Path) -> String {
    let folder = study_file
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let absolute = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let (folder, data) = (absolute(folder.unwrap_or(Path::new("."))), absolute(data));
    let named = match data.strip_prefix(&folder) {
        Ok(below)
            if below
                .components()
                .all(|part| matches!(part, Component::Normal(_))) =>
        {
            below.to_path_buf()
        }
        _ => data,
    };
    match named.as_os_str().is_empty() {
        true => ".".to_owned(),
        false => named.to_string_lossy().into_owned(),
    }
}
