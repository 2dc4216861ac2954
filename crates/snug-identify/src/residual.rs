//! A tightening's residual: restarts, simulation, whitening, smoothing, agreement.

pub mod agreement;
pub(crate) mod local_cubic;
pub(crate) mod restarts;
pub(crate) mod scoring;
pub(crate) mod smoothing;
pub(crate) mod taken_up;
pub(crate) mod thresholds;
pub(crate) mod tightening;
pub(crate) mod whitening;
