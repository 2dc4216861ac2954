//! MCAP files by hand, with lengths and content that no writer would give.

use mcap::records::op;
use std::io::Write as _;

pub fn text(out: &mut Vec<u8>, text: &[u8]) {
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(text);
}

pub fn record(out: &mut Vec<u8>, opcode: u8, body: &[u8]) {
    out.push(opcode);
    out.extend((body.len() as u64).to_le_bytes());
    out.extend(body);
}

pub fn schema(out: &mut Vec<u8>, id: u16, name: &[u8], encoding: &[u8], data: &[u8]) {
    let mut body = id.to_le_bytes().to_vec();
    text(&mut body, name);
    text(&mut body, encoding);
    text(&mut body, data);
    record(out, op::SCHEMA, &body);
}

pub fn channel(out: &mut Vec<u8>, id: u16, schema: u16, topic: &[u8], encoding: &[u8]) {
    let mut body = id.to_le_bytes().to_vec();
    body.extend(schema.to_le_bytes());
    text(&mut body, topic);
    text(&mut body, encoding);
    text(&mut body, b"");
    record(out, op::CHANNEL, &body);
}

pub fn message(out: &mut Vec<u8>, channel: u16, sequence: u32, data: &[u8]) {
    let mut body = channel.to_le_bytes().to_vec();
    body.extend(sequence.to_le_bytes());
    body.extend(u64::from(sequence).to_le_bytes());
    body.extend(u64::from(sequence).to_le_bytes());
    body.extend(data);
    record(out, op::MESSAGE, &body);
}

pub fn pack(compression: &str, content: &[u8]) -> Vec<u8> {
    match compression {
        "zstd" => zstd::bulk::compress(content, 1).expect("zstd packs"),
        "lz4" => {
            let mut encoder = lz4::EncoderBuilder::new().build(Vec::new()).expect("lz4");
            encoder.write_all(content).expect("a Vec takes all");
            encoder.finish().0
        }
        _ => content.to_vec(),
    }
}

/// A chunk of packed content with the length and checksum that it states of the content.
pub fn packed_chunk(out: &mut Vec<u8>, compression: &str, stated: u64, crc: u32, packed: &[u8]) {
    let mut body = vec![0; 16];
    body.extend(stated.to_le_bytes());
    body.extend(crc.to_le_bytes());
    text(&mut body, compression.as_bytes());
    body.extend((packed.len() as u64).to_le_bytes());
    body.extend(packed);
    record(out, op::CHUNK, &body);
}

pub fn chunk(out: &mut Vec<u8>, compression: &str, content: &[u8]) {
    let packed = pack(compression, content);
    let crc = crc32fast::hash(content);
    packed_chunk(out, compression, content.len() as u64, crc, &packed);
}

/// Magic number, header, `content`, footer, magic number.
pub fn file(content: &[u8]) -> Vec<u8> {
    let mut file = mcap::MAGIC.to_vec();
    record(&mut file, op::HEADER, &[0; 8]);
    file.extend(content);
    record(&mut file, op::DATA_END, &[0; 4]);
    record(&mut file, op::FOOTER, &[0; 20]);
    file.extend(mcap::MAGIC);
    file
}

/// Where the records of a file begin, for changes that hit one of them.
pub fn records(mut bytes: &[u8]) -> Vec<(u8, &[u8])> {
    let mut records = Vec::new();
    while bytes.len() >= 9 {
        let length = u64::from_le_bytes(bytes[1..9].try_into().expect("eight bytes")) as usize;
        let Some(body) = bytes.get(9..9 + length) else {
            break;
        };
        records.push((bytes[0], body));
        bytes = &bytes[9 + length..];
    }
    records
}

/// Compression and content of a chunk.
pub fn open_chunk(body: &[u8]) -> (String, Vec<u8>) {
    let word = |at: usize| u64::from_le_bytes(body[at..at + 8].try_into().expect("eight bytes"));
    let name = u32::from_le_bytes(body[28..32].try_into().expect("four bytes")) as usize;
    let compression = String::from_utf8_lossy(&body[32..32 + name]).into_owned();
    let packed = &body[40 + name..][..word(32 + name) as usize];
    let content = match compression.as_str() {
        "zstd" => zstd::bulk::decompress(packed, word(16) as usize).expect("zstd unpacks"),
        "lz4" => {
            let mut content = Vec::new();
            let mut decoder = lz4::Decoder::new(packed).expect("lz4");
            std::io::copy(&mut decoder, &mut content).expect("lz4 unpacks");
            content
        }
        _ => packed.to_vec(),
    };
    (compression, content)
}

/// The file again, with `change` made to the content of one chunk and lengths and checksums put right around it.
pub fn with_changed_chunk(
    bytes: &[u8],
    place: usize,
    change: impl FnOnce(&mut Vec<u8>),
) -> Vec<u8> {
    let records = records(&bytes[8..]);
    let chunks = records.iter().filter(|(op, _)| *op == op::CHUNK).count();
    let (mut changed, mut change) = (mcap::MAGIC.to_vec(), Some(change));
    let mut index = 0;
    for (opcode, body) in records {
        if opcode == op::CHUNK {
            if index == place % chunks.max(1) {
                let (compression, mut content) = open_chunk(body);
                if let Some(change) = change.take() {
                    change(&mut content);
                }
                chunk(&mut changed, &compression, &content);
                index += 1;
                continue;
            }
            index += 1;
        }
        record(&mut changed, opcode, body);
    }
    changed.extend(mcap::MAGIC);
    changed
}
