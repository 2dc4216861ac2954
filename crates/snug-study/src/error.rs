//! Every error that ends a study, which of them are the user's to mend, and where in the study file to mend them.

use crate::syntax::position;
use snug_campaign::did_you_mean;
use snug_campaign::words::program::program;
use snug_diagnose::DiagnoseError;
use snug_files::FilesError;
use snug_identify::IdentifyError;
use snug_ingest::IngestError;
use snug_least_squares::SolveError;
use snug_model::ModelError;
use snug_preprocess::PreprocessError;
use snug_record::RecordError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a study cannot be read or run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The study file cannot be read.
    #[error("{} cannot be read: {source}; a study is a text file (RON in UTF-8)", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// What was named as a study file is a folder, a pipe or a device, or longer than any study.
    #[error("{} is {}; a study is a text file (RON in UTF-8) of at most {most} bytes", path.display(), match bytes {
        Some(bytes) => format!("{bytes} bytes long"),
        None => "no regular file".to_owned(),
    })]
    NotAStudy {
        /// Which file.
        path: PathBuf,
        /// How long a regular file is.
        bytes: Option<u64>,
        /// How long it may be \[bytes\].
        most: u64,
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
    /// A setting that stands in the study file is not allowed.
    #[error("{}:{line}:{column}: {source}", path.display())]
    InFile {
        /// Which file.
        path: PathBuf,
        /// 1-based line of the field.
        line: usize,
        /// 1-based column of the field.
        column: usize,
        /// What is not allowed.
        source: Box<StudyError>,
    },
    /// A value of the study has no RON form.
    #[error("the study cannot be written as RON: {source}")]
    Serialize {
        /// Why.
        source: ron::Error,
    },
    /// The work was stopped before anything could be written.
    #[error("interrupted before there was a result; nothing was written")]
    Interrupted,
    /// The diagnosis could not be made.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    /// Not a single fit could begin.
    #[error(
        "no model could be fitted: with what it was begun with ({}) the {output} of the {tightenings} tightenings or recordings \
         could not be simulated to the end, or misses them beyond all numbers. Check in the study, in this order:\n  \
         source.channels: which column is input and which is {output}, their signs, units and scale; neither may stand still\n  \
         source.sampling: the rate or the column of time\n  \
         preprocess.rig: lever_arm_m and known_inertia of this rig\n  \
         model.parameters: without values, mass, damping and stiffness start where the spectra put them\n  \
         model.effects: fewer of them, or none\n\
         `{} init FILES` shows every column as a small picture",
        starts.join(", "),
        program()
    )]
    NothingFits {
        /// Tightenings that were to be fitted.
        tightenings: usize,
        /// The quantity to be fitted.
        output: &'static str,
        /// Each parameter and what it started at.
        starts: Vec<String>,
    },
    /// An effect is to be added that the model has already.
    #[error("the model has {effect} already")]
    AlreadyInModel {
        /// The effect.
        effect: String,
    },
    /// An effect is to be taken out that the model does not have.
    #[error(
        "the model does not have `{effect}`{}; it has: {}",
        did_you_mean(effect, present),
        listed(present)
    )]
    NotInModel {
        /// The effect.
        effect: String,
        /// What the model has.
        present: Vec<String>,
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
    /// A range is no longer than what is not scored of it.
    #[error(
        "{setting} is {unscored}, but the range `{range}` has {samples} samples only: nothing of it would be scored"
    )]
    NothingScored {
        /// Path of the field.
        setting: &'static str,
        /// Its value.
        unscored: usize,
        /// The range.
        range: String,
        /// Its length.
        samples: usize,
    },
    /// The source has no range of that name.
    #[error("validation.ranges: there is no range `{name}` in the source{}; it has: {}", did_you_mean(name, known), known.join(", "))]
    UnknownRange {
        /// The name.
        name: String,
        /// Every range of the source.
        known: Vec<String>,
    },
    /// A file that is to be kept for validation is not there.
    #[error("validation.files: `{name}` stands for none of the files{}; there are: {}", did_you_mean(name, known), known.join(", "))]
    NoSuchValidationFile {
        /// The name or pattern.
        name: String,
        /// Every file that is read.
        known: Vec<String>,
    },
    /// Nothing is left to fit.
    #[error("validation.files keeps all {files} files: none is left to be fitted")]
    NothingToFit {
        /// How many files there are.
        files: usize,
    },
    /// A result cannot be written, or must not be.
    #[error(transparent)]
    Files(#[from] FilesError),
    /// The recording cannot be written.
    #[error("cannot write {}: {source}{}", path.display(), remedy(source))]
    Recording {
        /// Where it was to stand.
        path: PathBuf,
        /// Why.
        source: RecordError,
    },
    /// No study can be drafted for what was named.
    #[error("no study can be drafted for {}: it holds {found}", path.display())]
    NothingToDraft {
        /// Folder or file.
        path: PathBuf,
        /// What is there.
        found: String,
    },
    /// A drafted study would be written over a file.
    #[error("{} is there already and stays as it is; --write writes over it, --study names another file", path.display())]
    StudyIsThere {
        /// The study file.
        path: PathBuf,
    },
    /// A drafted study would be written over what may be a measurement.
    #[error("{} cannot be the study: its name must end in .ron, and lead to none of the measurements", path.display())]
    NoStudyName {
        /// The file.
        path: PathBuf,
    },
    /// Files in the layout of the thesis, which is the default.
    #[error("{} holds files in the layout of the thesis, which need no study: {} run --data {}", path.display(), program(), path.display())]
    NeedsNoStudy {
        /// Folder or file.
        path: PathBuf,
    },
    /// A recording could not be made whole.
    #[error("cannot recover {}: {source}{}", path.display(), remedy(source))]
    NotRecovered {
        /// The recording; it is as it was.
        path: PathBuf,
        /// Why.
        source: RecordError,
    },
    /// A run that came to no end after it had recorded something; the results of the run before stand.
    #[error("{source}; nothing was replaced, and what was recorded until then is in {partial} (`{} recover {partial}` makes it whole)", program(), partial = partial.display())]
    Unfinished {
        /// Why it came to no end.
        source: Box<StudyError>,
        /// The recording.
        partial: PathBuf,
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
    /// A setting of the recording is not allowed.
    #[error("record: {0}")]
    Record(#[from] RecordError),
}

/// Names as an error lists them.
fn listed(names: &[String]) -> String {
    match names {
        [] => "nothing beyond mass, damper and spring".to_owned(),
        some => some.join(", "),
    }
}

/// What to do about the error of the operating system below an error, if there is one.
fn remedy(error: &(dyn std::error::Error + 'static)) -> &'static str {
    let mut chain = std::iter::successors(Some(error), |error| error.source());
    let of_the_system = chain.find_map(|error| error.downcast_ref::<std::io::Error>());
    of_the_system.map_or("", snug_files::remedy)
}

impl StudyError {
    /// Whether the cause is what the user asked for, rather than the data or the machine.
    pub fn is_bad_argument(&self) -> bool {
        if let Self::Files(error) = self {
            return error.is_bad_argument();
        }
        matches!(
            self,
            Self::Read { .. }
                | Self::NotAStudy { .. }
                | Self::Syntax { .. }
                | Self::InFile { .. }
                | Self::Setting { .. }
                | Self::NothingScored { .. }
                | Self::UnknownRange { .. }
                | Self::NoSuchValidationFile { .. }
                | Self::NothingToFit { .. }
                | Self::FixedAgainstConstraint { .. }
                | Self::Ingest(IngestError::Setting { .. } | IngestError::UnitOfSignal { .. })
                | Self::Identify(IdentifyError::Solve(SolveError::Setting { .. }))
                | Self::Record(RecordError::Setting { .. })
                | Self::Preprocess(_)
                | Self::Model(_)
                | Self::NothingToDraft { .. }
                | Self::NeedsNoStudy { .. }
                | Self::StudyIsThere { .. }
                | Self::NoStudyName { .. }
                | Self::AlreadyInModel { .. }
                | Self::NotInModel { .. }
        )
    }

    /// Whether the data are not there, or none of them can be read as the study says.
    pub fn is_about_data(&self) -> bool {
        matches!(
            self,
            Self::Ingest(_) | Self::Diagnose(_) | Self::NothingFits { .. }
        )
    }

    /// Whether whoever watches ended it.
    pub fn is_interruption(&self) -> bool {
        matches!(
            self,
            Self::Interrupted | Self::Files(FilesError::Interrupted)
        )
    }

    /// Path of the setting that is not allowed, as in the study file.
    fn field(&self) -> Option<String> {
        match self {
            Self::Setting { setting, .. } | Self::NothingScored { setting, .. } => {
                Some((*setting).to_owned())
            }
            Self::FixedAgainstConstraint { parameter, .. } => {
                Some(format!("model.parameters.{parameter}"))
            }
            Self::UnknownRange { .. } => Some("validation.ranges".to_owned()),
            Self::Ingest(IngestError::Setting { field, .. }) => Some(format!("source.{field}")),
            Self::Ingest(IngestError::UnitOfSignal { .. }) => Some("source.channels".to_owned()),
            Self::Preprocess(PreprocessError::SettingOutOfRange { setting, .. }) => {
                Some(format!("preprocess.{setting}"))
            }
            Self::Preprocess(PreprocessError::ThesisWithoutWindow) => {
                Some("preprocess.window".to_owned())
            }
            Self::Model(ModelError::Rig { field, .. }) => Some(format!("preprocess.rig.{field}")),
            Self::Model(
                ModelError::UnknownParameter { name, .. }
                | ModelError::ParameterRange { name, .. }
                | ModelError::StandardError { name, .. },
            ) => Some(format!("model.parameters.{name}")),
            Self::Model(
                ModelError::CustomName { .. }
                | ModelError::CustomParameter { .. }
                | ModelError::CustomRange { .. }
                | ModelError::Expression { .. }
                | ModelError::ExpressionValue { .. },
            ) => Some("model.custom".to_owned()),
            Self::Model(_) => Some("model.effects".to_owned()),
            Self::Identify(IdentifyError::Solve(SolveError::Setting { name, .. })) => {
                Some(format!("identify.solver.{name}"))
            }
            Self::Record(RecordError::Setting { field, .. }) => Some(format!("record.{field}")),
            _ => None,
        }
    }

    /// The error with the line and column at which `text`, the content of the file at `path`, states the setting; as it is
    /// where the file says nothing of it.
    pub(crate) fn in_file(self, path: &Path, text: &str) -> Self {
        let field = self.field();
        match field.and_then(|field| position::of_field(text, &field)) {
            Some(place) => Self::InFile {
                path: path.to_path_buf(),
                line: place.line,
                column: place.column,
                source: Box::new(self),
            },
            None => self,
        }
    }
}
