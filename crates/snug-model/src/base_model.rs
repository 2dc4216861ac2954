//! The linear model of mass, damping and stiffness, solved exactly.

pub(crate) mod euler;
pub(crate) mod exact;
pub(crate) mod forces;
pub(crate) mod normal_equations;
pub(crate) mod oscillation;
pub(crate) mod sweep;
