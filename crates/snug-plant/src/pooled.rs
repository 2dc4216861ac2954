//! The pooled fit over every row of a dataset: rows speak of the sizes that they share, the engine adds up what they say, the client
//! steps.

mod fit;
mod pass;
mod solve;
#[cfg(test)]
mod tests;
mod thresholds;

pub(crate) use fit::{GroupErrors, PooledOverAll, pooled_over_all};
pub(crate) use pass::Pass;
