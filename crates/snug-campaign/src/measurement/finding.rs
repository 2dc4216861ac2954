//! What was left out, repaired or is worth knowing of the data: bad data is a finding, not an error.

use serde::{Deserialize, Serialize};

/// How much a finding changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// Worth knowing; nothing was changed.
    Note,
    /// Data were repaired or corrected, and used.
    Repaired,
    /// Data were left out.
    LeftOut,
}

/// Something about the data that a reader must know: what was left out or repaired, and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// How much it changed.
    pub severity: Severity,
    /// Stable name of the kind, in snake case, for programs: `missing_channel`, `saturation`, …
    pub code: String,
    /// File name.
    pub file: String,
    /// 1-based number of the tightening within the file; `None` when the whole file is meant.
    pub tightening: Option<u32>,
    /// Channel concerned, as the file names it.
    pub channel: Option<String>,
    /// Plain sentence with the numbers: what was found, what is allowed, what was done.
    pub message: String,
}
