//! MCAP: Snug's own recordings, and declared numeric channels of anybody's.

#[cfg(feature = "mcap")]
mod reading;

use crate::error::IngestError;
use crate::file::ingested::Ingested;
use crate::layout;
use crate::layout::Layout;
use crate::memory::Budget;
use crate::recording::channels;
use crate::recording::condition_pattern::ConditionPattern;
use crate::recording::range;
use crate::recording::range::Range;
use crate::recording::sampling;
use crate::signal;
use crate::signal::Signal;
use crate::unit::Unit;
use serde::{Deserialize, Serialize};
use snug_files::Input;
use std::path::Path;

/// What an MCAP file's topics are. Without channels the file is one that Snug wrote, and gives its measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct McapLayout {
    /// The numeric channels that are read: one input (torque or force) and at least one motion, or none for Snug's own files. Default none.
    pub channels: Vec<McapChannel>,
    /// Samples per second \[Hz\] where the log times do not count; `None` (default): they do.
    pub rate_hz: Option<f64>,
    /// How far a sample may lie from the uniform grid, in intervals, before all are interpolated. Default 0.1.
    pub tolerance_ratio: f64,
    /// Stretches that become segments; without any the whole file is one. Default none.
    pub ranges: Vec<Range>,
    /// How the file's name tells the conditions; `None` (default): it does not.
    pub conditions: Option<ConditionPattern>,
}

impl Default for McapLayout {
    fn default() -> Self {
        Self {
            channels: Vec::new(),
            rate_hz: None,
            tolerance_ratio: sampling::default_tolerance_ratio(),
            ranges: Vec::new(),
            conditions: None,
        }
    }
}

/// One numeric field of one topic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct McapChannel {
    /// Topic, for example `/tool/torque`.
    pub topic: String,
    /// Path of the field within the message, for example `wrench.torque.z`.
    pub field: String,
    /// What it measures.
    pub signal: Signal,
    /// In which unit.
    pub unit: Unit,
    /// Factor before the unit, for gain or sign. Default 1.
    #[serde(default = "signal::as_it_is")]
    pub scale: f64,
}

impl Layout for McapLayout {
    fn endings(&self) -> &'static [&'static str] {
        &["mcap"]
    }

    fn check(&self) -> Result<(), IngestError> {
        if !self.channels.is_empty() {
            channels::check(&self.declared())?;
        }
        range::check(&self.ranges)?;
        if let Some(rate_hz) = self.rate_hz {
            layout::check_positive("rate_hz", rate_hz)?;
        }
        layout::check_positive("tolerance_ratio", self.tolerance_ratio)
    }

    fn ranges(&self) -> &[Range] {
        &self.ranges
    }

    fn declared(&self) -> Vec<(Signal, Unit, f64)> {
        let channels = self.channels.iter();
        channels.map(|c| (c.signal, c.unit, c.scale)).collect()
    }

    fn read(
        &self,
        input: &mut dyn Input,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
    ) -> Result<Ingested, IngestError> {
        let content = layout::content(input, budget, check_start)?;
        read(self, &content, path, lever_arm_m, budget)
    }
}

/// What every MCAP file starts with.
const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// Whether the start of a file is that of an MCAP file.
fn check_start(start: &[u8]) -> Result<(), IngestError> {
    if start.is_empty() {
        return Err(IngestError::EmptyFile);
    }
    if start.starts_with(MAGIC) {
        return Ok(());
    }
    Err(IngestError::NotMcap {
        first_bytes: start.iter().take(MAGIC.len()).copied().collect(),
    })
}

/// The recordings in an MCAP file's content.
#[cfg(feature = "mcap")]
use reading::read;

#[cfg(not(feature = "mcap"))]
fn read(_: &McapLayout, _: &[u8], _: &Path, _: f64, _: &Budget) -> Result<Ingested, IngestError> {
    Err(IngestError::FormatNotBuilt {
        format: "MCAP",
        feature: "mcap",
    })
}
