//! Every row of a dataset fitted inside the engine, on this machine or on a cluster, partition by partition.

mod in_vain;
mod job;

pub(crate) use in_vain::InVain;
pub use job::{FitSettings, Fitted, fit};
pub(crate) use job::{fit_with, jobs, reason};
