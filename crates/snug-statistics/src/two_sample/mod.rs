//! Comparing two independent samples.

mod effect_size;
mod mann_whitney;
mod student;
mod welch;

pub use effect_size::{StandardizedDifference, standardized_difference};
pub use mann_whitney::{MannWhitney, mann_whitney};
pub use student::{TwoSampleT, student_t};
pub use welch::welch_t;
