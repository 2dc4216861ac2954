//! One set of effects as a statement about all tightenings, fitted to them together.

pub(crate) mod between;
pub(crate) mod change_point;
pub(crate) mod decimated;
pub(crate) mod equation;
pub(crate) mod error_beyond;
pub(crate) mod fit;
pub(crate) mod fitted;
pub(crate) mod groups;
pub(crate) mod hold_out;
pub(crate) mod long_record;
pub(crate) mod model;
pub(crate) mod one_machine;
pub(crate) mod parameter_place;
mod part;
mod residual;
pub(crate) mod shared_block;
pub(crate) mod sharing;
pub(crate) mod sizes;
pub(crate) mod steps;
pub(crate) mod thresholds;
pub(crate) mod together;
pub(crate) mod torque_noise;
