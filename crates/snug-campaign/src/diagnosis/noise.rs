//! The noise that errors are compared with.

use serde::{Deserialize, Serialize};

/// The noise that errors are compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NoiseStatement {
    /// `pre_roll`, `repeats`, `declared` or `residual`.
    pub source: String,
    /// Its standard deviation in the acceleration \[rad/s²\]; `None` when the acceleration is not what is compared.
    pub acceleration_rad_per_s2: Option<f64>,
}
