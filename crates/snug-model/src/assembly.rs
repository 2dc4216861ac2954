//! A rig with chosen effects, laid out: parameters, states, ranges.

pub(crate) mod dry_friction;
pub(crate) mod layout;
pub(crate) mod model;
pub(crate) mod scale;
pub(crate) mod settings;
pub(crate) mod unidentifiable;
