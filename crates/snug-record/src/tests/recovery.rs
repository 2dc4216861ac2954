//! What comes out of recordings that were cut, as other readers see it.

use super::{record, small_chunks, tightenings};
use crate::error::RecordError;
use crate::read::{Completeness, recordings};
use crate::recorder::Recorder;
use crate::recover::{Recovery, recover, recover_within};
use crate::settings::{Compression, RecordSettings};
use mcap::records::{MessageHeader, Metadata};
use mcap::{Attachment, MessageStream, Summary, WriteOptions, Writer};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Cursor;

/// A message with everything that belongs to it.
#[derive(Debug, PartialEq, Clone)]
struct Seen {
    topic: String,
    encoding: String,
    metadata: BTreeMap<String, String>,
    schema: Option<(String, String, Vec<u8>)>,
    sequence: u32,
    times: [u64; 2],
    data: Vec<u8>,
}

fn messages(bytes: &[u8]) -> Vec<Seen> {
    MessageStream::new(bytes)
        .unwrap()
        .map(|message| {
            let message = message.unwrap();
            let channel = &message.channel;
            let schema = channel.schema.as_ref();
            Seen {
                topic: channel.topic.clone(),
                encoding: channel.message_encoding.clone(),
                metadata: channel.metadata.clone(),
                schema: schema.map(|s| (s.name.clone(), s.encoding.clone(), s.data.to_vec())),
                sequence: message.sequence,
                times: [message.log_time, message.publish_time],
                data: message.data.into_owned(),
            }
        })
        .collect()
}

fn recovered(bytes: &[u8]) -> (Recovery, Vec<u8>) {
    let mut out = Vec::new();
    let recovery = recover(bytes, &mut out).unwrap();
    // What was recovered lacks nothing, whatever was missing before.
    let again = recover(&out, std::io::sink()).unwrap();
    assert!(again.was_complete, "{again:?}");
    assert_eq!(again.messages, recovery.messages);
    let summary = Summary::read(&out).unwrap().unwrap();
    assert_eq!(summary.stats.unwrap().message_count, recovery.messages);
    (recovery, out)
}

#[test]
fn every_cut_gives_the_beginning_of_the_original() {
    for compression in [Compression::Zstd, Compression::Lz4, Compression::Off] {
        let bytes = record(RecordSettings {
            compression,
            ..small_chunks()
        });
        let original = messages(&bytes);
        let mut most = 0;
        for length in (8..bytes.len()).step_by(397) {
            let (recovery, out) = recovered(&bytes[..length]);
            let found = messages(&out);
            assert_eq!(found, original[..found.len()], "cut at {length}");
            assert_eq!(found.len() as u64, recovery.messages);
            assert!(found.len() >= most && !recovery.was_complete);
            // No more than a chunk, or a record of the index, is lost.
            assert!(recovery.dropped_bytes < 10_000, "{recovery:?}");
            most = found.len();
            let (here, there) = (recordings(&bytes[..length]), recordings(&out));
            let (here, there) = (here.unwrap(), there.unwrap());
            assert_eq!(format!("{:?}", here.files), format!("{:?}", there.files));
            assert_eq!(here.windows.len() as u64, {
                let incomplete = recovery.incomplete_tightenings.len() as u64;
                recovery.tightenings + incomplete
            });
            assert_eq!(here.study_ron, there.study_ron);
        }
        assert_eq!(most, original.len());
        let (recovery, out) = recovered(&bytes);
        assert!(recovery.was_complete);
        assert_eq!((recovery.metadata, recovery.attachments), (1, 1));
        assert_eq!(messages(&out), original);
    }
}

