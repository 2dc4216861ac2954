//! `/measurement/file` and `/measurement/samples`: whole measurement files, so that a recording can be evaluated anew
//! with its quiet parts and without the original files.

use crate::encoding::schema::{Field, Message, count, flag, group, list, number, text};
use crate::encoding::wire::{Fields, doubles, put_bytes, put_doubles, put_unsigned};
use crate::messages::signals::MeasuredSample;
use crate::messages::window::{CONDITIONS, TIME_BASE, Window};
use serde::{Deserialize, Serialize};
use snug_campaign::{Conditions, Motion, Quantity, Recording, Segment, TimeBase};

/// Samples of one message; five channels of doubles stay below 64 KiB.
pub(crate) const BLOCK_SAMPLES: usize = 1600;

/// A measurement file without its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct FileHeader {
    pub(crate) file: String,
    pub(crate) label: String,
    pub(crate) conditions: Conditions,
    pub(crate) time_base: TimeBase,
    pub(crate) samples: usize,
    pub(crate) channels: Vec<String>,
    pub(crate) has_force_channel: bool,
    #[serde(default)]
    pub(crate) grip_force_channel: Option<String>,
    pub(crate) segments: Vec<Segment>,
}

const SEGMENT: &[Field] = &[
    count("number", "Number within the file"),
    count("start", "First sample"),
    count("end", "One past the last sample"),
    list(number(
        "event_times_s",
        "s",
        "The events' own clock: start, torque, stop",
    )),
];

/// The table of `/measurement/file`.
pub(crate) const FILE: Message = Message {
    name: "snug.MeasurementFile",
    about: "A measurement file; its samples follow on /measurement/samples",
    fields: &[
        text("file", "File name"),
        text("label", "What the file calls itself"),
        group("conditions", CONDITIONS, "Conditions"),
        group("time_base", TIME_BASE, "Sampling grid"),
        count("samples", "Samples of every channel"),
        list(text("channels", "Channels that are there")),
        flag(
            "has_force_channel",
            "A grip-force channel stands in the file",
        ),
        text("grip_force_channel", "Its name in the file"),
        list(group("segments", SEGMENT, "The tightenings' places")),
    ],
};

/// The table of `/measurement/samples`.
pub(crate) const SAMPLES: Message = Message {
    name: "snug.MeasurementSamples",
    about: "A block of samples of a measurement file, as it was measured",
    fields: &[
        text("file", "File name"),
        count("first_sample", "Place of the first sample in the file"),
        list(number("torque_nm", "N m", "Torque on the joint T")),
        list(number("displacement_rad", "rad", "Angle")),
        list(number("velocity_rad_per_s", "rad/s", "Angular velocity")),
        list(number(
            "acceleration_rad_per_s2",
            "rad/s^2",
            "Angular acceleration",
        )),
        list(number("grip_force_n", "N", "Grip force F_op_J")),
    ],
};

/// Names of the channels, in the order of their field numbers from 3.
pub(crate) const CHANNELS: [&str; 5] = [
    "torque_nm",
    "displacement_rad",
    "velocity_rad_per_s",
    "acceleration_rad_per_s2",
    "grip_force_n",
];

/// The samples of [`CHANNELS`]; `None` for a channel that is not there.
pub(crate) type Channels<'a> = [Option<&'a [f64]>; 5];

/// The channels of a file or of a tightening.
pub(crate) fn channels<'a>(
    torque_nm: &'a [f64],
    motion: &'a Motion,
    grip_force_n: Option<&'a [f64]>,
) -> Channels<'a> {
    let [displacement, velocity, acceleration] = Quantity::ALL.map(|quantity| motion.get(quantity));
    [
        Some(torque_nm),
        displacement,
        velocity,
        acceleration,
        grip_force_n,
    ]
}

/// Names of the channels that are there.
pub(crate) fn names(there: [bool; 5]) -> Vec<String> {
    let named = CHANNELS.iter().zip(there).filter(|(_, there)| *there);
    named.map(|(name, _)| (*name).to_owned()).collect()
}

fn of_file(recording: &Recording) -> Channels<'_> {
    let grip_force_n = recording.grip_force_n.as_deref();
    channels(&recording.torque_nm, &recording.motion, grip_force_n)
}

