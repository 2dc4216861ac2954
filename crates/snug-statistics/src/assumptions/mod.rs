//! Do the samples fit what a test presumes: normality, equal variances?

mod levene;
mod shapiro_wilk;

pub use levene::{Center, levene};
pub use shapiro_wilk::shapiro_wilk;
