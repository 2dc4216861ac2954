//! In how many steps a motion is simulated from sample to sample.

pub(crate) mod friction;
pub(crate) mod resolved;

/// Steps of all recordings together up to which they are made shorter: a search takes as long as with as many samples. Chosen.
const MOST_STEPS: usize = 200_000;
