//! Tests, intervals and models on slices and groups; no domain.
#![doc = include_str!("../README.md")]

pub mod assumptions;
pub mod clustered;
pub mod descriptive;
pub mod distributions;
mod double_double;
mod error;
pub mod k_sample;
pub mod multiplicity;
pub mod proportion;
pub mod random_effects;
mod ranks;
mod root;
mod sample;
mod test_result;
pub mod two_sample;

pub use double_double::{DoubleDouble, ParseDoubleDoubleError};
pub use error::{Result, StatisticsError};
pub use sample::Sample;
pub use test_result::{Interval, TestResult};
