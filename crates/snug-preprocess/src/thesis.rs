//! What only the original program looks at or rounds.

pub(crate) mod checks;
pub(crate) mod offset;
