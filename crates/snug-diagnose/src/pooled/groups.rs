//! Sizes that differ between groups of tightenings, and whether a group has any.

mod evidence;
mod nothing;
pub(crate) mod sizes;
