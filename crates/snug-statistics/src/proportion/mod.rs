//! Shares of trials.

mod wilson;

pub use wilson::{Proportion, wilson};
