//! What is recorded, one file per kind of message: from results to messages and back.

pub(crate) mod diagnosis;
pub(crate) mod estimate;
pub(crate) mod finding;
pub(crate) mod measurement;
pub(crate) mod signals;
pub(crate) mod statistics;
pub(crate) mod window;
