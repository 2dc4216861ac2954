//! Small dense matrices, and inner products of long columns.

mod symmetric;
pub(crate) mod thresholds;
mod triangular;

pub use symmetric::SymmetricMatrix;
pub use triangular::*;
