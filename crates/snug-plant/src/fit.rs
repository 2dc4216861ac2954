//! Every row of a dataset fitted inside the engine, on this machine or on a cluster, partition by partition.

pub(crate) mod columns;
pub(crate) mod function;
mod job;
mod outcome;

pub use job::{FitSettings, Fitted, fit};
pub(crate) use job::{fit_with, jobs, reason};