#[test]
fn what_is_whole_and_what_is_missing_is_named() {
    let mut end = Vec::new();
    let mut recorder = Recorder::new(&mut end, RecordSettings::default()).unwrap();
    for (result, traces) in &tightenings()[..2] {
        recorder.tightening(result, traces, None).unwrap();
    }
    recorder.finish().unwrap();
    let chunks: Vec<usize> = Summary::read(&end)
        .unwrap()
        .unwrap()
        .chunk_indexes
        .iter()
        .map(|index| index.chunk_start_offset as usize)
        .collect();
    let (recovery, out) = recovered(&end[..chunks[1]]);
    assert_eq!(recovery.completeness, Completeness::Truncated);
    assert_eq!((recovery.tightenings, recovery.torn_messages), (1, 0));
    assert!(recovery.incomplete_tightenings.is_empty());
    let last = recovery.last_tightening.as_ref().unwrap();
    assert_eq!(last.file, "TP3_QS_Soft_8.mat");
    let summary = Summary::read(&out).unwrap().unwrap();
    assert_eq!(summary.metadata_indexes[0].name, crate::topic::RECOVERED);
    // The last message index is torn: all data are there.
    let (recovery, _) = recovered(&end[..end.len() - 3]);
    assert!(recovery.data_complete && !recovery.was_complete);
    assert_eq!(recovery.tightenings, 2);
    assert_eq!(recovery.dropped_bytes, 5);
    assert!(recovery.to_string().contains("the index was not"));
}

