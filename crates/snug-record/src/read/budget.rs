//! How much memory and work one file may cost.

/// A sum that can be spent once; lengths that a file claims are never paid for, only bytes that are there.
#[derive(Debug, Clone)]
pub(crate) struct Budget {
    left: u64,
}

/// The budget does not cover the cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Exhausted;

impl Budget {
    pub(crate) fn new(limit: u64) -> Self {
        Self { left: limit }
    }

    pub(crate) fn spend(&mut self, cost: u64) -> Result<(), Exhausted> {
        self.left = self.left.checked_sub(cost).ok_or(Exhausted)?;
        Ok(())
    }

    /// Makes room for one more item of a list, by half of what it holds rather than twice, and pays for it first.
    pub(crate) fn grow<T>(&mut self, list: &mut Vec<T>) -> Result<(), Exhausted> {
        if list.len() == list.capacity() {
            let more = (list.len() / 2).max(4);
            self.spend((more * size_of::<T>()) as u64)?;
            list.reserve_exact(more);
        }
        Ok(())
    }
}

/// How the bytes that a caller allows are shared out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// What the reader may keep \[bytes\].
    pub(crate) kept_bytes: u64,
    /// Longest chunk that is unpacked at once, and record of a longer one \[bytes\].
    pub(crate) chunk_bytes: u64,
    /// Content of all compressed chunks together \[bytes\].
    pub(crate) unpacked_bytes: u64,
}

/// A longer chunk is unpacked piece by piece.
const LONGEST_CHUNK_BYTES: u64 = 64 << 20;
/// Recordings are packed to a tenth or a hundredth; content of more than this many times the file's length is believed
/// up to the limit only.
const PLAUSIBLE_PACKING: u64 = 64;

impl Limits {
    pub(crate) fn new(limit_bytes: u64, file_bytes: usize) -> Self {
        let packed = (file_bytes as u64).saturating_mul(PLAUSIBLE_PACKING);
        Self {
            kept_bytes: limit_bytes / 4 * 3,
            chunk_bytes: (limit_bytes / 8).min(LONGEST_CHUNK_BYTES),
            unpacked_bytes: limit_bytes.saturating_add(packed),
        }
    }
}
