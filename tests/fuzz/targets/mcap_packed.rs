//! Recordings whose chunks are changed inside, packed again and given the right checksum.

use super::{Target, mcap};
use crate::mutation::Mutation;
use rand::Rng;

pub const TARGET: Target = Target {
    name: "mcap_packed",
    file: "input.mcap",
    mutate,
    attempt: mcap::attempt,
};

const MAGIC_BYTES: usize = 8;
/// Operation code of a chunk.
const CHUNK: u8 = 6;

/// Replaces every chunk by one without compression whose content is changed.
fn mutate(mutation: &mut Mutation) -> Vec<u8> {
    let file = mutation.start();
    let mut changed = file[..MAGIC_BYTES].to_vec();
    let mut rest = &file[MAGIC_BYTES..];
    while let Some((head, after)) = rest.split_first_chunk::<9>() {
        let length = u64::from_le_bytes(head[1..].try_into().unwrap()) as usize;
        let (body, after) = after.split_at(length.min(after.len()));
        rest = after;
        match (head[0], plain(body)) {
            (CHUNK, Some(mut records)) => {
                if mutation.random.random_bool(0.5) {
                    mutation.change(&mut records);
                }
                let mut chunk = body[..16].to_vec();
                chunk.extend((records.len() as u64).to_le_bytes());
                chunk.extend(crc32fast::hash(&records).to_le_bytes());
                chunk.extend(0_u32.to_le_bytes());
                chunk.extend((records.len() as u64).to_le_bytes());
                chunk.extend(records);
                changed.push(CHUNK);
                changed.extend((chunk.len() as u64).to_le_bytes());
                changed.extend(chunk);
            }
            _ => {
                changed.extend(head);
                changed.extend(body);
            }
        }
    }
    changed
}

/// The records of a chunk that is not compressed; the corpus has no others.
fn plain(body: &[u8]) -> Option<Vec<u8>> {
    (body.get(28..32)? == [0; 4]).then(|| body[40..].to_vec())
}
