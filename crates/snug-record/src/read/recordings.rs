//! Snug's own recordings as measurements.

use super::DEFAULT_LIMIT_BYTES;
use super::budget::{Budget, Exhausted};
use super::stream::{Completeness, Item, scan};
use crate::error::RecordError;
use crate::messages::measurement;
use crate::messages::measurement::{Assembly, CHANNELS, FileHeader};
use crate::messages::signals;
use crate::messages::signals::MeasuredSample;
use crate::messages::window::Window;
use crate::topic;
use crate::topic::Measured;
use snug_campaign::{Recording, TimeBase};
use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

/// How much of a measurement file a recording holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Extent {
    /// The whole file as it was measured, quiet parts included.
    Whole,
    /// The tightenings' windows one after another, each a segment: zeroed and corrected, without the quiet parts.
    Windows {
        /// Every how many-th sample of the original is there, the largest over its tightenings; 1 means that the windows
        /// are complete, bit for bit.
        stored_every: usize,
    },
}

/// One measurement file out of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedFile {
    /// The measurement. For [`Extent::Windows`] sample 0 of a segment is the window's first sample, whose time in the
    /// original segment [`Window::time_base`] says; `time_base.start_s` is 0, and the label is the file's stem.
    pub recording: Recording,
    /// Whether it is the whole file.
    pub extent: Extent,
}

/// What one of Snug's recordings holds.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedCampaign {
    /// The measurement files, in the order in which they were recorded.
    pub files: Vec<RecordedFile>,
    /// Every tightening's origin, onset, noise floor and corrections, in the order in which they were recorded.
    pub windows: Vec<Window>,
    /// The study as run (RON).
    pub study_ron: Option<String>,
    /// Messages on Snug's topics that could not be understood.
    pub malformed_messages: u64,
    /// Whether the file was read to its end.
    pub completeness: Completeness,
}

/// Reads the measurements out of a recording that Snug wrote.
///
/// A file that was kept whole comes back whole; of others come the windows of their tightenings. Tightenings of one file
/// with different sampling intervals or channels come as separate recordings of the same file. What is not Snug's is passed over, so a
/// foreign MCAP gives no files. Memory: [`DEFAULT_LIMIT_BYTES`].
///
/// # Errors
/// [`RecordError::NotMcap`] when the data do not begin as an MCAP file.
pub fn recordings(bytes: &[u8]) -> Result<RecordedCampaign, RecordError> {
    recordings_within(bytes, DEFAULT_LIMIT_BYTES)
}

/// [`recordings`] in at most about `limit_bytes` of memory beside `bytes`; what does not fit ends the reading as
/// [`Completeness::TooLarge`]. A sample of a window takes 100 bytes while it is read, one of a whole file 16 per channel.
///
/// # Errors
/// As [`recordings`].
pub fn recordings_within(bytes: &[u8], limit_bytes: u64) -> Result<RecordedCampaign, RecordError> {
    let mut reader = Reader::default();
    let completeness = scan(bytes, limit_bytes, |item, budget| {
        reader
            .item(&item, budget)
            .map_or(ControlFlow::Break(()), ControlFlow::Continue)
    })?;
    Ok(reader.finish(completeness))
}

/// Longest message about a window \[bytes\]; real ones have a few thousand.
const LONGEST_WINDOW_BYTES: usize = 1 << 20;
/// Memory that a window's or file's message takes when it is understood, per byte of its text, and beside it.
const MESSAGE_GROWTH: usize = 16;
const ENTRY_BYTES: usize = 1024;
/// Memory of a window's sample in its columns \[bytes\].
const COLUMNS_BYTES: u64 = 48;

#[derive(Default)]
struct Reader {
    topics: HashMap<u16, Measured>,
    whole: Vec<Assembly>,
    windows: Vec<(Window, Vec<MeasuredSample>)>,
    study_ron: Option<String>,
    malformed: u64,
}

impl Reader {
    fn item(&mut self, item: &Item<'_>, budget: &mut Budget) -> Result<(), Exhausted> {
        match item {
            Item::Channel { id, channel } => {
                match Measured::of(&channel.topic, &channel.schema.name) {
                    Some(found) => self.topics.insert(*id, found),
                    None => self.topics.remove(id),
                };
            }
            Item::Metadata(metadata) => {
                if metadata.name == topic::STUDY {
                    let study = metadata.entries.get("study_ron");
                    budget.spend(study.map_or(0, str::len) as u64)?;
                    self.study_ron = study.map(str::to_owned);
                }
            }
            Item::Message { id, data, .. } => {
                if let Some(&topic) = self.topics.get(id) {
                    self.pay(topic, data.len(), budget)?;
                    let understood = self.message(topic, data).is_some();
                    self.malformed += u64::from(!understood);
                }
            }
        }
        Ok(())
    }

