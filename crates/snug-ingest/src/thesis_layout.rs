//! MAT files in the layout of the thesis: one file per set of tightenings, channels and events as variables.

mod events;

use crate::finding_log::{About, FindingLog};
use crate::mat::{Content, MatFile, Value};
use crate::{ConditionPattern, IngestError, Ingested};
use serde::{Deserialize, Serialize};
use snug_campaign::{Motion, Recording, Segment, TimeBase};
use std::path::Path;

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

impl ThesisLayout {
    /// Checks the settings that no type can check.
    ///
    /// # Errors
    /// [`IngestError::Setting`] naming the field.
    pub fn check(&self) -> Result<(), IngestError> {
        if !(self.sample_rate_hz.is_finite() && self.sample_rate_hz > 0.0) {
            return Err(IngestError::Setting {
                field: "sample_rate_hz",
                value: self.sample_rate_hz.to_string(),
                allowed: "a positive number",
            });
        }
        for (field, names) in [
            ("acceleration", &self.acceleration),
            ("torque", &self.torque),
        ] {
            if names.is_empty() {
                return Err(IngestError::Setting {
                    field,
                    value: "[]".to_owned(),
                    allowed: "at least one variable name",
                });
            }
        }
        Ok(())
    }

    /// The recording that a MAT file holds; `path` names it.
    ///
    /// # Errors
    /// [`IngestError::MissingChannel`] or [`IngestError::UnusableChannel`] for acceleration and torque,
    /// [`IngestError::EventTable`] for a table of events that is none. Everything less is a finding.
    pub fn recording(&self, mat: &MatFile, path: &Path) -> Result<Ingested, IngestError> {
        let file = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let stem = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let mut log = FindingLog::new(&file);
        let mut channels = Channels {
            acceleration: required(mat, "acceleration", &self.acceleration, &mut log)?,
            torque: required(mat, "torque", &self.torque, &mut log)?,
            force: None,
        };
        let force = present(mat, &self.force, &mut log);
        if let Some((name, value)) = force {
            channels.force = vector(value);
            if channels.force.is_none() {
                log.left_out(
                    "unusable_channel",
                    About::Channel(name),
                    format!(
                        "the grip-force channel is {}; expected a non-empty real vector",
                        value.describe()
                    ),
                );
            }
        }
        let samples = channels.equalise(&mut log);
        let rate_hz = self.rate_hz(mat, &mut log);
        let segments = self.segments(mat, rate_hz, samples, &mut log)?;
        let file_name = present(mat, &self.file_name, &mut log).and_then(|(_, value)| label(value));
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
            has_force_channel: force.is_some(),
            grip_force_channel: force.map(|(name, _)| name.to_owned()),
            segments,
        };
        Ok(Ingested {
            recordings: vec![recording],
            findings: log.finish(),
        })
    }

    fn rate_hz(&self, mat: &MatFile, log: &mut FindingLog) -> f64 {
        let Some((name, value)) = present(mat, &self.sample_rate, log) else {
            return self.sample_rate_hz;
        };
        let declared = self.sample_rate_hz;
        let found = match value.to_f64().as_deref() {
            Some(&[rate]) => Some(rate),
            _ => value.text().and_then(|text| events::number(&text)),
        };
        match found.filter(|rate| rate.is_finite() && *rate > 0.0) {
            Some(rate) => {
                if (rate - declared).abs() > 1e-6 * declared {
                    log.note(
                        "sample_rate_differs",
                        About::Channel(name),
                        format!("the file says {rate} Hz, the study {declared} Hz; the file's own rate is used"),
                    );
                }
                rate
            }
            None => {
                log.note(
                    "sample_rate_unusable",
                    About::Channel(name),
                    format!(
                        "{} is no positive number; the study's {declared} Hz are used",
                        value.describe()
                    ),
                );
                declared
            }
        }
    }

    fn segments(
        &self,
        mat: &MatFile,
        rate_hz: f64,
        samples: usize,
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
            return Ok(vec![Segment {
                number: 1,
                start: 0,
                end: samples,
                event_times_s: None,
            }]);
        };
        let times = events::times(table).ok_or_else(|| IngestError::EventTable {
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
        self.acceleration.truncate(shortest);
        self.torque.truncate(shortest);
        if let Some(force) = &mut self.force {
            force.truncate(shortest);
        }
        shortest
    }
}

/// The variable under the first accepted name that is there.
fn present<'a>(
    mat: &'a MatFile,
    accepted: &'a [String],
    log: &mut FindingLog,
) -> Option<(&'a str, &'a Value)> {
    let mut found = accepted
        .iter()
        .filter_map(|name| mat.variable(name).map(|value| (name.as_str(), value)));
    let first = found.next()?;
    for (other, _) in found {
        log.note(
            "channel_twice",
            About::Channel(other),
            format!(
                "the file holds both {} and {other}; {} is used",
                first.0, first.0
            ),
        );
    }
    Some(first)
}

fn required(
    mat: &MatFile,
    channel: &str,
    accepted: &[String],
    log: &mut FindingLog,
) -> Result<Vec<f64>, IngestError> {
    let (name, value) = present(mat, accepted, log).ok_or_else(|| IngestError::MissingChannel {
        channel: channel.to_owned(),
        accepted: accepted.to_vec(),
        present: mat
            .variables
            .iter()
            .map(|variable| variable.name.clone())
            .collect(),
    })?;
    vector(value).ok_or_else(|| IngestError::UnusableChannel {
        channel: channel.to_owned(),
        variable: name.to_owned(),
        found: value.describe(),
    })
}

/// The samples of a non-empty real vector.
fn vector(value: &Value) -> Option<Vec<f64>> {
    value
        .to_f64()
        .filter(|samples| !samples.is_empty() && value.is_vector())
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
