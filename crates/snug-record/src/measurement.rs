//! `/measurement/file` and `/measurement/samples`: whole measurement files, so that a recording can be evaluated anew
//! with its quiet parts and without the original files.

use crate::schema::{Field, Kind, Message, field};
use crate::window::{CONDITIONS, TIME_BASE};
use crate::wire::{Fields, doubles, put_bytes, put_doubles, put_unsigned};
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
    field("number", Kind::Count, "", "Number within the file"),
    field("start", Kind::Count, "", "First sample"),
    field("end", Kind::Count, "", "One past the last sample"),
    field(
        "event_times_s",
        Kind::List(&Kind::Double),
        "s",
        "The events' own clock: start, torque, stop",
    ),
];

/// The table of `/measurement/file`.
pub(crate) const FILE: Message = Message {
    name: "snug.MeasurementFile",
    about: "A measurement file; its samples follow on /measurement/samples",
    fields: &[
        field("file", Kind::Text, "", "File name"),
        field("label", Kind::Text, "", "What the file calls itself"),
        field("conditions", Kind::Object(CONDITIONS), "", "Conditions"),
        field("time_base", Kind::Object(TIME_BASE), "", "Sampling grid"),
        field("samples", Kind::Count, "", "Samples of every channel"),
        field(
            "channels",
            Kind::List(&Kind::Text),
            "",
            "Channels that are there",
        ),
        field(
            "has_force_channel",
            Kind::Flag,
            "",
            "A grip-force channel stands in the file",
        ),
        field("grip_force_channel", Kind::Text, "", "Its name in the file"),
        field(
            "segments",
            Kind::List(&Kind::Object(SEGMENT)),
            "",
            "The tightenings' places",
        ),
    ],
};

/// The table of `/measurement/samples`.
pub(crate) const SAMPLES: Message = Message {
    name: "snug.MeasurementSamples",
    about: "A block of samples of a measurement file, as it was measured",
    fields: &[
        field("file", Kind::Text, "", "File name"),
        field(
            "first_sample",
            Kind::Count,
            "",
            "Place of the first sample in the file",
        ),
        field(
            "torque_nm",
            Kind::List(&Kind::Double),
            "N m",
            "Torque on the joint T",
        ),
        field(
            "displacement_rad",
            Kind::List(&Kind::Double),
            "rad",
            "Angle",
        ),
        field(
            "velocity_rad_per_s",
            Kind::List(&Kind::Double),
            "rad/s",
            "Angular velocity",
        ),
        field(
            "acceleration_rad_per_s2",
            Kind::List(&Kind::Double),
            "rad/s^2",
            "Angular acceleration",
        ),
        field(
            "grip_force_n",
            Kind::List(&Kind::Double),
            "N",
            "Grip force F_op_J",
        ),
    ],
};

/// Names of the channels, in the order of their field numbers from 3.
const CHANNELS: [&str; 5] = [
    "torque_nm",
    "displacement_rad",
    "velocity_rad_per_s",
    "acceleration_rad_per_s2",
    "grip_force_n",
];

fn channels(recording: &Recording) -> [Option<&[f64]>; 5] {
    let motion = &recording.motion;
    [
        Some(&recording.torque_nm),
        motion.get(Quantity::Displacement),
        motion.get(Quantity::Velocity),
        motion.get(Quantity::Acceleration),
        recording.grip_force_n.as_deref(),
    ]
}

pub(crate) fn header(recording: &Recording) -> FileHeader {
    let channels = channels(recording);
    FileHeader {
        file: recording.file.clone(),
        label: recording.label.clone(),
        conditions: recording.conditions.clone(),
        time_base: recording.time_base,
        samples: longest(&channels),
        channels: CHANNELS
            .iter()
            .zip(channels)
            .filter(|(_, samples)| samples.is_some())
            .map(|(name, _)| (*name).to_owned())
            .collect(),
        has_force_channel: recording.has_force_channel,
        grip_force_channel: recording.grip_force_channel.clone(),
        segments: recording.segments.clone(),
    }
}

fn longest(channels: &[Option<&[f64]>; 5]) -> usize {
    let lengths = channels.iter().flatten().map(|samples| samples.len());
    lengths.max().unwrap_or(0)
}

/// The sample messages of a file, one after another. Channels may differ in length.
pub(crate) fn blocks(recording: &Recording) -> impl Iterator<Item = Vec<u8>> + '_ {
    let channels = channels(recording);
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
