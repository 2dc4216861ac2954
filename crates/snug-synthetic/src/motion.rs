//! Tool, hand and arm under a pulse of torque, and their true motion.

pub(crate) mod history;
pub(crate) mod plant;
pub(crate) mod pulse;
pub(crate) mod trajectory;
