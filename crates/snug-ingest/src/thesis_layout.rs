//! MAT files in the layout of the thesis: one file per set of tightenings, channels and events as variables.

mod events;

use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::file::ingested::Ingested;
use crate::file::name::{ending, name_and_stem};
use crate::layout;
use crate::layout::Layout;
use crate::mat;
use crate::mat::{Content, MatSelection, Value};
use crate::mcap::McapLayout;
use crate::memory::Budget;
use crate::recording::condition_pattern::ConditionPattern;
use crate::recording::range;
use serde::{Deserialize, Serialize};
use snug_campaign::{Motion, Recording, Segment, TimeBase};
use snug_files::Input;
use std::path::Path;

/// A label is a name, and names are short \[characters\].
const LONGEST_LABEL: usize = 255;

/// Under which names a MAT file holds what. Of several accepted names the first that is present counts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ThesisLayout {
    /// Angular acceleration of the tool \[rad/s²\], required. Default `angle_acc_Acc_FIR150`,
    /// `Data1_angle_acc_Acc_FIR150`.
    pub acceleration: Vec<String>,
    /// Joint torque \[Nm\], required. Default `Inline_Torque`, `Inline`, `Data1_Inline`.
    pub torque: Vec<String>,
    /// Grip force \[N\], optional; its presence selects the tool's inertia with the force transducer. Default `F_op_J`,
    /// `Data1_F_op_J_FIR_Filter_OFFSET`.
    pub force: Vec<String>,
    /// Table of events: three rows per tightening (start, torque, stop), the time in s in the third column. Default
    /// `Events`.
    pub events: Vec<String>,
    /// Text that names the conditions. Default `File_name`.
    pub file_name: Vec<String>,
    /// Sampling rate \[Hz\], optional; where it is there it counts. Default `Sample_rate`.
    pub sample_rate: Vec<String>,
    /// Sampling rate of files that do not say theirs \[Hz\]. Default 10000.
    pub sample_rate_hz: f64,
    /// How the label names the conditions; asked of `File_name` first, then of the file's own name.
    pub conditions: ConditionPattern,
}

impl Default for ThesisLayout {
    fn default() -> Self {
        let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect();
        Self {
            acceleration: names(&["angle_acc_Acc_FIR150", "Data1_angle_acc_Acc_FIR150"]),
            torque: names(&["Inline_Torque", "Inline", "Data1_Inline"]),
            force: names(&["F_op_J", "Data1_F_op_J_FIR_Filter_OFFSET"]),
            events: names(&["Events"]),
            file_name: names(&["File_name"]),
            sample_rate: names(&["Sample_rate"]),
            sample_rate_hz: 10_000.0,
            conditions: ConditionPattern::default(),
        }
    }
}

impl Layout for ThesisLayout {
    fn endings(&self) -> &'static [&'static str] {
        &["mat", "mcap"]
    }

    fn check(&self) -> Result<(), IngestError> {
        layout::check_positive("sample_rate_hz", self.sample_rate_hz)?;
        for (field, names) in [
            ("acceleration", &self.acceleration),
            ("torque", &self.torque),
        ] {
            if names.is_empty() {
                let allowed = "at least one variable name";
                return Err(IngestError::setting(field, "[]", allowed));
            }
        }
        Ok(())
    }

    fn read(
        &self,
        input: &mut dyn Input,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
    ) -> Result<Ingested, IngestError> {
        if ending(path) == "mcap" {
            return McapLayout::default().read(input, path, lever_arm_m, budget);
        }
        let selection = mat::select(input, &|name| self.wants(name), budget)?;
        self.within(selection, path, budget)
    }
}

impl ThesisLayout {
    /// Whether a variable of this name is read.
    fn wants(&self, name: &str) -> bool {
        [
            &self.acceleration,
            &self.torque,
            &self.force,
            &self.events,
            &self.file_name,
            &self.sample_rate,
        ]
        .into_iter()
        .flatten()
        .any(|wanted| wanted == name)
    }

