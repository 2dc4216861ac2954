//! The ranking on data that hide nothing.

use serde::{Deserialize, Serialize};

/// The ranking on data that hide nothing: simulated from the accepted model with noise like the measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NegativeControl {
    /// Campaigns simulated.
    pub campaigns: usize,
    /// Of them those in which the ranking called an effect supported.
    pub false_alarms: usize,
    /// The share of campaigns with a false alarm that was meant.
    pub nominal_rate: f64,
    /// Wilson 95 % interval of the share reached, low end.
    pub rate_low: f64,
    /// Wilson 95 % interval of the share reached, high end.
    pub rate_high: f64,
}
