//! What all tightenings say together.

pub(crate) mod condition_summary;
pub(crate) mod hypothesis_test;
pub(crate) mod parameter_meaning;
pub(crate) mod preset_summary;
pub(crate) mod result;
