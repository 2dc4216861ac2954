//! Sizes that differ between groups of tightenings, and whether a group has any.

mod evidence;
pub(crate) mod nothing;
pub(crate) mod sizes;
