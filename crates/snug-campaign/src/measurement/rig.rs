//! A rig's known constants, and what its input does between samples.

use serde::{Deserialize, Serialize};

/// What the input (torque) does between two samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Intersample {
    /// It keeps the last sample's value.
    ZeroOrder,
    /// It runs straight from sample to sample (first-order hold).
    Linear,
    /// It holds no frequency above half the sampling rate.
    BandLimited,
}

/// The known constants of a one-degree-of-freedom rig.
///
/// The unknown part moves with it as (I_n + m l²) dω/dt = T − l F with x = l θ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rig {
    /// l, joint axis to grip \[m\].
    pub lever_arm_m: f64,
    /// I_n, known inertia about the joint \[kg m²\]; 0 where all inertia is to be identified.
    pub known_inertia_kg_m2: f64,
}
