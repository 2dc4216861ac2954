//! What can be wrong with a plant's dataset, its place, or the engine's work on it.

use snug_study::StudyError;
use std::fmt::Write;
use std::path::PathBuf;
use thiserror::Error;

/// Partitions that a message names; the others are counted.
const NAMED: usize = 12;

/// Why a command of the plant cannot do what it was asked for.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlantError {
    /// The study, or the data that it names.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A value on the command line or in a file's name that is not allowed.
    #[error("{name} is {value:?}; allowed: {allowed}")]
    Setting {
        /// What was set.
        name: &'static str,
        /// To what.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// A URL that leads to no store.
    #[error("{url:?} is no place for a dataset: {reason}")]
    Place {
        /// As it was given.
        url: String,
        /// Why not.
        reason: String,
    },
    /// The store does not answer, or refuses.
    #[error("{object}: {source}")]
    Store {
        /// The object or folder concerned.
        object: String,
        /// What the store says.
        source: object_store::Error,
    },
    /// A measurement file that cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// There is nothing at a URL that these commands have written.
    #[error("{url} holds no {what}; `plant {by}` makes them")]
    Nothing {
        /// Where it was looked for.
        url: String,
        /// What was looked for.
        what: &'static str,
        /// The command that makes it.
        by: &'static str,
    },
    /// A dataset of another version of the schema.
    #[error("{object} has schema version {found}; this program reads and writes version {known}")]
    Version {
        /// The file that says so.
        object: String,
        /// Its version.
        found: u32,
        /// This program's version.
        known: u32,
    },
    /// A marker or manifest that is none.
    #[error("{object} is not what this program writes: {reason}")]
    Marker {
        /// The object.
        object: String,
        /// What is wrong with it.
        reason: String,
    },
    /// What stands at a URL was made otherwise than what is to be added to it.
    #[error("{url} was made with another {what}; give another place, or the same {what}")]
    Other {
        /// Where.
        url: String,
        /// `preparation` or `model`.
        what: &'static str,
    },
    /// Columns that cannot be put together or taken apart.
    #[error("{object}: {source}")]
    Columns {
        /// Where.
        object: String,
        /// What arrow says.
        source: arrow::error::ArrowError,
    },
    /// A Parquet file that cannot be read or written.
    #[error("{object}: {source}")]
    Parquet {
        /// The object.
        object: String,
        /// What the reader says.
        source: parquet::errors::ParquetError,
    },
    /// A query that the engine refuses or could not carry out.
    #[error("{0}")]
    Engine(#[from] datafusion::error::DataFusionError),
    /// A job that a cluster's scheduler gave up.
    #[error(
        "{scheduler} gave the job up: no part of it was finished, and none ran at a worker that is alive"
    )]
    StandsStill {
        /// URL of the scheduler.
        scheduler: String,
    },
    /// The engine's own processes.
    #[error("{what} at {address}: {reason}")]
    Cluster {
        /// `scheduler` or `worker`.
        what: &'static str,
        /// Where.
        address: String,
        /// What the engine says.
        reason: String,
    },
    /// Some partitions could not be fitted; all others are there, whole.
    #[error("{}", told(failed, *partitions))]
    Partitions {
        /// Each with its reason.
        failed: Vec<(String, String)>,
        /// How many were to be done.
        partitions: usize,
    },
    /// Some partitions could not be asked, so that a sum over all rows is none.
    #[error("{}", not_asked(failed, *partitions))]
    Pass {
        /// Each with its reason.
        failed: Vec<(String, String)>,
        /// How many were to be asked.
        partitions: usize,
    },
    /// Rows that were lost or came twice.
    #[error("{partition}: {stored} rows are stored, {came} came back")]
    Rows {
        /// The partition.
        partition: String,
        /// Rows that its marker names.
        stored: usize,
        /// Rows that were counted.
        came: usize,
    },
    /// Simulated tightenings that cannot be made.
    #[error(transparent)]
    Synthetic(#[from] snug_synthetic::SyntheticError),
    /// A statistic that cannot be computed.
    #[error(transparent)]
    Statistics(#[from] snug_statistics::StatisticsError),
    /// A result that has no written form.
    #[error("a result cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

fn told(failed: &[(String, String)], partitions: usize) -> String {
    let count = failed.len();
    let text = format!(
        "{count} of {partitions} partitions failed and have no results; all others are whole, and `--resume` does only these:"
    );
    listed(text, failed)
}

fn not_asked(failed: &[(String, String)], partitions: usize) -> String {
    let count = failed.len();
    let text = format!(
        "{count} of {partitions} partitions could not be asked, so that the sizes all rows share are not known; nothing was written of them:"
    );
    listed(text, failed)
}

fn listed(mut text: String, failed: &[(String, String)]) -> String {
    for (partition, reason) in failed.iter().take(NAMED) {
        let _ = write!(text, "\n  {partition}: {reason}");
    }
    if failed.len() > NAMED {
        let _ = write!(text, "\n  and {} more", failed.len() - NAMED);
    }
    text
}

impl PlantError {
    pub(crate) fn setting(name: &'static str, value: &str, allowed: &str) -> Self {
        Self::Setting {
            name,
            value: snug_campaign::excerpt(value),
            allowed: allowed.to_owned(),
        }
    }

    pub(crate) fn columns(object: &str) -> impl Fn(arrow::error::ArrowError) -> Self {
        let object = object.to_owned();
        move |source| Self::Columns {
            object: object.clone(),
            source,
        }
    }

    pub(crate) fn parquet(object: &str) -> impl Fn(parquet::errors::ParquetError) -> Self {
        let object = object.to_owned();
        move |source| Self::Parquet {
            object: object.clone(),
            source,
        }
    }
}
