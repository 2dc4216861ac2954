//! What makes columns of numbers a recording: channels that make a rig, even times, ranges, conditions.

pub(crate) mod channels;
pub(crate) mod condition_pattern;
pub(crate) mod range;
pub(crate) mod sampling;
