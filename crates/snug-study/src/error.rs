use snug_identify::IdentifyError;
use snug_ingest::IngestError;
use snug_model::ModelError;
use snug_preprocess::PreprocessError;
use snug_record::RecordError;
use snug_report::ReportError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a study cannot be read or run.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The study file cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The study file does not follow the format.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Syntax {
        /// Which file.
        path: PathBuf,
        /// 1-based line.
        line: usize,
        /// 1-based column.
        column: usize,
        /// What was found and what is allowed there.
        message: String,
    },
    /// A value of the study has no RON form.
    #[error("the study cannot be written as RON: {source}")]
    Serialize {
        /// Why.
        source: ron::Error,
    },
    /// A setting of the study's own is not allowed.
    #[error("{setting} is {value}, allowed is {allowed}")]
    Setting {
        /// Path of the field.
        setting: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A parameter is fixed at a value that the constraints asked for forbid.
    #[error(
        "model.parameters.{parameter}: fixed at {value}, but the constraint Positive allows 0 or more only"
    )]
    FixedAgainstConstraint {
        /// The parameter.
        parameter: String,
        /// Its fixed value.
        value: f64,
    },
    /// The source has no range of that name.
    #[error("validation.ranges: there is no range `{name}` in the source; it has: {}", known.join(", "))]
    UnknownRange {
        /// The name.
        name: String,
        /// Every range of the source.
        known: Vec<String>,
    },
    /// A result cannot be written.
    #[error("{}: {source}", path.display())]
    Write {
        /// Which file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Threads cannot be started.
    #[error("{threads} threads cannot be started: {message}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// Why.
        message: String,
    },
    /// The data cannot be listed or read.
    #[error(transparent)]
    Ingest(#[from] IngestError),
    /// A setting of the preparation is not allowed, or a recording cannot be prepared.
    #[error("preprocess: {0}")]
    Preprocess(#[from] PreprocessError),
    /// The model cannot be assembled.
    #[error("model: {0}")]
    Model(#[from] ModelError),
    /// A setting of the identification is not allowed, or it could not begin.
    #[error("identify: {0}")]
    Identify(#[from] IdentifyError),
    /// The recording cannot be written.
    #[error("record: {0}")]
    Record(#[from] RecordError),
    /// The report cannot be written.
    #[error("report: {0}")]
    Report(#[from] ReportError),
}

impl StudyError {
    /// Whether the cause is what the user asked for, rather than the data or the machine.
    pub fn is_bad_argument(&self) -> bool {
        matches!(
            self,
            Self::Read { .. }
                | Self::Syntax { .. }
                | Self::Setting { .. }
                | Self::UnknownRange { .. }
                | Self::FixedAgainstConstraint { .. }
                | Self::Ingest(IngestError::Setting { .. })
                | Self::Identify(IdentifyError::Setting { .. })
                | Self::Record(RecordError::Setting { .. })
                | Self::Preprocess(_)
                | Self::Model(_)
        )
    }
}
