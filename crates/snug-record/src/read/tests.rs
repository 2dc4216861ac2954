//! What the readers make of files that other programs wrote.
#![allow(clippy::unwrap_used)]

mod forge;
mod hostile;

use super::*;
use crate::error::RecordError;
use proptest::prelude::*;

/// Written by the reference implementations; its content is listed in the folder's README.
const FOREIGN: &[u8] = include_bytes!("../../tests/data/foreign.mcap");

fn values<'a>(channels: &'a NumericChannels, topic: &str, field: &str) -> &'a [f64] {
    &channels
        .channel(topic, field)
        .unwrap_or_else(|| panic!("no {topic} {field}"))
        .values
}

#[test]
fn json_numbers_come_with_path_and_time() {
    let channels = numeric_channels(FOREIGN).unwrap();
    assert_eq!(channels.start_ns, 1_700_000_000_000_000_000);
    assert_eq!(values(&channels, "/json", "a.b[0]"), [0.0, 1.0, 2.0]);
    assert_eq!(values(&channels, "/json", "a.b[2]"), [-3e-7; 3]);
    assert_eq!(values(&channels, "/json", "flag"), [0.0, 1.0, 0.0]);
    assert_eq!(values(&channels, "/bare", ""), [0.0, 1.5, 3.0]);
    let late = channels.channel("/json", "late").unwrap();
    assert_eq!(late.values, [7.0]);
    assert!((late.log_time_s[0] - 200e-6).abs() < 1e-15);
    assert!(channels.channel("/json", "text").is_none());
}

#[test]
fn every_protobuf_type_is_read() {
    let channels = numeric_channels(FOREIGN).unwrap();
    let single = |value: f32| f64::from(value);
    let power = |exponent: i32| 2f64.powi(exponent);
    let expected: [(&str, [f64; 3]); 15] = [
        ("f_double", [0.0, -1.25e-300, -2.5e-300]),
        ("f_float", [0.0, single(0.1), single(0.2)]),
        ("f_int64", [0.0, -power(53), -power(54)]),
        ("f_uint64", [0.0, power(63), power(63)]),
        ("f_int32", [0.0, -7.0, -14.0]),
        ("f_fixed64", [0.0, power(40) + 1.0, power(40) + 2.0]),
        ("f_fixed32", [0.0, power(32) - 1.0, power(32) - 2.0]),
        ("f_bool", [0.0, 1.0, 1.0]),
        ("f_uint32", [0.0, power(32) - 1.0, power(32) - 1.0]),
        ("f_sfixed32", [0.0, -power(31), -power(31)]),
        ("f_sfixed64", [0.0, -power(62), -power(62)]),
        ("f_sint32", [0.0, -power(31), -power(31)]),
        ("f_sint64", [0.0, -1.0, -2.0]),
        ("phase", [0.0, 3.0, 3.0]),
        // Inside a nested message absence is zero as well, once the nested message is there.
        ("points[0].x", [1.0, 2.0, f64::NAN]),
    ];
    for (field, wanted) in expected {
        let found = values(&channels, "/protobuf", field);
        let wanted: Vec<f64> = wanted.into_iter().filter(|v| !v.is_nan()).collect();
        assert_eq!(found, wanted, "{field}");
    }
    let lists: [(&str, &[f64]); 8] = [
        ("packed[1]", &[-1.0, -1.0]),
        ("packed[2]", &[300.0, 600.0]),
        ("unpacked[0]", &[0.5, 0.5]),
        ("unpacked[1]", &[-0.25, -0.25]),
        ("force.x", &[1.5, 3.0]),
        ("force.y", &[0.0, 0.0]),
        ("points[1].y", &[-1.0, -2.0]),
        ("maybe", &[0.0]),
    ];
    for (field, wanted) in lists {
        assert_eq!(values(&channels, "/protobuf", field), wanted, "{field}");
    }
    assert!(channels.channel("/protobuf", "f_string").is_none());
    assert!(channels.channel("/protobuf", "long[0]").is_none());
}

#[test]
fn ros_messages_are_read() {
    let channels = numeric_channels(FOREIGN).unwrap();
    let ros2: [(&str, &[f64]); 12] = [
        ("header.stamp.sec", &[10.0, 11.0, 12.0]),
        ("header.stamp.nanosec", &[5.0; 3]),
        ("flag", &[0.0, 1.0, 0.0]),
        ("a", &[-5.0, -6.0, -7.0]),
        ("b", &[0.0, 0.1, 0.2]),
        ("c", &[-300.0; 3]),
        ("fixed[2]", &[0.0, -1.0, -2.0]),
        ("seq[0]", &[0.1, 0.1]),
        ("seq[1]", &[0.2]),
        ("vectors[0].x", &[0.0, 1.0, 2.0]),
        ("vectors[0].z", &[3.0; 3]),
        (
            "last",
            &[
                -1_099_511_627_776.0,
                -1_099_511_627_777.0,
                -1_099_511_627_778.0,
            ],
        ),
    ];
    for (field, wanted) in ros2 {
        assert_eq!(values(&channels, "/ros2", field), wanted, "{field}");
    }
    let ros1: [(&str, &[f64]); 8] = [
        ("header.seq", &[0.0, 1.0, 2.0]),
        ("header.stamp", &[100.5; 3]),
        ("a", &[200.0, 201.0, 202.0]),
        ("b", &[0.0, -0.1, -0.2]),
        ("seq[0]", &[0.5; 3]),
        ("seq[1]", &[0.0, 1.0, 2.0]),
        ("d", &[-0.75; 3]),
        ("v.z", &[0.0, 3.0, 6.0]),
    ];
    for (field, wanted) in ros1 {
        assert_eq!(values(&channels, "/ros1", field), wanted, "{field}");
    }
    assert!(channels.channel("/ros2", "C").is_none(), "a constant");
}

