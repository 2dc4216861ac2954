//! Length and checksum of a file's content.

use crate::Disk;
use std::io::{self, Read};
use std::path::Path;

/// What tells whether a file still holds what was written: its length \[bytes\] and its CRC-32 (ISO 3309).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Digest {
    pub bytes: u64,
    pub crc32: u32,
}

/// Bytes read at a time.
const BLOCK_BYTES: usize = 1 << 16;

impl Digest {
    /// Of the file at `path`; `None` where it cannot be read, is a link, or of another length than `bytes`.
    pub fn of(disk: &dyn Disk, path: &Path, bytes: u64) -> Option<Self> {
        let metadata = disk.link_metadata(path).ok()?;
        if !metadata.is_file() || metadata.len() != bytes {
            return None;
        }
        let mut file = disk.open(path).ok()?;
        let mut sum = Sum::default();
        let mut block = vec![0; BLOCK_BYTES];
        loop {
            match file.read(&mut block) {
                Ok(0) => return Some(sum.digest()),
                Ok(length) => sum.add(&block[..length]),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(_) => return None,
            }
        }
    }
}

/// A digest in the making.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sum {
    bytes: u64,
    crc32: crc32fast::Hasher,
}

impl Sum {
    pub fn add(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        self.crc32.update(bytes);
    }

    pub fn digest(&self) -> Digest {
        Digest {
            bytes: self.bytes,
            crc32: self.crc32.clone().finalize(),
        }
    }
}
