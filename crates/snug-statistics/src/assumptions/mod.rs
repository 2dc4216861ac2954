//! Do the samples fit what a test presumes: normality, equal variances?

mod brown_forsythe;
mod shapiro_wilk;

pub use brown_forsythe::brown_forsythe;
pub use shapiro_wilk::shapiro_wilk;
