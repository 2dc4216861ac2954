//! One measurement file: its name, what is found out about it and what it gave.

pub(crate) mod finding_log;
pub(crate) mod ingested;
pub(crate) mod name;
