//! A Snug study run end to end: from recordings to identified parameters, statistics, report and MCAP.
#![doc = include_str!("../README.md")]

mod diagnosis;
mod error;
mod evaluation;
mod init;
mod progress;
mod recover;
mod run;
mod settings;
mod statistics;
mod study;
mod syntax;
mod tasks;
mod tightenings;

pub use diagnosis::{Verb, diagnose};
pub use error::StudyError;
pub use init::{Draft, DraftColumn, draft, write_draft};
pub use progress::ProgressEvent;
pub use recover::{Recovered, recover};
pub use run::settings::RunSettings;
pub use run::{Outcome, run};
pub use settings::diagnosis::DiagnosisSettings;
pub use settings::selection::SelectionSettings;
pub use settings::validation::ValidationSettings;
pub use snug_preprocess::{Preset, Stretch};
pub use study::Study;
pub use study::rewriting::{rewrite_effects, with_stretch, write_with_effects};
pub use tasks::cases::FilesRead;
#[doc(hidden)]
pub use tasks::cases::cases;
pub use tightenings::diagnosed::{
    Compared, PreparedDiagnosis, compared_by, diagnose_prepared, shared_blocks, shared_parameters,
};
pub use tightenings::prepared::{Prepared, prepare};
pub use tightenings::{
    FileTightenings, FittedTightening, fit_numbers, fit_tightenings, fitted_files,
    read_tightenings, settled,
};
