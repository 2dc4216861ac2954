//! Small dense matrices, and inner products of long columns.

mod symmetric;
mod triangular;

pub use symmetric::SymmetricMatrix;
pub use triangular::*;
