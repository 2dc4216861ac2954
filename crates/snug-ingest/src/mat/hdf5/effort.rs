//! What a file may make its reader do.

use crate::error::IngestError;
use crate::memory::Budget;
use hdf5_pure::{Chunk, Dataset, Layout};
use snug_campaign::excerpt;

/// Deflate cannot make less than one byte of this many.
const LARGEST_COMPRESSION: u64 = 1032;

/// References to one and the same empty array compress to almost nothing; this many need no bytes in the file.
const FREE_OBJECTS: u64 = 1 << 18;

/// What a value takes beside its elements, with its name and shape \[bytes\].
const VALUE_BYTES: u64 = 256;

/// Even an empty file may ask for this much.
const SMALLEST_BYTES: u64 = 1 << 20;

/// How much a file may still make its reader do: so many objects, so many bytes of data.
pub(super) struct Effort<'a> {
    budget: &'a Budget,
    file_bytes: u64,
    objects: u64,
    bytes: u64,
}

impl<'a> Effort<'a> {
    pub(super) fn for_file(file_bytes: u64, budget: &'a Budget) -> Self {
        Self {
            budget,
            file_bytes,
            // Every visit follows a link or a reference of 8 bytes that stands in the file, unless it is compressed.
            objects: file_bytes / 8 + FREE_OBJECTS,
            bytes: file_bytes
                .saturating_mul(LARGEST_COMPRESSION)
                .max(SMALLEST_BYTES),
        }
    }

    pub(super) fn count_object(&mut self, path: &str) -> Result<(), IngestError> {
        self.budget.spend("HDF5 objects", VALUE_BYTES)?;
        match self.objects.checked_sub(1) {
            Some(left) => {
                self.objects = left;
                Ok(())
            }
            None => Err(too_large(path, u64::MAX, self.file_bytes)),
        }
    }

    /// Takes the dataset's whole data from the budget before they are read, decoded and as they are stored; the bytes
    /// of the stored form, which go when it is decoded.
    pub(super) fn spend(&mut self, path: &str, dataset: &Dataset) -> Result<u64, IngestError> {
        let failed = |error| super::failed(path, error);
        let element = dataset.element_size().map_err(failed)?;
        let claimed = bytes_of(&dataset.shape().map_err(failed)?, element);
        let (held, largest_piece) = match dataset.layout().map_err(failed)? {
            Layout::Chunked { chunk_shape, .. } => {
                let chunks = dataset.chunks().map_err(failed)?;
                let ends = |chunk: &Chunk| chunk.address.saturating_add(chunk.storage_size);
                // Room for a chunk is asked for before anybody looks whether the file holds it.
                if let Some(beyond) = chunks.iter().find(|one| ends(one) > self.file_bytes) {
                    return Err(too_large(path, beyond.storage_size, self.file_bytes));
                }
                let stored = match chunks.is_empty() {
                    true => self.file_bytes,
                    false => (chunks.iter())
                        .fold(0, |sum: u64, chunk| sum.saturating_add(chunk.storage_size)),
                };
                let stored = stored.min(self.file_bytes);
                let held = stored.saturating_mul(LARGEST_COMPRESSION);
                (held.max(SMALLEST_BYTES), bytes_of(&chunk_shape, element))
            }
            _ => (self.file_bytes.max(SMALLEST_BYTES), 0),
        };
        // A chunk is decoded whole even where the data need only its corner.
        if claimed.max(largest_piece) > held.min(self.bytes) {
            return Err(too_large(path, claimed.max(largest_piece), held));
        }
        self.bytes -= claimed;
        let on_the_way = claimed.saturating_add(largest_piece);
        self.budget.spend("HDF5 datasets", claimed)?;
        self.budget.spend("HDF5 datasets", on_the_way)?;
        Ok(on_the_way)
    }
}

fn bytes_of(shape: &[u64], element: u64) -> u64 {
    shape
        .iter()
        .fold(element, |product, &length| product.saturating_mul(length))
}

fn too_large(path: &str, claimed: u64, held: u64) -> IngestError {
    IngestError::Hdf5TooLarge {
        object: excerpt(path),
        claimed_bytes: claimed,
        held_bytes: held,
    }
}
