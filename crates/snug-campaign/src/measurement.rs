//! What was measured, and on what: recordings, their rig and conditions, their noise, and what is wrong with them.

pub(crate) mod conditions;
pub(crate) mod finding;
pub(crate) mod motion;
pub(crate) mod noise;
pub(crate) mod quantity;
pub(crate) mod recording;
pub(crate) mod rig;
pub(crate) mod signal_units;
pub(crate) mod time_base;
