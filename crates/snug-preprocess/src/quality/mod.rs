//! Faults of the data, one file each. Every check says what it found; presets decide what follows.

pub(crate) mod catching_up;
pub(crate) mod free_flight;
pub(crate) mod non_finite;
pub(crate) mod polarity;
pub(crate) mod saturation;
pub(crate) mod spikes;
pub(crate) mod stuck;
pub(crate) mod wrapped;
pub(crate) mod zero_jump;
