//! What noise is like: location and scale that outliers do not move, and its colour.

pub(crate) mod autoregression;
pub(crate) mod spread;
