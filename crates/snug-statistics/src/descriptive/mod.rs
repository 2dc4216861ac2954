//! Describing one sample: location, spread, shape, histogram.

mod histogram;
mod mean_interval;
mod moments;
mod quantile;
mod summary;

pub use histogram::{Histogram, histogram, histogram_with_edges};
pub use mean_interval::{OneSampleT, one_sample_t};
pub(crate) use moments::Moments;
pub use moments::{mean, skewness, standard_deviation};
pub use quantile::{median, quantile};
pub use summary::{Summary, summarize};
