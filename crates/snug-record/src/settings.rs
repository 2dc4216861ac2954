//! The recording's part of a study file: which samples are kept, compression, and sizes that bound file and memory.

use crate::error::RecordError;
use serde::{Deserialize, Serialize};

/// How a recording is written.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RecordSettings {
    /// Which samples of a tightening are written. By default the first hundred windows of 3000 samples are whole; 2687 of
    /// them take about 100 MB instead of 1 GB. Default: `Bounded(complete_samples: 300000, then_at_most: 200)`.
    pub samples: Samples,
    /// Samples of whole measurement files that are kept, all files together; a file that would exceed it is not kept
    /// and comes back as its tightenings' windows only. 0 keeps none. Default: 2000000 (about 30 MB with three channels).
    pub measurement_samples: u64,
    /// Time between the end of one tightening and the start of the next on the recording's time axis \[s\].
    /// Default: 0.2.
    pub gap_s: f64,
    /// Compression of the chunks. Default: `Zstd`.
    pub compression: Compression,
    /// Largest size of a chunk before compression \[bytes\], 4096 to 16777216: it bounds what a killed run loses within
    /// one tightening, and the memory in use. Default: 262144.
    pub chunk_bytes: u32,
}

impl Default for RecordSettings {
    fn default() -> Self {
        Self {
            samples: Samples::Bounded {
                complete_samples: 300_000,
                then_at_most: 200,
            },
            measurement_samples: 2_000_000,
            gap_s: 0.2,
            compression: Compression::Zstd,
            chunk_bytes: 262_144,
        }
    }
}

/// Which samples of a tightening are written. Samples are picked, never averaged: what is written was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Samples {
    /// Every sample of every tightening.
    All,
    /// Every n-th sample, beginning with the first; 1 is the same as `All`.
    Every(u32),
    /// All samples until `complete_samples` have been written (the tightening in which that happens is still whole),
    /// after that every n-th with the smallest n that leaves at most `then_at_most` per tightening.
    Bounded {
        /// Samples after which thinning starts, all tightenings together.
        complete_samples: u64,
        /// Most samples of each later tightening.
        then_at_most: u32,
    },
}

/// Compression of the chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Compression {
    /// Smallest files.
    Zstd,
    /// Fastest.
    Lz4,
    /// None.
    Off,
}

impl RecordSettings {
    /// Checks every field's range.
    ///
    /// # Errors
    /// [`RecordError::Setting`] names the first field that is out of range.
    pub fn check(&self) -> Result<(), RecordError> {
        let fail = |field, value, allowed| {
            Err(RecordError::Setting {
                field,
                value,
                allowed,
            })
        };
        if !(self.gap_s >= 0.0 && self.gap_s <= 3600.0) {
            return fail("gap_s", self.gap_s, "0 to 3600");
        }
        if !(4096..=16_777_216).contains(&self.chunk_bytes) {
            let value = f64::from(self.chunk_bytes);
            return fail("chunk_bytes", value, "4096 to 16777216");
        }
        match self.samples {
            Samples::Every(0) => fail("samples: Every", 0.0, "1 or more"),
            Samples::Bounded {
                then_at_most: 0, ..
            } => fail("samples: then_at_most", 0.0, "1 or more"),
            _ => Ok(()),
        }
    }

    /// n, when every n-th sample of a tightening of `length` samples is written after `written` in all.
    pub(crate) fn stride(&self, length: usize, written: u64) -> usize {
        match self.samples {
            Samples::Every(stride) => stride as usize,
            Samples::Bounded {
                complete_samples,
                then_at_most,
            } if written >= complete_samples => length.div_ceil(then_at_most as usize).max(1),
            Samples::All | Samples::Bounded { .. } => 1,
        }
    }
}
