//! A frequency and a damping ratio with which something swings beside what is driven.

use crate::description::{ParameterSpec, Scope};

/// f.
pub(crate) const FREQUENCY: ParameterSpec = ParameterSpec {
    name: "f_hz",
    meaning: "frequency of the mode",
    unit: "Hz",
    starts: &[12.0, 5.0, 30.0, 70.0],
    minimum: 0.5,
    maximum: 500.0,
    limits: (0.1, 2000.0),
    vanishes_at: None,
    scope: Scope::Shared,
};

/// ζ.
pub(crate) const DAMPING_RATIO: ParameterSpec = ParameterSpec {
    name: "zeta",
    meaning: "damping ratio of the mode",
    unit: "1",
    starts: &[0.03, 0.2],
    minimum: 1e-4,
    // What hardly rings is no mode but a lag, and would stand in for friction.
    maximum: 0.5,
    limits: (1e-5, 0.5),
    vanishes_at: None,
    scope: Scope::Shared,
};