    /// Pays for what a message of that length leaves in memory.
    fn pay(
        &mut self,
        topic: Measured,
        length: usize,
        budget: &mut Budget,
    ) -> Result<(), Exhausted> {
        match topic {
            Measured::Window if length > LONGEST_WINDOW_BYTES => Ok(()),
            Measured::Window | Measured::File => {
                budget.spend((MESSAGE_GROWTH.saturating_mul(length) + ENTRY_BYTES) as u64)
            }
            Measured::Samples => budget.spend(2 * length as u64),
            Measured::Signals => {
                budget.spend(COLUMNS_BYTES)?;
                match self.windows.last_mut() {
                    Some((_, samples)) => budget.grow(samples),
                    None => Ok(()),
                }
            }
        }
    }

    fn message(&mut self, topic: Measured, data: &[u8]) -> Option<()> {
        match topic {
            Measured::Window if data.len() > LONGEST_WINDOW_BYTES => return None,
            Measured::Window => {
                let window: Window = serde_json::from_slice(data).ok()?;
                if window.stored_every == 0 {
                    return None;
                }
                self.windows.push((window, Vec::new()));
            }
            Measured::Signals => {
                let sample = signals::decode(data)?;
                let (window, samples) = self.windows.last_mut()?;
                let fits = sample.tightening == window.tightening
                    && samples.len() < window.stored_samples();
                fits.then(|| samples.push(sample))?;
            }
            Measured::File => self
                .whole
                .push(Assembly::new(serde_json::from_slice(data).ok()?)),
            Measured::Samples => self.whole.last_mut()?.add(data)?,
        }
        Some(())
    }

    fn finish(self, completeness: Completeness) -> RecordedCampaign {
        let mut files: Vec<RecordedFile> = Vec::new();
        for assembly in self.whole {
            let (recording, complete) = assembly.finish();
            // A file cut short by a killed run stays as far as it goes: its last segments end beyond it.
            if !complete {
                tracing::debug!(file = recording.file, "the recording ends within this file");
            }
            files.push(RecordedFile {
                recording,
                extent: Extent::Whole,
            });
        }
        let whole: HashSet<String> = files
            .iter()
            .map(|file| file.recording.file.clone())
            .collect();
        let mut joined = Vec::new();
        let mut places = HashMap::new();
        let mut windows = Vec::with_capacity(self.windows.len());
        for (window, samples) in self.windows {
            if !whole.contains(&window.file) {
                append(&mut joined, &mut places, &window, &samples);
            }
            windows.push(window);
        }
        files.extend(
            joined
                .into_iter()
                .map(|(assembly, stored_every)| RecordedFile {
                    recording: assembly.finish().0,
                    extent: Extent::Windows { stored_every },
                }),
        );
        RecordedCampaign {
            files,
            windows,
            study_ron: self.study_ron,
            malformed_messages: self.malformed,
            completeness,
        }
    }
}

/// What windows have in common that stand in one recording.
#[derive(PartialEq, Eq, Hash)]
struct Kin {
    file: String,
    conditions: String,
    interval_bits: u64,
    channels: [bool; 5],
}

/// Puts a window behind the windows of the same file with the same conditions, interval and channels; `joined` are the
/// recordings of windows with the largest stride of each.
fn append(
    joined: &mut Vec<(Assembly, usize)>,
    places: &mut HashMap<Kin, usize>,
    window: &Window,
    samples: &[MeasuredSample],
) {
    let time_base = TimeBase {
        start_s: 0.0,
        ..window.stored_time_base()
    };
    let mut there = CHANNELS.map(|name| window.channels.iter().any(|channel| channel == name));
    // Every sample has a torque, whatever the window says.
    there[0] = true;
    let kin = Kin {
        file: window.file.clone(),
        conditions: format!("{:?}", window.conditions),
        interval_bits: time_base.interval_s.to_bits(),
        channels: there,
    };
    let place = *places.entry(kin).or_insert_with(|| {
        joined.push((Assembly::new(header(window, time_base, there)), 1));
        joined.len() - 1
    });
    let (assembly, stored_every) = &mut joined[place];
    *stored_every = window.stored_every.max(*stored_every);
    assembly.add_window(window, samples);
}

fn header(window: &Window, time_base: TimeBase, there: [bool; 5]) -> FileHeader {
    let stem = window.file.rsplit_once('.').map(|(stem, _)| stem);
    FileHeader {
        file: window.file.clone(),
        label: stem.unwrap_or(&window.file).to_owned(),
        conditions: window.conditions.clone(),
        time_base,
        samples: 0,
        channels: measurement::names(there),
        has_force_channel: there[4],
        grip_force_channel: None,
        segments: Vec::new(),
    }
}
