//! Files that ask for more memory or time than they are worth.

use super::forge::*;
use crate::read::*;
use mcap::records::op;

const LIMIT_BYTES: u64 = 32 << 20;

/// Reads with both readers and recovers; nothing may panic, and what is kept stays below the limit.
fn read(bytes: &[u8]) -> NumericChannels {
    recordings_within(bytes, LIMIT_BYTES).unwrap();
    crate::recover_within(bytes, std::io::sink(), LIMIT_BYTES).unwrap();
    let channels = numeric_channels_within(bytes, LIMIT_BYTES).unwrap();
    let kept: usize = channels.channels.iter().map(|c| c.values.len() * 16).sum();
    assert!(kept as u64 <= LIMIT_BYTES, "{kept} bytes kept");
    channels
}

fn too_large(bytes: &[u8]) {
    let found = read(bytes).completeness;
    assert!(
        matches!(found, Completeness::TooLarge { .. }),
        "{found:?} of {} bytes",
        bytes.len()
    );
}

fn damaged(bytes: &[u8]) {
    let found = read(bytes).completeness;
    assert!(matches!(found, Completeness::Damaged { .. }), "{found:?}");
}

#[test]
fn claimed_lengths_are_not_believed() {
    for opcode in [op::SCHEMA, op::CHANNEL, op::METADATA] {
        for length in [21, 1000, u32::MAX] {
            let mut body = length.to_le_bytes().repeat(5);
            body[4..8].copy_from_slice(&length.to_le_bytes());
            let mut content = Vec::new();
            record(&mut content, opcode, &body);
            damaged(&file(&content));
        }
    }
    let mut content = Vec::new();
    packed_chunk(&mut content, "zstd", u64::MAX, 0, &pack("zstd", &[0; 100]));
    damaged(&file(&content));
    for (compression, packed) in [
        ("zstd", &b"\x28\xb5\x2f\xfd"[..]),
        ("lz4", &b""[..]),
        ("snap", b"x"),
    ] {
        let mut content = Vec::new();
        packed_chunk(&mut content, compression, 1 << 30, 0, packed);
        damaged(&file(&content));
    }
    // The name of the compression, and the length of what is packed.
    for place in [28, 32] {
        let mut content = Vec::new();
        chunk(&mut content, "", &[]);
        content[9 + place..9 + place + 4].fill(0xff);
        damaged(&file(&content));
    }
    for opcode in 0..=20 {
        let mut bytes = file(&[]);
        bytes.truncate(bytes.len() - 8 - 29);
        bytes.push(opcode);
        bytes.extend([0xff; 8]);
        assert_eq!(read(&bytes).completeness, Completeness::Truncated);
    }
}

/// Content of two hundred times the limit, in a chunk that is unpacked piece by piece and in ones unpacked at once.
#[test]
fn a_bomb_of_messages_is_too_large() {
    for compression in ["zstd", "lz4"] {
        let mut piece = Vec::new();
        channel(&mut piece, 1, 0, b"/a", b"json");
        while piece.len() < 2 << 20 {
            message(&mut piece, 1, 1, b"1");
        }
        let mut content = Vec::new();
        for _ in 0..100 {
            chunk(&mut content, compression, &piece);
        }
        too_large(&file(&content));
    }
    let mut piece = Vec::new();
    channel(&mut piece, 1, 0, b"/a", b"opaque");
    message(&mut piece, 1, 1, &vec![0; 100 << 20]);
    let mut content = Vec::new();
    chunk(&mut content, "zstd", &piece);
    too_large(&file(&content));
    let zeros = vec![0; 256 << 20];
    let mut content = Vec::new();
    chunk(&mut content, "zstd", &zeros);
    too_large(&file(&content));
}

/// A zstd frame may ask for a window of gigabytes.
#[test]
fn a_wide_window_is_too_large() {
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0x00, 17 << 3];
    frame.extend([1, 0, 0]);
    let mut content = Vec::new();
    packed_chunk(&mut content, "zstd", 10, 0, &frame);
    too_large(&file(&content));
}

#[test]
fn a_long_chunk_is_checked_before_it_is_given() {
    let mut records = Vec::new();
    channel(&mut records, 1, 0, b"/a", b"json");
    while records.len() < 6 << 20 {
        message(
            &mut records,
            1,
            1,
            b"[1, 2, 3, \"...........................................\"]",
        );
    }
    let mut content = Vec::new();
    chunk(&mut content, "zstd", &records);
    let whole = read(&file(&content));
    assert_eq!(whole.completeness, Completeness::Complete);
    assert!(whole.channels[0].values.len() > 70_000);
    let crc = crc32fast::hash(&records) ^ 1;
    let mut content = Vec::new();
    let packed = pack("zstd", &records);
    packed_chunk(&mut content, "zstd", records.len() as u64, crc, &packed);
    damaged(&file(&content));
    assert!(read(&file(&content)).channels.is_empty());
    let torn = file(&content);
    let torn = read(&torn[..torn.len() * 2 / 3]);
    assert_eq!(torn.completeness, Completeness::Truncated);
    assert!(!torn.channels[0].values.is_empty());
}

