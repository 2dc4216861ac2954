//! Torque pulses: where they lie and begin, and where the window is put for them.

pub(crate) mod division;
pub(crate) mod locate;
pub(crate) mod onset;