    /// The recording in the variables that are wanted; `path` names it.
    ///
    /// A damaged force, label or sampling rate costs itself, and is a finding.
    ///
    /// # Errors
    /// [`IngestError::MissingChannel`], [`IngestError::UnusableChannel`] or [`IngestError::DamagedVariable`] for
    /// acceleration and torque, [`IngestError::EventTable`] or [`IngestError::DamagedVariable`] for events. Everything
    /// less is a finding.
    fn within(
        &self,
        mut mat: MatSelection,
        path: &Path,
        budget: &Budget,
    ) -> Result<Ingested, IngestError> {
        let (file, stem) = name_and_stem(path);
        let mut log = FindingLog::new(path);
        let mat = &mut mat;
        let mut channels = Channels {
            acceleration: required(mat, "acceleration", &self.acceleration, budget, &mut log)?,
            torque: required(mat, "torque", &self.torque, budget, &mut log)?,
            force: None,
        };
        let force = present(mat, &self.force, &mut log);
        let grip_force_channel = force.as_ref().map(|(name, _)| (*name).to_owned());
        if let Some((name, value)) = force {
            channels.force = grip_force(name, value, budget, &mut log)?;
        }
        let samples = channels.equalise(&mut log);
        let rate_hz = self.rate_hz(mat, &mut log);
        let segments = self.segments(mat, rate_hz, samples, budget, &mut log)?;
        let file_name = self.label(mat, &mut log);
        let labels: Vec<&str> = file_name
            .iter()
            .map(String::as_str)
            .chain([stem.as_str()])
            .collect();
        let conditions = self.conditions.read(&labels, &mut log);
        let recording = Recording {
            label: file_name.clone().unwrap_or(stem),
            file,
            conditions,
            time_base: TimeBase {
                start_s: 0.0,
                interval_s: 1.0 / rate_hz,
            },
            torque_nm: channels.torque,
            motion: Motion {
                acceleration_rad_per_s2: Some(channels.acceleration),
                ..Motion::default()
            },
            grip_force_n: channels.force,
            has_force_channel: grip_force_channel.is_some(),
            grip_force_channel,
            segments,
        };
        Ok(Ingested {
            recordings: vec![recording],
            findings: log.finish(),
        })
    }

    fn rate_hz(&self, mat: &mut MatSelection, log: &mut FindingLog) -> f64 {
        let Some((name, value)) = present(mat, &self.sample_rate, log) else {
            return self.sample_rate_hz;
        };
        let declared = self.sample_rate_hz;
        let reason = match value {
            Ok(value) => match rate(&value) {
                Some(rate) => {
                    if (rate - declared).abs() > 1e-6 * declared {
                        log.note(
                            "sample_rate_differs",
                            About::Channel(name),
                            format!("the file says {rate} Hz, the study {declared} Hz; the file's own rate is used"),
                        );
                    }
                    return rate;
                }
                None => format!("{} is no positive number", value.describe()),
            },
            Err(reason) => format!("cannot be read: {reason}"),
        };
        log.note(
            "sample_rate_unusable",
            About::Channel(name),
            format!("{reason}; the study's {declared} Hz are used"),
        );
        declared
    }

    /// The text that names the conditions.
    fn label(&self, mat: &mut MatSelection, log: &mut FindingLog) -> Option<String> {
        let (name, value) = present(mat, &self.file_name, log)?;
        let reason = match value {
            Ok(value) => match label(&value) {
                Some(label) if label.chars().count() > LONGEST_LABEL => {
                    format!("is longer than {LONGEST_LABEL} characters")
                }
                label => return label,
            },
            Err(reason) => format!("cannot be read: {reason}"),
        };
        log.note(
            "label_unusable",
            About::Channel(name),
            format!("{reason}; the file's own name is used"),
        );
        None
    }

    fn segments(
        &self,
        mat: &mut MatSelection,
        rate_hz: f64,
        samples: usize,
        budget: &Budget,
        log: &mut FindingLog,
    ) -> Result<Vec<Segment>, IngestError> {
        let Some((name, table)) = present(mat, &self.events, log) else {
            log.note(
                "no_events",
                About::File,
                format!(
                    "no table of events ({}); the whole file of {samples} samples is one segment",
                    self.events.join(" or ")
                ),
            );
            return Ok(range::segments(&[], samples, log));
        };
        // A damaged table is not one without events: the tightenings in it would be lost silently.
        let table = table.map_err(|reason| damaged("events", name, reason))?;
        budget.spend_on::<[u64; 8]>("events", events::rows(&table))?;
        let times = events::times(&table).ok_or_else(|| IngestError::EventTable {
            variable: name.to_owned(),
            found: table.describe(),
        })?;
        Ok(events::segments(&times, rate_hz, samples, log))
    }
}

struct Channels {
    acceleration: Vec<f64>,
    torque: Vec<f64>,
    force: Option<Vec<f64>>,
}

