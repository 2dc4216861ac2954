//! The pooled fit over every row of a dataset: rows speak of the sizes that they share, the engine adds up what they say, the client
//! steps.

mod fit;
mod function;
mod pass;
mod question;
mod solve;
mod sum;
#[cfg(test)]
mod tests;
mod thresholds;

pub(crate) use fit::{GroupErrors, PooledOverAll, pooled_over_all};
pub(crate) use function::{block_function, group_function};
pub(crate) use pass::Pass;
pub(crate) use question::{Held, Sharing, State, States, Totals};
pub(crate) use sum::sum_function;
