//! Measurement noise: where it was measured, and its spectrum as an autoregressive process that whitens residuals.

use crate::measurement::quantity::Quantity;
use serde::{Deserialize, Serialize};

/// Where a noise floor comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseSource {
    /// Measured in the quiet part before the pulse.
    PreRoll,
    /// From the scatter of repeated tightenings.
    Repeats,
    /// Declared in the study.
    Declared,
    /// Taken from the fit's own residual: then lack of fit cannot be told from noise.
    Residual,
}

/// Stationary measurement noise as an autoregressive process.
///
/// n_t + a_1 n_{t−1} + … + a_p n_{t−p} = e_t with e_t white of standard deviation `innovation_sd`; so running a residual
/// through 1, a_1 … a_p and dividing by `innovation_sd` makes it white with unit variance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NoiseFloor {
    /// Where it was measured.
    pub source: NoiseSource,
    /// Which measured quantity it is the noise of (its unit is that quantity's unit).
    pub quantity: Quantity,
    /// Standard deviation of the noise itself.
    pub standard_deviation: f64,
    /// a_1 … a_p; empty for white noise.
    pub autoregression: Vec<f64>,
    /// Standard deviation of the white innovations e_t; equals `standard_deviation` for white noise.
    pub innovation_sd: f64,
    /// Number of samples it was estimated from.
    pub samples: usize,
}

impl NoiseFloor {
    /// Declared white noise of this standard deviation, in the quantity's unit.
    pub fn white(quantity: Quantity, standard_deviation: f64) -> Self {
        Self {
            source: NoiseSource::Declared,
            quantity,
            standard_deviation,
            autoregression: Vec::new(),
            innovation_sd: standard_deviation,
            samples: 0,
        }
    }
}
