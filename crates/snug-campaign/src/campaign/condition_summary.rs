//! Means and spreads per condition.

use crate::identification::interval::Interval;
use serde::{Deserialize, Serialize};

/// Count, mean and spread of one quantity in one group, in the quantity's unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moments {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation (n − 1); `None` for fewer than two values.
    pub standard_deviation: Option<f64>,
    /// 95 % interval of the mean (Student t over tightenings); `None` for fewer than two values.
    pub mean_interval: Option<Interval>,
    /// Median.
    pub median: f64,
}

/// One quantity in one group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuantitySummary {
    /// Column name with unit suffix, for example `mass_kg`.
    pub quantity: String,
    /// Over the selected tightenings; `None` when there are none.
    pub selected: Option<Moments>,
    /// Over the rejected tightenings that have an estimate.
    pub rejected: Option<Moments>,
}

/// One level of one factor, for example strategy = QS.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ConditionSummary {
    /// `all`, `strategy`, `joint`, `pace_per_min`, `participant`, `target_torque_nm`.
    pub factor: String,
    /// The level as text; `all` for everything.
    pub level: String,
    /// Tightenings.
    pub tightenings: usize,
    /// Of them selected.
    pub selected: usize,
    /// Wilson 95 % interval of the selected share.
    pub selected_share_interval: Option<Interval>,
    /// Mass, damping, stiffness, natural frequency and effect parameters.
    pub quantities: Vec<QuantitySummary>,
}