#[test]
fn what_cannot_be_read_is_named() {
    let channels = numeric_channels(FOREIGN).unwrap();
    assert_eq!(channels.completeness, Completeness::Complete);
    let named: Vec<(&str, u64)> = channels
        .unreadable
        .iter()
        .map(|unreadable| (unreadable.topic.as_str(), unreadable.messages))
        .collect();
    assert_eq!(
        named,
        [
            ("/json", 1),
            ("/opaque", 3),
            ("/protobuf", 1),
            ("/protobuf", 2)
        ]
    );
    assert!(channels.unreadable[1].reason.contains("cbor"));
}

#[test]
fn what_is_no_mcap_says_so() {
    for bytes in [&b""[..], b"MATLAB 5.0 MAT-file", &mcap::MAGIC[..5]] {
        let error = numeric_channels(bytes).unwrap_err();
        assert!(
            matches!(error, RecordError::NotMcap { length, .. } if length == bytes.len()),
            "{error}"
        );
    }
    assert!(recordings(FOREIGN).unwrap().files.is_empty());
}

#[test]
fn a_cut_file_gives_what_came_before() {
    let whole = numeric_channels(FOREIGN).unwrap();
    let mut most = 0;
    for length in 8..FOREIGN.len() {
        let cut = numeric_channels(&FOREIGN[..length]).unwrap();
        for channel in &cut.channels {
            let all = values(&whole, &channel.topic, &channel.field);
            assert_eq!(channel.values, all[..channel.values.len()]);
        }
        let found = cut
            .channels
            .iter()
            .map(|channel| channel.values.len())
            .sum();
        assert!(
            found >= most,
            "{found} values after {length} bytes, {most} before"
        );
        most = found;
    }
    let all: usize = whole.channels.iter().map(|c| c.values.len()).sum();
    assert_eq!(most, all);
}

/// The reference file without compression; without checksums, changed bytes reach the decoders.
fn uncompressed(checksums: bool) -> Vec<u8> {
    let mut writer = mcap::WriteOptions::new()
        .compression(None)
        .calculate_chunk_crcs(checksums)
        .create(std::io::Cursor::new(Vec::new()))
        .unwrap();
    for message in mcap::MessageStream::new(FOREIGN).unwrap() {
        writer.write(&message.unwrap()).unwrap();
    }
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

/// One flipped bit in a plain chunk's values is noticed by its checksum, and nothing of the chunk is given.
#[test]
fn a_flipped_bit_is_damage() {
    let mut bytes = uncompressed(true);
    let place = bytes
        .windows(4)
        .position(|window| window == b"\"b\":")
        .unwrap();
    bytes[place + 7] ^= 1;
    let read = numeric_channels(&bytes).unwrap();
    assert!(matches!(
        read.completeness,
        Completeness::Damaged { messages: 0, .. }
    ));
    assert!(read.channels.is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn changed_bytes_never_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12)) {
        let mut bytes = uncompressed(false);
        for (place, value) in changes {
            let place = 8 + place.index(bytes.len() - 8);
            bytes[place] = value;
        }
        let read = numeric_channels(&bytes).unwrap();
        for channel in &read.channels {
            prop_assert_eq!(channel.values.len(), channel.log_time_s.len());
        }
        recordings(&bytes).unwrap();
    }

    #[test]
    fn changed_compressed_bytes_never_panic(place in 8..FOREIGN.len(), value: u8) {
        let mut bytes = FOREIGN.to_vec();
        bytes[place] = value;
        numeric_channels(&bytes).unwrap();
    }

    #[test]
    fn garbage_never_panics(garbage in prop::collection::vec(any::<u8>(), 0..600)) {
        let mut bytes = mcap::MAGIC.to_vec();
        bytes.extend(&garbage);
        numeric_channels(&bytes).unwrap();
        recordings(&bytes).unwrap();
    }

    #[test]
    fn decoders_never_panic(schema in prop::collection::vec(any::<u8>(), 0..80), data in prop::collection::vec(any::<u8>(), 0..80)) {
        if let Some(decoder) = protobuf::Decoder::new(&schema, "") {
            let mut budget = budget::Budget::new(1 << 20);
            let _ = decoder.decode(&data, &mut budget, &mut |_, _| {});
        }
    }

    #[test]
    fn ros_decoder_never_panics(data in prop::collection::vec(any::<u8>(), 0..120)) {
        let definition = b"A[] many\nB[200][200] empty\nfloat64[] values\n===\nMSG: A\nA[] inner\nB[300] none\n===\nMSG: B\n";
        for wire in [ros::Wire::Cdr, ros::Wire::Ros1] {
            let decoder = ros::Decoder::new(definition, "pkg/Root", wire).unwrap();
            let mut budget = budget::Budget::new(1 << 20);
            let _ = decoder.decode(&data, &mut budget, &mut |_, _| {});
        }
    }
}
