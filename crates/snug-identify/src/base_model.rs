//! The base model, fitted in sweeps over many tightenings at a time.

pub(crate) mod fit;
pub(crate) mod noise;
pub(crate) mod thresholds;
