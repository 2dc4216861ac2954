//! Why a verb could not be done.

use snug_study::StudyError;
use snug_synthetic::SyntheticError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a verb could not be done.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CliError {
    /// The study, its data, or the work on them.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// Nobody named data, and there is no folder to write the campaign to that the program holds.
    #[error(
        "nobody named data, and the campaign that Snug holds can be written nowhere: {variable} is not set; name data by --data DIR"
    )]
    NoFolder {
        /// The environment variable that names the folder.
        variable: &'static str,
    },
    /// The campaign that the program holds cannot be made.
    #[error("the campaign that Snug holds cannot be made: {0}; name data by --data DIR")]
    Campaign(#[from] SyntheticError),
    /// The campaign that the program holds cannot be written.
    #[error(
        "the campaign that Snug holds cannot be written to {}: {source}; name data by --data DIR",
        folder.display()
    )]
    Write {
        /// The folder.
        folder: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

impl CliError {
    /// Whether what was asked for is wrong, and not what came of it.
    pub fn is_bad_argument(&self) -> bool {
        match self {
            Self::Study(error) => error.is_bad_argument(),
            Self::NoFolder { .. } | Self::Campaign(_) | Self::Write { .. } => false,
        }
    }
}
