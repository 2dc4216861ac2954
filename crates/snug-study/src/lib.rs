#![doc = include_str!("../README.md")]

mod campaign_result;
mod cases;
mod comparable;
mod diagnosis;
mod error;
mod evaluation;
mod examples;
mod file_evaluation;
mod held_input;
mod init;
mod output;
mod position;
mod prepared;
mod prepared_file;
mod progress;
mod recover;
mod rewriting;
mod run;
mod run_settings;
mod rungs;
mod selection;
mod settings;
mod settling;
mod statistics;
mod study;
mod syntax;
mod tightenings;
mod validation;

pub use cases::FilesRead;
#[doc(hidden)]
pub use cases::cases;
pub use diagnosis::{Verb, diagnose};
pub use error::StudyError;
pub use init::{Draft, DraftColumn, draft, write_draft};
pub use prepared::{Prepared, prepare};
pub use progress::ProgressEvent;
pub use recover::{Recovered, recover};
pub use rewriting::{rewrite_effects, write_with_effects};
pub use run::{Outcome, run};
pub use run_settings::RunSettings;
pub use selection::SelectionSettings;
pub use settings::diagnosis::DiagnosisSettings;
pub use settings::validation::ValidationSettings;
pub use snug_preprocess::Preset;
pub use study::Study;
pub use tightenings::diagnosed::{
    Compared, PreparedDiagnosis, compared_by, diagnose_prepared, shared_blocks, shared_parameters,
};
pub use tightenings::{
    FileTightenings, FittedTightening, fit_tightenings, fitted_files, read_tightenings, settled,
};
