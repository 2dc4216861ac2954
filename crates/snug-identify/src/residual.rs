//! A tightening's residual: restarts, simulation, whitening, agreement.

pub mod agreement;
pub(crate) mod restarts;
pub(crate) mod thresholds;
pub(crate) mod tightening;
pub(crate) mod whitening;
