//! Which effects to add, one after the other, and which of them are still needed.

pub(crate) mod backward_elimination;
mod differing;
mod escape;
pub(crate) mod forward_selection;
pub(crate) mod full_rate;
mod in_place;
mod may_be_nothing;
pub(crate) mod model_selection;
mod one_law;
pub(crate) mod path;
mod put_in;
mod short_enough;
pub(crate) mod simpler;
pub(crate) mod thresholds;
pub(crate) mod two_at_once;
