//! From a tightening to mass, damping, stiffness and sizes of effects, with their intervals.
#![doc = include_str!("../README.md")]

mod base_model;
mod batch;
mod constraint_kind;
pub mod derived;
mod equation_error;
mod error;
mod identify;
mod multistart;
mod noise;
mod residual;
mod settings;
mod task;

pub use batch::{SIDE_BY_SIDE, in_batches};
pub use constraint_kind::{ConstraintKind, convex_set};
pub use equation_error::equation::over_time::Change;
pub use equation_error::equation::{Acting, EquationFit, MotionEquation, Term};
pub use equation_error::modulation::{Modulation, integral};
pub use error::IdentifyError;
pub use identify::{identify, identify_all};
pub use multistart::spectral_start::{SpectralStart, spectral_start};
pub use residual::agreement;
pub use residual::restarts::{Simulation, motions, motions_at, widest_half_width};
pub use residual::scoring::Scoring;
pub use residual::smoothing::{HALF_WIDTHS, smooth};
pub use residual::thresholds::FEWEST_APART;
pub use residual::tightening::TighteningResidual;
pub use residual::whitening::Whitening;
pub use settings::IdentifySettings;
pub use task::decimated::means;
pub use task::{FitTask, begin_elsewhere, begin_in_motion};
