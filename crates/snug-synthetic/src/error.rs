//! Plans that cannot be simulated, and campaigns that cannot be written.

use std::path::PathBuf;

/// Why a campaign could not be simulated or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SyntheticError {
    /// A number of the plan is outside what can be simulated.
    #[error("{field} is {value}; allowed is {allowed}")]
    OutOfRange {
        /// Which setting.
        field: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// A name that no effect has.
    #[error("no effect is called `{name}`")]
    UnknownEffect {
        /// The name asked for.
        name: String,
    },
    /// A fault is planned for a tightening that the plan does not have.
    #[error(
        "a fault is planned for file {file}, tightening {tightening} (both from 0), which the plan does not have"
    )]
    FaultOutsidePlan {
        /// 0-based file.
        file: usize,
        /// 0-based tightening.
        tightening: usize,
    },
    /// Only a file's last tightening can be cut short: segments stand back to back.
    #[error(
        "file {file}, tightening {tightening} (both from 0) cannot be truncated: only a file's last can"
    )]
    TruncatedInside {
        /// 0-based file.
        file: usize,
        /// 0-based tightening.
        tightening: usize,
    },
    /// No hand–arm with a damping ratio within the population's limits came out of it.
    #[error("the population gave no hand–arm with the damping ratio it allows in {tries} draws")]
    NoSuchHandArm {
        /// Draws made.
        tries: usize,
    },
    /// A file could not be written.
    #[error("cannot write {path}: {source}")]
    Write {
        /// Where.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The truth could not be put as JSON.
    #[error("the truth could not be written as JSON")]
    Json(#[from] serde_json::Error),
}
