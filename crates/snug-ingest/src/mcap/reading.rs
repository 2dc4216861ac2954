//! An MCAP file to recordings: whole measurements that Snug recorded, or declared channels on one time grid.

use super::{McapChannel, McapLayout};
use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::file::ingested::Ingested;
use crate::layout;
use crate::layout::Layout as _;
use crate::memory::Budget;
use crate::recording::sampling;
use crate::recording::sampling::{Timed, Track};
use snug_campaign::excerpt;
use snug_campaign::{Recording, TimeBase};
use snug_record::RecordError;
use snug_record::read::{
    Completeness, Extent, NumericChannel, numeric_channels_within, recordings_within,
};
use std::path::Path;

/// The recordings in an MCAP file's content; `path` names it, `lever_arm_m` turns lengths of the grip into angles.
///
/// A file that ends too early, or is damaged, gives what came before, and a finding.
///
/// # Errors
/// [`IngestError::Mcap`] for content that is no MCAP, [`IngestError::NoRecordings`],
/// [`IngestError::MissingChannel`], [`IngestError::TimeNotRising`] and [`IngestError::TimeGap`].
pub(crate) fn read(
    layout: &McapLayout,
    content: &[u8],
    path: &Path,
    lever_arm_m: f64,
    budget: &Budget,
) -> Result<Ingested, IngestError> {
    let mut log = FindingLog::new(path);
    let recordings = if layout.channels.is_empty() {
        own(content, budget, &mut log)?
    } else {
        vec![declared(
            layout,
            content,
            path,
            lever_arm_m,
            budget,
            &mut log,
        )?]
    };
    Ok(Ingested {
        recordings,
        findings: log.finish(),
    })
}

/// Memory that understanding a recording takes at most beside a file's length times the factor below \[bytes\].
const AT_LEAST_BYTES: u64 = 16_000_000;
/// Memory per byte of the file: packed to a tenth, a sample of 10 bytes takes 100 while it is read.
const BYTES_PER_BYTE: u64 = 128;

/// Decodes within what is left of the budget, which is held meanwhile.
fn bounded<T>(
    content: &[u8],
    budget: &Budget,
    decode: impl FnOnce(&[u8], u64) -> Result<T, RecordError>,
) -> Result<T, IngestError> {
    let most = AT_LEAST_BYTES.saturating_add(BYTES_PER_BYTE.saturating_mul(content.len() as u64));
    let (mark, limit) = (budget.mark(), budget.left_bytes().min(most));
    budget.spend("the messages of a recording", limit)?;
    let decoded = decode(content, limit)?;
    budget.back_to(mark);
    Ok(decoded)
}

/// Measurements that Snug wrote.
fn own(
    content: &[u8],
    budget: &Budget,
    log: &mut FindingLog,
) -> Result<Vec<Recording>, IngestError> {
    let campaign = bounded(content, budget, recordings_within)?;
    for file in &campaign.files {
        // Torque, force and three quantities of motion at most.
        budget.spend_on::<[f64; 5]>("a channel", file.recording.torque_nm.len())?;
    }
    report_completeness(&campaign.completeness, log);
    if campaign.malformed_messages > 0 {
        log.left_out(
            "malformed_messages",
            About::File,
            format!(
                "{} messages could not be understood",
                campaign.malformed_messages
            ),
        );
    }
    if campaign.files.is_empty() {
        let present = bounded(content, budget, numeric_channels_within)?.channels;
        return Err(IngestError::NoRecordings {
            present: present
                .iter()
                .map(|c| format!("{} {}", c.topic, c.field))
                .collect(),
        });
    }
    let mut measurements = Vec::with_capacity(campaign.files.len());
    for file in campaign.files {
        if let Extent::Windows { stored_every } = file.extent {
            log.note(
                "windows_only",
                About::File,
                format!(
                    "of {} the recording holds only the tightenings' windows (every {stored_every}. sample), without the \
                     quiet part before them",
                    excerpt(&file.recording.file)
                ),
            );
        }
        measurements.push(file.recording);
    }
    Ok(measurements)
}

/// One recording of the declared channels.
fn declared(
    declared: &McapLayout,
    content: &[u8],
    path: &Path,
    lever_arm_m: f64,
    budget: &Budget,
    log: &mut FindingLog,
) -> Result<Recording, IngestError> {
    let mut read = bounded(content, budget, numeric_channels_within)?;
    report_completeness(&read.completeness, log);
    for channel in &read.channels {
        budget.spend_on::<[f64; 2]>("a channel", channel.values.len())?;
    }
    let tracks = (declared.channels.iter())
        .map(|wanted| track(wanted, &mut read.channels))
        .collect::<Result<Vec<Track>, IngestError>>()?;
    let (time_base, channels) = match declared.rate_hz {
        Some(hz) => {
            let time_base = TimeBase {
                start_s: 0.0,
                interval_s: 1.0 / hz,
            };
            (time_base, sampling::cut_to_shortest(tracks, log))
        }
        None => {
            let (times_s, mut channels) = sampling::align(tracks, log)?;
            let timed = Timed {
                times_s,
                channels: &mut channels,
                place: &|index| format!("sample {}", index + 1),
                budget,
            };
            let time_base = sampling::uniform(timed, declared.tolerance_ratio, log)?;
            (time_base, channels)
        }
    };
    let signals = declared.declared().into_iter();
    Ok(layout::recording(
        (&declared.ranges, declared.conditions.as_ref()),
        path,
        time_base,
        signals.zip(channels).collect(),
        lever_arm_m,
        log,
    ))
}

/// The values of a declared channel, taken out of those that were read.
fn track(wanted: &McapChannel, channels: &mut [NumericChannel]) -> Result<Track, IngestError> {
    let is_it =
        |channel: &NumericChannel| channel.topic == wanted.topic && channel.field == wanted.field;
    let Some(place) = channels.iter().position(is_it) else {
        let name = |channel: &NumericChannel| format!("{} {}", channel.topic, channel.field);
        return Err(IngestError::MissingChannel {
            channel: wanted.signal.in_words(),
            accepted: vec![format!("{} {}", wanted.topic, wanted.field)],
            present: channels.iter().map(name).collect(),
        });
    };
    let found = &mut channels[place];
    Ok(Track {
        times_s: found.log_time_s.clone(),
        values: std::mem::take(&mut found.values),
    })
}

fn report_completeness(completeness: &Completeness, log: &mut FindingLog) {
    let message = match completeness {
        Completeness::Complete => return,
        Completeness::Truncated => "the file ends early; what came before was read".to_owned(),
        Completeness::Damaged { messages, fault } => {
            format!(
                "the file is damaged after {messages} messages ({}); what came before was read",
                excerpt(fault)
            )
        }
        Completeness::TooLarge { messages } => {
            format!("reading stopped after {messages} messages, at the limit for one file's values")
        }
    };
    log.left_out("file_incomplete", About::File, message);
}
