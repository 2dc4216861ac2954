//! How tightenings come into a dataset: from measurement files whose names say whose they are, or simulated.

pub(crate) mod import;
pub(crate) mod naming;
pub(crate) mod simulate;
