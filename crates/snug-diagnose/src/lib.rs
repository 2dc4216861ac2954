//! Where a model fails, which physical effect is missing, and how sure that is.

mod locate;

pub use locate::{Seen, compare, drifts, locate};
