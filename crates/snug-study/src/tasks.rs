//! The tightenings of a study as fit tasks, and what it leaves to the tool until they are read.

pub(crate) mod cases;
pub(crate) mod comparable;
pub(crate) mod copies;
pub(crate) mod free_run;
pub(crate) mod held_input;
mod initial_state;
pub(crate) mod own_effects;
pub(crate) mod settling;
