//! Measured and simulated signals of one tightening, to be drawn and recorded.

use crate::measurement::motion::Motion;
use crate::measurement::time_base::TimeBase;
use serde::{Deserialize, Serialize};

/// Measured and simulated signals of one tightening, a value for each sample of `time_base`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Traces {
    /// Sampling grid in the segment's time.
    pub time_base: TimeBase,
    /// Torque \[Nm\].
    pub torque_nm: Vec<f64>,
    /// Measured motion.
    pub measured: Motion,
    /// Simulated motion.
    pub simulated: Motion,
    /// Motion simulated with the model that a diagnosis began with; empty where the model is that one still.
    #[serde(default)]
    pub before: Motion,
    /// Displacement by the explicit Euler method \[rad\].
    pub euler_displacement_rad: Vec<f64>,
    /// F1 = l (c ω + k θ) with simulated ω, θ \[N\].
    pub force_f1_n: Vec<f64>,
    /// F2 = (T − I_n α_measured) / l \[N\]; empty without an acceleration channel.
    pub force_f2_n: Vec<f64>,
    /// F3 = (T − I_n α_simulated) / l \[N\].
    pub force_f3_n: Vec<f64>,
    /// Measured grip force \[N\].
    pub grip_force_n: Option<Vec<f64>>,
}
