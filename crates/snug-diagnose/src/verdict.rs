//! What was found, as the answer to a question.

pub(crate) mod answer;
pub(crate) mod changes;
mod comparisons;
mod decision;
pub(crate) mod detectability;
pub(crate) mod earned;
pub(crate) mod experiment;
pub(crate) mod floor;
mod in_some_groups;
pub(crate) mod ladder;
pub(crate) mod preparation;
mod pushed_away;
mod ranking_told;
pub(crate) mod reasons;
pub(crate) mod thresholds;
pub(crate) mod tightening_fits;
pub(crate) mod trend;
pub(crate) mod units;
mod unsigned;