#[test]
fn a_long_schema_of_many_channels_is_held_once() {
    let mut records = Vec::new();
    schema(&mut records, 1, b"A", b"protobuf", &vec![b' '; 1 << 20]);
    for id in 0..60_000 {
        channel(&mut records, id, 1, b"/a", b"protobuf");
    }
    let mut content = Vec::new();
    chunk(&mut content, "zstd", &records);
    too_large(&file(&content));
}

/// Long names are repeated in paths, and every message asks for all fields of its type.
#[test]
fn schemas_that_ask_for_much_work_end() {
    let name = vec![b'n'; 1000];
    let mut field = Vec::new();
    crate::encoding::wire::put_bytes(&mut field, 1, &name);
    let mut message_type = Vec::new();
    crate::encoding::wire::put_bytes(&mut message_type, 1, b"A");
    for number in 0..20_000 {
        let mut field = field.clone();
        crate::encoding::wire::put_unsigned(&mut field, 3, number + 2);
        crate::encoding::wire::put_unsigned(&mut field, 5, 1);
        crate::encoding::wire::put_bytes(&mut message_type, 2, &field);
    }
    let mut inner = Vec::new();
    crate::encoding::wire::put_unsigned(&mut inner, 3, 1);
    crate::encoding::wire::put_unsigned(&mut inner, 5, 11);
    crate::encoding::wire::put_bytes(&mut inner, 6, b"A");
    crate::encoding::wire::put_bytes(&mut message_type, 2, &inner);
    let (mut set, mut proto) = (Vec::new(), Vec::new());
    crate::encoding::wire::put_bytes(&mut proto, 4, &message_type);
    crate::encoding::wire::put_bytes(&mut set, 1, &proto);
    let mut budget = budget::Budget::new(1 << 22);
    let nested = [0x0a, 0].repeat(100_000);
    let decoder = protobuf::Decoder::new(&set, "A").unwrap();
    let decoded = decoder.decode(&nested, &mut budget, &mut |_, _| {});
    assert_eq!(decoded, Err(decoded::WORK_SPENT));
    let definition = "A[0] x\n".repeat(20_000) + "===\nMSG: p/A\nA[] a\n===\nMSG: p/B\n";
    let decoder = ros::Decoder::new(definition.as_bytes(), "p/Root", ros::Wire::Ros1).unwrap();
    let mut budget = budget::Budget::new(10_000);
    let decoded = decoder.decode(&[0; 100], &mut budget, &mut |_, _| {});
    assert_eq!(decoded, Err(decoded::WORK_SPENT));
}

#[test]
fn deep_and_wide_json_is_left_out() {
    let wide = format!(
        "{{\"a\":[{}0],\"b\":2,\"b\":3}}",
        "{\"\":0},".repeat(300_000)
    );
    let keys = format!(
        "{{\"{}\":{{{}\"z\":0}}}}",
        "k".repeat(500_000),
        "\"\":0,".repeat(100_000)
    );
    for (data, values) in [
        ("[".repeat(1_000_000).as_str(), 0),
        (&"{\"a\":".repeat(1_000_000), 0),
        (&"1".repeat(3_000_000), 0),
        (&format!("0.{}", "1".repeat(3_000_000)), 1),
        (&wide, 1),
        (&keys, 0),
    ] {
        let mut content = Vec::new();
        channel(&mut content, 1, 0, b"/a", b"json");
        message(&mut content, 1, 1, data.as_bytes());
        let read = read(&file(&content));
        let found: usize = read.channels.iter().map(|c| c.values.len()).sum();
        assert_eq!(found, values, "{}", &data[..10]);
        assert_eq!(read.completeness, Completeness::Complete);
    }
}

/// Many files, and many sampling intervals of one file: each window is found its place at once.
#[test]
fn many_files_and_windows_take_no_quadratic_time() {
    let window = |index: usize, file: usize| {
        format!(
            r#"{{"tightening":{index},"file":"f{file}","number":1,"conditions":{{}},
            "rig":{{"lever_arm_m":1,"known_inertia_kg_m2":1}},"time_base":{{"start_s":0,"interval_s":{}}},
            "samples":18446744073709551615,"stored_every":1,"onset":null,"channels":[]}}"#,
            index + 1
        )
    };
    for file_of in [|index: usize| index, |_| 0] {
        let mut records = Vec::new();
        schema(&mut records, 1, b"snug.Window", b"jsonschema", b"{}");
        channel(&mut records, 1, 1, b"/tightening/window", b"json");
        for index in 0..10_000 {
            message(&mut records, 1, 1, window(index, file_of(index)).as_bytes());
        }
        let mut content = Vec::new();
        chunk(&mut content, "zstd", &records);
        let campaign = recordings(&file(&content)).unwrap();
        assert_eq!(campaign.files.len(), 10_000);
    }
}

/// Changes within chunks, with checksums put right, reach every parser behind them.
#[test]
fn changed_content_never_panics() {
    let mut state = 7u64;
    let mut random = move |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % below
    };
    let original = super::FOREIGN;
    for round in 0..1500 {
        let bytes = with_changed_chunk(original, random(100), |content| {
            for _ in 0..=random(3) {
                let place = random(content.len());
                match round % 3 {
                    0 => content[place] = random(256) as u8,
                    1 => content[place] ^= 1 << random(8),
                    _ => {
                        let end = (place + 4).min(content.len());
                        content[place..end].fill([0, 0x7f, 0xff][random(3)]);
                    }
                }
            }
        });
        read(&bytes);
    }
}
