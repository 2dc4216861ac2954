//! Shares and counts.

mod chi_squared;
mod fisher_exact;
mod wilson;

pub use chi_squared::{ChiSquared, chi_squared};
pub use fisher_exact::{FisherExact, fisher_exact};
pub use wilson::{Proportion, wilson};