pub(crate) fn header(recording: &Recording) -> FileHeader {
    let channels = of_file(recording);
    FileHeader {
        file: recording.file.clone(),
        label: recording.label.clone(),
        conditions: recording.conditions.clone(),
        time_base: recording.time_base,
        samples: longest(&channels),
        channels: names(channels.map(|samples| samples.is_some())),
        has_force_channel: recording.has_force_channel,
        grip_force_channel: recording.grip_force_channel.clone(),
        segments: recording.segments.clone(),
    }
}

fn longest(channels: &Channels<'_>) -> usize {
    let lengths = channels.iter().flatten().map(|samples| samples.len());
    lengths.max().unwrap_or(0)
}

/// The sample messages of a file, one after another. Channels may differ in length.
pub(crate) fn blocks(recording: &Recording) -> impl Iterator<Item = Vec<u8>> + '_ {
    let channels = of_file(recording);
    (0..longest(&channels))
        .step_by(BLOCK_SAMPLES)
        .map(move |first| {
            let mut out = Vec::new();
            put_bytes(&mut out, 1, recording.file.as_bytes());
            put_unsigned(&mut out, 2, first as u64);
            for (number, samples) in (3..).zip(channels) {
                let samples = samples.unwrap_or_default();
                let end = samples.len().min(first + BLOCK_SAMPLES);
                if first < end {
                    put_doubles(&mut out, number, &samples[first..end]);
                }
            }
            out
        })
}

/// First sample of a block and one past its last; `None` when it is malformed.
pub(crate) fn block_samples(message: &[u8]) -> Option<(u64, u64)> {
    let (mut first, mut longest) = (0u64, 0);
    for field in Fields::of(message) {
        match field? {
            (2, value) => first = value.varint()?,
            (3..=7, value) => longest = longest.max(value.bytes()?.len() / 8),
            _ => {}
        }
    }
    Some((first, first.checked_add(longest as u64)?))
}

/// A measurement file as it is put together again.
pub(crate) struct Assembly {
    header: FileHeader,
    channels: [Option<Vec<f64>>; 5],
}

impl Assembly {
    pub(crate) fn new(header: FileHeader) -> Self {
        let channels = CHANNELS.map(|name| {
            header
                .channels
                .iter()
                .any(|channel| channel == name)
                .then(Vec::new)
        });
        Self { header, channels }
    }

    /// Adds a block; `None` when it is malformed, belongs to another file or leaves a gap.
    pub(crate) fn add(&mut self, message: &[u8]) -> Option<()> {
        let mut first_sample = 0;
        for field in Fields::of(message) {
            match field? {
                (1, value) if value.text()? != self.header.file => return None,
                (2, value) => first_sample = value.varint()?,
                (number @ 3..=7, value) => {
                    let channel = self.channels[number as usize - 3].as_mut()?;
                    if channel.len() as u64 != first_sample {
                        return None;
                    }
                    channel.extend(doubles(value.bytes()?)?);
                }
                _ => {}
            }
        }
        Some(())
    }

    /// Adds a window's samples as a segment of their own.
    pub(crate) fn add_window(&mut self, window: &Window, samples: &[MeasuredSample]) {
        let start = self.channels[0].as_ref().map_or(0, Vec::len);
        for (index, channel) in self.channels.iter_mut().enumerate() {
            if let Some(channel) = channel {
                channel.extend(samples.iter().map(|sample| sample.channels[index]));
            }
        }
        self.header.segments.push(Segment {
            number: window.number,
            start,
            // Beyond the samples when the recording ends within this window.
            end: start.saturating_add(window.stored_samples()),
            event_times_s: None,
        });
    }

    /// The recording, and whether all its samples are there.
    pub(crate) fn finish(self) -> (Recording, bool) {
        let whole = self
            .channels
            .iter()
            .flatten()
            .map(Vec::len)
            .max()
            .is_none_or(|longest| longest >= self.header.samples);
        let [
            torque_nm,
            displacement,
            velocity,
            acceleration,
            grip_force_n,
        ] = self.channels;
        let recording = Recording {
            file: self.header.file,
            label: self.header.label,
            conditions: self.header.conditions,
            time_base: self.header.time_base,
            torque_nm: torque_nm.unwrap_or_default(),
            motion: Motion {
                displacement_rad: displacement,
                velocity_rad_per_s: velocity,
                acceleration_rad_per_s2: acceleration,
            },
            grip_force_n,
            has_force_channel: self.header.has_force_channel,
            grip_force_channel: self.header.grip_force_channel,
            segments: self.header.segments,
        };
        (recording, whole)
    }
}
