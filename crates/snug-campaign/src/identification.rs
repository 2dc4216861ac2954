//! What is identified: a model's parameters, their estimates, and how sure these are.

pub(crate) mod estimate;
pub(crate) mod interval;
pub(crate) mod parameter;
