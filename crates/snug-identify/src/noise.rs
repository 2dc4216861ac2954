//! What the noise in a residual makes of the covariance.

pub(crate) mod fixed;
pub(crate) mod integrated;
pub(crate) mod score_covariance;
pub(crate) mod thresholds;
