//! Describing one sample: location and spread.

mod mean_interval;
mod moments;
mod quantile;

pub use mean_interval::{OneSampleT, one_sample_t};
pub(crate) use moments::Moments;
pub use moments::{mean, standard_deviation};
pub use quantile::{MAD_OF_NORMAL, median, quantile};
