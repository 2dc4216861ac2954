//! Why the workbench could not be opened, or could not do what was asked of it.

use snug_diagnose::DiagnoseError;
use snug_study::StudyError;
use std::path::PathBuf;
use thiserror::Error;

/// Why the workbench could not be opened, or could not do what was asked of it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WorkbenchError {
    /// Somebody else listens at the port.
    #[error(
        "port {port} is taken by another program, maybe another workbench; choose one by --port N, or any free one by --port 0"
    )]
    PortTaken {
        /// Which.
        port: u16,
    },
    /// The port cannot be listened at for another reason.
    #[error("port {port} of this machine cannot be opened: {source}")]
    Port {
        /// Which.
        port: u16,
        /// Why.
        source: std::io::Error,
    },
    /// The server's threads cannot be started.
    #[error("the server cannot be started: {source}")]
    Runtime {
        /// Why.
        source: std::io::Error,
    },
    /// The server ended by itself.
    #[error("the server ended: {source}")]
    Server {
        /// Why.
        source: std::io::Error,
    },
    /// The tightenings have not been read yet.
    #[error("the tightenings are still being read; try again in a moment")]
    StillReading,
    /// The tightenings could not be read.
    #[error("{message}")]
    Unreadable {
        /// Why, in a sentence.
        message: String,
    },
    /// Nobody has fitted this set of effects, or too much was fitted since.
    #[error("this model is not fitted yet; switch its effects on once more")]
    NotFitted,
    /// A condition that no tightening has.
    #[error("there is no group {key:?}; there are {}", keys.join(", "))]
    NoGroup {
        /// Which was asked for.
        key: String,
        /// Which there are.
        keys: Vec<String>,
    },
    /// A stretch of time that is none.
    #[error(
        "from_s = {from_s:?} and to_s = {to_s:?} are no stretch of time: both are needed, in seconds, the first below the second"
    )]
    NoStretch {
        /// Where it was to begin \[s\].
        from_s: Option<f64>,
        /// Where it was to end \[s\].
        to_s: Option<f64>,
    },
    /// More stretches at a time than there is memory for.
    #[error(
        "{most} stretches of time are shown in other pages already, each with tightenings of its own in memory; close one of these pages first"
    )]
    ManyStretches {
        /// As many as there may be.
        most: usize,
    },
    /// A cell of the map of the missing force that is none.
    #[error(
        "cell = {given:?} is no cell of the map: four finite numbers are needed, lower and upper edge of the grip's displacement in m and of its velocity in m/s, with commas between them"
    )]
    NoCell {
        /// What was given instead.
        given: String,
    },
    /// A closer look at a stretch of time and at a cell.
    #[error(
        "from_s, to_s and cell are given: a closer look is at a stretch of time or at a cell of the map, not at both"
    )]
    StretchAndCell,
    /// Numbers set by hand that are not those of the model.
    #[error(
        "values = {given:?} are not the {count} numbers of this model, each finite, with commas between them"
    )]
    NoNumbers {
        /// What was given.
        given: String,
        /// How many there are.
        count: usize,
    },
    /// Results that were not made, or are kept no longer.
    #[error("there is no such file here; ask for the report once more")]
    NoResults,
    /// A folder for results.
    #[error("results cannot be kept: {source}")]
    Results {
        /// Why.
        source: std::io::Error,
    },
    /// A number for which there is no tightening.
    #[error("there is no tightening {number}; there are 1 to {count}")]
    NoTightening {
        /// Which was asked for, counted from 1.
        number: usize,
        /// How many there are.
        count: usize,
    },
    /// The study or its data.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A fit.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    /// A study cannot be saved.
    #[error("{} cannot be written: {source}", path.display())]
    Save {
        /// Where.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}
