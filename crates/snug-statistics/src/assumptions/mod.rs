//! Do the samples fit what a test presumes: normal residuals, equal variances?
//!
//! [`shapiro_wilk`] of the [`residuals`] of the [`replicated`] groups, and [`brown_forsythe`] of
//! the groups. Both take values for independent, find deviations too small to matter in large
//! samples and miss large ones in small samples.

mod brown_forsythe;
mod residuals;
mod shapiro_wilk;

pub use brown_forsythe::brown_forsythe;
pub use residuals::{replicated, residuals, tied};
pub use shapiro_wilk::shapiro_wilk;
