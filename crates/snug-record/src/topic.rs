//! Names of the topics, and of the metadata records.

/// Where each tightening's samples come from.
pub const WINDOW: &str = "/tightening/window";
/// One message per sample: measured, simulated, residual, forces.
pub const SIGNALS: &str = "/tightening/signals";
/// One message per tightening: parameters, intervals, status, agreement.
pub const ESTIMATE: &str = "/estimate";
/// What was left out, repaired or is worth knowing.
pub const FINDING: &str = "/finding";
/// The findings as log lines.
pub const LOG: &str = "/log";
/// Means and spreads per condition.
pub const CONDITIONS: &str = "/statistics/conditions";
/// Tests per quantity and factor.
pub const TESTS: &str = "/statistics/tests";
/// What is missing in the model, and why.
pub const VERDICT: &str = "/verdict";
/// One message per model of the error ladder, the study's own first.
pub const LADDER: &str = "/ladder";
/// One message per candidate for what the model lacks, best first.
pub const RANKING: &str = "/ranking";
/// Whole measurement files: what they are.
pub const MEASUREMENT_FILE: &str = "/measurement/file";
/// Whole measurement files: their samples in blocks.
pub const MEASUREMENT_SAMPLES: &str = "/measurement/samples";
/// The metadata record that holds the study as run.
pub const STUDY: &str = "snug.study";
/// The metadata record of a recovered recording: what was saved and what is missing.
pub const RECOVERED: &str = "snug.recovered";

/// What a channel of Snug's holds of the measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measured {
    /// What a tightening's window is.
    Window,
    /// A window's samples.
    Signals,
    /// What a whole measurement file is.
    File,
    /// A file's samples.
    Samples,
}

impl Measured {
    /// By a channel's topic and the name of its schema; `None` for any other channel.
    pub(crate) fn of(topic: &str, schema: &str) -> Option<Self> {
        match (topic, schema) {
            (WINDOW, "snug.Window") => Some(Self::Window),
            (SIGNALS, "snug.Signals") => Some(Self::Signals),
            (MEASUREMENT_FILE, "snug.MeasurementFile") => Some(Self::File),
            (MEASUREMENT_SAMPLES, "snug.MeasurementSamples") => Some(Self::Samples),
            _ => None,
        }
    }
}
