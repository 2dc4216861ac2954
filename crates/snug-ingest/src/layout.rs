//! What a format of measurement files has to say and do; a new one implements [`Layout`] in a module of its own.

use crate::error::IngestError;
use crate::file::finding_log::FindingLog;
use crate::file::ingested::Ingested;
use crate::file::name::name_and_stem;
use crate::memory::Budget;
use crate::recording::condition_pattern::ConditionPattern;
use crate::recording::range;
use crate::recording::range::Range;
use crate::signal::Signal;
use crate::unit::Unit;
use snug_campaign::{Conditions, Motion, Recording, TimeBase};
use snug_files::Input;
use std::io::{Read as _, SeekFrom};
use std::path::Path;

/// The settings of one format, and how they make recordings of a file.
pub(crate) trait Layout {
    /// Endings of the files it reads, in lower case.
    fn endings(&self) -> &'static [&'static str];

    /// Checks the settings that no type can check.
    ///
    /// # Errors
    /// [`IngestError::Setting`] naming the field.
    fn check(&self) -> Result<(), IngestError>;

    /// The declared ranges, which are the segments 1, 2, … of every recording; none where files name their segments.
    fn ranges(&self) -> &[Range] {
        &[]
    }

    /// What the declared channels measure, in which unit, with which factor; none where the format fixes that.
    fn declared(&self) -> Vec<(Signal, Unit, f64)> {
        Vec::new()
    }

    /// The recordings in a file; `path` names it, `lever_arm_m` turns lengths of the grip into angles. All that is made of
    /// the file is taken from `budget` first.
    ///
    /// # Errors
    /// What keeps the whole file from being read; everything less is a finding.
    fn read(
        &self,
        input: &mut dyn Input,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
    ) -> Result<Ingested, IngestError>;
}

/// Checks a setting that is a positive number.
///
/// # Errors
/// [`IngestError::Setting`].
pub(crate) fn check_positive(field: &'static str, value: f64) -> Result<(), IngestError> {
    match value.is_finite() && value > 0.0 {
        true => Ok(()),
        false => Err(IngestError::setting(field, value, "a positive number")),
    }
}

/// Bytes at the start of a file by which it is judged.
pub(crate) const FIRST_BLOCK_BYTES: usize = 1 << 16;

/// The whole content of a file whose start `check` lets pass.
pub(crate) fn content(
    input: &mut dyn Input,
    budget: &Budget,
    check: fn(&[u8]) -> Result<(), IngestError>,
) -> Result<Vec<u8>, IngestError> {
    let length = input.seek(SeekFrom::End(0)).map_err(IngestError::Read)?;
    input.rewind().map_err(IngestError::Read)?;
    let mut start = Vec::new();
    (&mut *input)
        .take(FIRST_BLOCK_BYTES as u64)
        .read_to_end(&mut start)
        .map_err(IngestError::Read)?;
    check(&start)?;
    let mut content: Vec<u8> =
        budget.list("the file", usize::try_from(length).unwrap_or(usize::MAX))?;
    content.extend_from_slice(&start);
    // Not beyond the length for which there is room, should the file grow meanwhile.
    let rest = length.saturating_sub(start.len() as u64);
    input
        .take(rest)
        .read_to_end(&mut content)
        .map_err(IngestError::Read)?;
    Ok(content)
}

/// The whole content of a text file, without the mark that some programs put before UTF-8.
pub(crate) fn text(input: &mut dyn Input, budget: &Budget) -> Result<Vec<u8>, IngestError> {
    let mut content = content(input, budget, check_text)?;
    if content.starts_with(b"\xEF\xBB\xBF") {
        content.drain(..3);
    }
    Ok(content)
}

/// Whether the start of a file can be text: UTF-16, and whatever a broken disk leaves, has zero bytes.
fn check_text(start: &[u8]) -> Result<(), IngestError> {
    match start.iter().position(|&byte| byte == 0) {
        Some(offset) => Err(IngestError::NotText { offset }),
        None => Ok(()),
    }
}

/// What a channel measures, in which unit and with which factor, and its samples.
pub(crate) type Channel = ((Signal, Unit, f64), Vec<f64>);

/// The recording in the file at `path` of its channels on one time grid, converted to SI units about the joint.
pub(crate) fn recording(
    (ranges, conditions): (&[Range], Option<&ConditionPattern>),
    path: &Path,
    time_base: TimeBase,
    channels: Vec<Channel>,
    lever_arm_m: f64,
    log: &mut FindingLog,
) -> Recording {
    let (file, label) = name_and_stem(path);
    let samples = channels.first().map_or(0, |(_, samples)| samples.len());
    let conditions = match conditions {
        Some(pattern) => pattern.read(&[label.as_str()], log),
        None => Conditions::default(),
    };
    let mut recording = Recording {
        file,
        label,
        conditions,
        time_base,
        torque_nm: Vec::new(),
        motion: Motion::default(),
        grip_force_n: None,
        has_force_channel: false,
        grip_force_channel: None,
        segments: range::segments(ranges, samples, log),
    };
    for ((signal, unit, scale), mut samples) in channels {
        let factor = scale * unit.factor(signal, lever_arm_m).unwrap_or(f64::NAN);
        // Numbers that are in SI units already stay what they are, bit for bit.
        if factor != 1.0 {
            samples.iter_mut().for_each(|sample| *sample *= factor);
        }
        match signal.quantity() {
            Some(quantity) => recording.motion.set(quantity, samples),
            None if signal.is_input() => recording.torque_nm = samples,
            None => {
                recording.grip_force_n = Some(samples);
                recording.has_force_channel = true;
            }
        }
    }
    recording
}
