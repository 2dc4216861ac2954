#![doc = include_str!("../README.md")]

mod base_model;
mod batch;
mod constraint_kind;
pub mod derived;
mod error;
mod identify;
mod multistart;
mod noise;
mod residual;

pub use constraint_kind::{ConstraintKind, convex_set};
pub use error::IdentifyError;
pub use identify::{IdentifySettings, SIDE_BY_SIDE, Subject, identify, identify_all};
pub use multistart::multiple_shooting::motions_at;
pub use multistart::smoothing::{REACHES, average};
pub use residual::agreement;
pub use residual::restarts::{Simulation, motions, widest_reach};
pub use residual::tightening::TighteningResidual;
pub use residual::whitening::Whitening;
