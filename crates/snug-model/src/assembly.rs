//! A rig with chosen effects, laid out: parameters, states, ranges, and what is given to it from outside.

pub(crate) mod inputs;
pub(crate) mod layout;
pub(crate) mod model;
mod on_machine;
pub(crate) mod scale;
pub(crate) mod settings;
pub(crate) mod unidentifiable;
