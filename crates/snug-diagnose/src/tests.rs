//! What the tests of every room use.

pub(crate) mod made_up;
