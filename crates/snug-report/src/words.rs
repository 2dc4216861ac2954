//! How numbers, quantities, effects and outcomes are told on a page.

pub(crate) mod as_shown;
pub(crate) mod effect_words;
pub(crate) mod machine_words;
pub(crate) mod number;
pub(crate) mod outcome;
pub(crate) mod quantity;
pub(crate) mod signal_unit;
