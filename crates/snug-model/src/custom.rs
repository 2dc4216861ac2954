//! Laws that a study writes itself.

pub(crate) mod expression;
pub(crate) mod law;
pub(crate) mod settings;
