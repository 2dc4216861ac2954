//! Comparing two samples, paired or not.

mod brunner_munzel;
mod effect_size;
mod mann_whitney;
mod student;
mod welch;
mod wilcoxon;

pub use brunner_munzel::{BrunnerMunzel, brunner_munzel};
pub use effect_size::{StandardizedDifference, standardized_difference};
pub use mann_whitney::{MannWhitney, mann_whitney};
pub use student::{TwoSampleT, student_t};
pub use welch::welch_t;
pub use wilcoxon::{WilcoxonSignedRank, wilcoxon_signed_rank};
