//! MAT files of level 5 whose compressed variables are changed inside and packed again.

use super::{Target, mat};
use crate::mutation::Mutation;
use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};
use rand::Rng;
use std::io::{Read, Write};

pub const TARGET: Target = Target {
    name: "mat5_packed",
    file: "input.mat",
    mutate,
    attempt: mat::attempt,
};

const HEADER_BYTES: usize = 128;
/// Type of a compressed element.
const COMPRESSED: u32 = 15;

fn mutate(mutation: &mut Mutation) -> Vec<u8> {
    let file = mutation.start();
    if mutation.random.random_range(0..4) == 0 {
        let mut file = file;
        mutation.change(&mut file);
        return file;
    }
    let mut changed = file[..HEADER_BYTES].to_vec();
    let mut rest = &file[HEADER_BYTES..];
    while let Some((tag, after)) = rest.split_first_chunk::<8>() {
        let length = u32::from_le_bytes([tag[4], tag[5], tag[6], tag[7]]) as usize;
        let (packed, after) = after.split_at(length.min(after.len()));
        rest = after;
        let mut inside = Vec::new();
        ZlibDecoder::new(packed).read_to_end(&mut inside).unwrap();
        if mutation.random.random_bool(0.4) {
            mutation.change(&mut inside);
        }
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(&inside).unwrap();
        let packed = encoder.finish().unwrap();
        changed.extend(COMPRESSED.to_le_bytes());
        changed.extend((packed.len() as u32).to_le_bytes());
        changed.extend(packed);
    }
    changed
}
