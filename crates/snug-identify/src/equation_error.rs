//! The equation of motion as a plain regression: measured acceleration on torque, velocity, angle and what effects add along the
//! measured motion. No simulation, no start, milliseconds.

pub(crate) mod equation;
pub(crate) mod modulation;
pub(crate) mod record;
pub(crate) mod regression;
pub(crate) mod thresholds;
