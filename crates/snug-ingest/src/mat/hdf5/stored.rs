//! The content of a file, as the HDF5 library asks for it.

use crate::error::IngestError;
use hdf5_pure::{FormatError, Source};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// How often a file may be read through. MATLAB's and h5py's own, with cells or without, are read 0.4 to 1.05 times.
const MOST_READINGS: u64 = 8;

/// Even a small file may be asked for this much \[bytes\].
const SMALLEST_BYTES: u64 = 64 << 20;

/// Content that ends the reading of a file which names the same bytes over and over: four thousand texts of an attribute,
/// each of which is one and the same of 4 MB.
#[derive(Clone)]
pub(super) struct Stored {
    bytes: Arc<Vec<u8>>,
    read_bytes: Arc<AtomicU64>,
}

impl Stored {
    pub(super) fn new(bytes: Vec<u8>) -> Self {
        Self {
            bytes: Arc::new(bytes),
            read_bytes: Arc::default(),
        }
    }

    pub(super) fn length(&self) -> u64 {
        self.bytes.len() as u64
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        Arc::unwrap_or_clone(self.bytes)
    }

    fn limit_bytes(&self) -> u64 {
        (MOST_READINGS * self.length()).max(SMALLEST_BYTES)
    }

    /// Whether the file stayed within what it may be asked for; where it did not, parts are missing in what was read.
    pub(super) fn check(&self) -> Result<(), IngestError> {
        if self.read_bytes.load(Ordering::Relaxed) > self.limit_bytes() {
            return Err(IngestError::Hdf5ReadOver {
                file_bytes: self.length(),
                limit_bytes: self.limit_bytes(),
            });
        }
        Ok(())
    }
}

impl Source for Stored {
    fn len(&self) -> u64 {
        self.length()
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), FormatError> {
        self.read_bytes
            .fetch_add(buffer.len() as u64, Ordering::Relaxed);
        if self.check().is_err() {
            return Err(FormatError::Source("read over and over".to_owned()));
        }
        let found = usize::try_from(offset)
            .ok()
            .and_then(|start| self.bytes.get(start..)?.get(..buffer.len()))
            .ok_or(FormatError::UnexpectedEof {
                expected: usize::try_from(offset)
                    .unwrap_or(usize::MAX)
                    .saturating_add(buffer.len()),
                available: self.bytes.len(),
            })?;
        buffer.copy_from_slice(found);
        Ok(())
    }
}
