//! Why a diagnosis could not be made.

use snug_identify::IdentifyError;
use snug_least_squares::SolveError;
use snug_model::ModelError;
use thiserror::Error;

/// Why a diagnosis could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DiagnoseError {
    /// No tightening can be compared with a simulation.
    #[error("nothing can be compared with the model: {reason}")]
    NothingToCompare {
        /// Why not.
        reason: String,
    },
    /// So few samples count that a model's own parameters could follow them.
    #[error("{samples} samples lie there, more than {own} are needed to tell anything")]
    FewSamples {
        /// Samples that count.
        samples: usize,
        /// Parameters that a tightening has of its own.
        own: usize,
    },
    /// What is found is not resolved by a simulation in so few steps from sample to sample.
    #[error("what is found asks for {steps} steps from sample to sample")]
    Unresolved {
        /// How many resolve it.
        steps: usize,
    },
    /// Whoever watches ended it.
    #[error("interrupted before there was a result")]
    Interrupted,
    /// The model refuses the effects it is asked to carry.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A fit could not begin.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A pooled fit could not begin.
    #[error(transparent)]
    Solve(#[from] SolveError),
}
