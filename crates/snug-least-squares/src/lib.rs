//! Constrained nonlinear least squares: residuals and cones in, estimate and covariance out; no domain.
#![doc = include_str!("../README.md")]

mod conic;
mod error;
pub mod matrix;
mod pooled_fit;
mod problem;
mod solver;
mod uncertainty;

pub use conic::constraints::{Affine, Constraints};
pub use error::{EvaluationError, SolveError};
pub use pooled_fit::member::profile_of;
pub use pooled_fit::problem::{
    PooledFit, PooledResidual, PooledSettings, PooledStep, Profile, Trial,
};
pub use pooled_fit::solve::{solve_pooled, solve_pooled_followed};
pub use problem::difference_residual::DifferenceResidual;
pub use problem::least_squares::LeastSquares;
pub use problem::linearization::Linearization;
pub use problem::residual::{DenseResidual, Residual, further_along};
pub use solver::fit::{ActiveConstraint, Fit, Status, Work};
pub use solver::levenberg_marquardt::{LevenbergMarquardt, Query};
pub use solver::plain_multistart::{best, solve_from_starts};
pub use solver::settings::Settings;
pub use solver::solve::{answer, solve};
pub use uncertainty::covariance::{Covariance, ResidualNoise};
pub use uncertainty::identifiability::Identifiability;
pub use uncertainty::leverage::without_high_leverage;
