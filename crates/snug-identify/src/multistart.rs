//! Multistart where a cost has more than one minimum: many starts side by side, of which those without a prospect are stopped.
//!
//! snug-least-squares' plain multistart, which follows every start to its end, is another thing; tests hold this one against it.

pub(crate) mod decimated;
pub(crate) mod early_stopping;
pub(crate) mod integral_start;
pub(crate) mod multiple_shooting;
pub(crate) mod search;
pub(crate) mod spectral_start;
pub(crate) mod thresholds;