/// Channels that differ in nothing but their number, repeated declarations, attachments, metadata and private records.
fn foreign() -> Vec<u8> {
    let options = WriteOptions::new()
        .profile("ros2")
        .chunk_size(Some(500))
        .compression(Some(mcap::Compression::Lz4));
    let mut writer: Writer<_> = options.create(Cursor::new(Vec::new())).unwrap();
    let names = BTreeMap::from([("serial".to_owned(), "7".to_owned())]);
    writer
        .add_schema_with_id(900, "A", "jsonschema", b"{}")
        .unwrap();
    writer
        .add_schema_with_id(7, "A", "jsonschema", b"{}")
        .unwrap();
    for (id, schema, names) in [
        (4000, 900, &names),
        (5, 7, &names),
        (6, 0, &BTreeMap::new()),
        (0, 0, &names),
    ] {
        writer
            .add_channel_with_id(id, schema, "/same", "json", names)
            .unwrap();
    }
    for sequence in 0..100u32 {
        let header = MessageHeader {
            channel_id: [4000, 5, 6, 0][sequence as usize % 4],
            sequence: sequence / 3,
            log_time: u64::MAX - u64::from(sequence),
            publish_time: u64::from(sequence),
        };
        let data = format!("{{\"a\":{sequence}}}");
        writer
            .write_to_known_channel(&header, data.as_bytes())
            .unwrap();
        if sequence % 25 == 0 {
            writer
                .attach(&Attachment {
                    log_time: 1,
                    create_time: 2,
                    name: format!("file {sequence}"),
                    media_type: "x/y".into(),
                    data: Cow::Owned(vec![sequence as u8; 1000]),
                })
                .unwrap();
            writer
                .write_metadata(&Metadata {
                    name: "same".into(),
                    metadata: BTreeMap::from([("at".into(), sequence.to_string())]),
                })
                .unwrap();
            writer
                .write_private_record(0x90, b"private", Default::default())
                .unwrap();
        }
    }
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

#[test]
fn everything_but_messages_survives_too() {
    let bytes = foreign();
    let start = Summary::read(&bytes).unwrap().unwrap();
    let (recovery, out) = recovered(&bytes[..bytes.len() - 8]);
    assert!(recovery.data_complete && recovery.left_out.is_empty());
    assert_eq!((recovery.attachments, recovery.metadata), (4, 4));
    assert_eq!(messages(&out), messages(&bytes));
    let end = Summary::read(&out).unwrap().unwrap();
    assert_eq!(end.channels, start.channels);
    assert_eq!(end.schemas, start.schemas);
    for (one, other) in start.attachment_indexes.iter().zip(&end.attachment_indexes) {
        let one = mcap::read::attachment(&bytes, one).unwrap();
        assert_eq!(one, mcap::read::attachment(&out, other).unwrap());
    }
    for (one, other) in start.metadata_indexes.iter().zip(&end.metadata_indexes) {
        let one = mcap::read::metadata(&bytes, one).unwrap();
        assert_eq!(one, mcap::read::metadata(&out, other).unwrap());
    }
    let private = |bytes: &[u8]| bytes.windows(7).filter(|part| part == b"private").count();
    assert_eq!((private(&bytes), private(&out)), (4, 4));
    assert!(out[..60].windows(4).any(|part| part == b"ros2"));
    let mut most = 0;
    for length in (8..bytes.len()).step_by(13) {
        let (recovery, out) = recovered(&bytes[..length]);
        let found = messages(&out);
        assert_eq!(found, messages(&bytes)[..found.len()]);
        let saved = recovery.messages + recovery.attachments + recovery.metadata;
        assert!(saved >= most, "cut at {length}");
        most = saved;
    }
}

#[test]
fn a_damaged_chunk_is_left_out_and_named() {
    let mut bytes = record(RecordSettings {
        compression: Compression::Off,
        ..small_chunks()
    });
    let original = messages(&bytes);
    let index = Summary::read(&bytes).unwrap().unwrap().chunk_indexes;
    let place = index[3].chunk_start_offset as usize;
    bytes[place + 2000] ^= 1;
    let (recovery, out) = recovered(&bytes);
    assert_eq!(recovery.left_out.len(), 1);
    let reason = &recovery.left_out[0].reason;
    assert!(
        reason.contains(&format!("byte {place}")) && reason.contains("checksum"),
        "{reason}"
    );
    assert!(matches!(
        recovery.completeness,
        Completeness::Damaged { .. }
    ));
    assert!(!recovery.incomplete_tightenings.is_empty());
    let found = messages(&out);
    assert!(found.len() + 40 > original.len() && found.len() < original.len());
    assert!(found.iter().all(|message| original.contains(message)));
    assert_eq!(found.last(), original.last());
    // The first chunk declares only what the others use, and the summary repeats it.
    bytes[place + 2000] ^= 1;
    bytes[index[0].chunk_start_offset as usize + 2000] ^= 1;
    let (recovery, out) = recovered(&bytes);
    assert_eq!(recovery.left_out.len(), 1);
    assert_eq!(messages(&out), original);
    // A wrong bit between the chunks is seen by the checksum of all data.
    let mut bytes = record(small_chunks());
    bytes[8 + 9 + 6] ^= 1;
    let recovery = recover(&bytes, std::io::sink()).unwrap();
    assert!(!recovery.was_complete);
}

#[test]
fn a_broken_end_is_written_anew() {
    let bytes = record(small_chunks());
    let original = messages(&bytes);
    let footer = bytes.len() - 37;
    for place in footer - 200..bytes.len() {
        let mut broken = bytes.clone();
        broken[place] ^= 0x40;
        let (recovery, out) = recovered(&broken);
        assert!(!recovery.was_complete, "byte {place}");
        assert_eq!(messages(&out), original);
    }
    let mut longer = bytes.clone();
    longer.extend(b"more");
    assert!(!recover(&longer, std::io::sink()).unwrap().was_complete);
}

#[test]
fn what_is_no_recording_is_an_error() {
    for bytes in [&b""[..], &mcap::MAGIC[..7], b"MATLAB 5.0 MAT-file"] {
        let error = recover(bytes, std::io::sink()).unwrap_err();
        assert!(matches!(error, RecordError::NotMcap { length, .. } if length == bytes.len()));
    }
    let (recovery, out) = recovered(mcap::MAGIC);
    assert_eq!((recovery.messages, recovery.dropped_bytes), (0, 0));
    assert!(messages(&out).is_empty());
}

#[test]
fn a_failing_writer_and_a_bomb_are_named() {
    let bytes = record(small_chunks());
    let mut full = [0u8; 5000];
    let error = recover(&bytes, &mut full[..]).unwrap_err();
    assert!(
        error.to_string().contains("failed to write whole buffer"),
        "{error}"
    );
    let recovery = recover_within(&bytes, std::io::sink(), 60_000).unwrap();
    assert!(matches!(
        recovery.completeness,
        Completeness::TooLarge { .. }
    ));
    assert!(recovery.dropped_bytes > 0);
}