impl Channels {
    /// Cuts all channels to the shortest one's length and returns it.
    fn equalise(&mut self, log: &mut FindingLog) -> usize {
        let (acceleration, torque) = (self.acceleration.len(), self.torque.len());
        let force = self.force.as_ref().map(Vec::len);
        let shortest = acceleration.min(torque).min(force.unwrap_or(usize::MAX));
        if acceleration != torque || force.is_some_and(|force| force != torque) {
            let force = force.map_or(String::new(), |force| format!(", force {force}"));
            log.repaired(
                "unequal_lengths",
                About::File,
                format!(
                    "channels have different lengths (acceleration {acceleration}, torque {torque}{force} samples); \
                     the first {shortest} samples of each are used"
                ),
            );
        }
        let others = [&mut self.acceleration, &mut self.torque];
        for channel in others.into_iter().chain(&mut self.force) {
            channel.truncate(shortest);
            channel.shrink_to_fit();
        }
        shortest
    }
}

/// A variable's value, or why it cannot be read.
type Found = Result<Value, IngestError>;

/// The variable under the first accepted name that is there.
fn present<'a>(
    mat: &mut MatSelection,
    accepted: &'a [String],
    log: &mut FindingLog,
) -> Option<(&'a str, Found)> {
    let mut found = accepted
        .iter()
        .map(String::as_str)
        .filter(|name| mat.present.iter().any(|present| present == name));
    let first = found.next()?;
    for other in found {
        log.note(
            "channel_twice",
            About::Channel(other),
            format!("the file holds both {first} and {other}; {first} is used"),
        );
    }
    let copies = mat.present.iter().filter(|name| *name == first).count();
    if copies > 1 {
        log.note(
            "channel_twice",
            About::Channel(first),
            format!("the file holds {first} {copies} times; the first is used"),
        );
    }
    mat.take(first).map(|found| (first, found))
}

fn required(
    mat: &mut MatSelection,
    channel: &str,
    accepted: &[String],
    budget: &Budget,
    log: &mut FindingLog,
) -> Result<Vec<f64>, IngestError> {
    let (name, value) = present(mat, accepted, log).ok_or_else(|| IngestError::MissingChannel {
        channel: channel.to_owned(),
        accepted: accepted.to_vec(),
        present: mat.present.clone(),
    })?;
    let value = value.map_err(|reason| damaged(channel, name, reason))?;
    let found = value.describe();
    vector(value, budget)?.ok_or_else(|| IngestError::UnusableChannel {
        channel: channel.to_owned(),
        variable: name.to_owned(),
        found,
    })
}

fn damaged(channel: &str, variable: &str, reason: IngestError) -> IngestError {
    IngestError::DamagedVariable {
        channel: channel.to_owned(),
        variable: variable.to_owned(),
        source: Box::new(reason),
    }
}

/// The grip force, which may be missing.
fn grip_force(
    name: &str,
    value: Found,
    budget: &Budget,
    log: &mut FindingLog,
) -> Result<Option<Vec<f64>>, IngestError> {
    let reason = match value {
        Ok(value) => {
            let found = value.describe();
            match vector(value, budget)? {
                Some(samples) => return Ok(Some(samples)),
                None => format!("is {found}; expected a non-empty real vector"),
            }
        }
        Err(reason) => format!("cannot be read: {reason}"),
    };
    log.left_out(
        "unusable_channel",
        About::Channel(name),
        format!("the grip-force channel {reason}"),
    );
    Ok(None)
}

/// The samples of a non-empty real vector.
fn vector(value: Value, budget: &Budget) -> Result<Option<Vec<f64>>, IngestError> {
    if !value.is_vector() {
        return Ok(None);
    }
    let (count, stored) = value.numbers_held();
    budget.spend_on::<f64>("a channel", count)?;
    let samples = value.into_f64().filter(|samples| !samples.is_empty());
    budget.give_back(stored);
    Ok(samples)
}

/// A positive number, as such or in words.
fn rate(value: &Value) -> Option<f64> {
    let number = match (value.to_f64().as_deref(), value.text()) {
        (Some(&[number]), _) => number,
        (_, Some(text)) => events::number(&text)?,
        _ => return None,
    };
    (number.is_finite() && number > 0.0).then_some(number)
}

/// Text, or a cell with nothing but text in it.
fn label(value: &Value) -> Option<String> {
    let text = match &value.content {
        Content::Cell(cells) => cells.first()?.text(),
        _ => value.text(),
    }?;
    let text = text.trim();
    (!text.is_empty()).then(|| text.to_owned())
}

#[cfg(test)]
mod tests;
