//! The ways a segment becomes a tightening, one file each.

pub(crate) mod snug;
pub(crate) mod thesis;
pub(crate) mod whole;
