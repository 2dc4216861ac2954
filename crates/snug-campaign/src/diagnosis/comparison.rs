//! Model against measurement: the words for it.

use crate::tightening::id::TighteningId;
use serde::{Deserialize, Serialize};

/// The misfit of one quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Misfit {
    /// `acceleration`, `velocity`, `displacement` or `force` (F2 − F3).
    pub quantity: String,
    /// Unit of the error.
    pub unit: String,
    /// Root mean square of measured − simulated.
    pub rms: f64,
    /// Largest absolute value of measured − simulated.
    pub largest: f64,
    /// 100 (1 − ‖y − ŷ‖ / ‖y − ȳ‖); `None` when the measurement does not vary.
    pub fit_percent: Option<f64>,
    /// rms over the root mean square of the measurement \[%\].
    pub relative_percent: Option<f64>,
    /// Root mean square of the whitened residual; only of the quantity whose noise is known.
    pub over_noise: Option<f64>,
}

/// Model against measurement of one tightening.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TighteningMisfit {
    /// Which one.
    pub id: TighteningId,
    /// One entry a quantity.
    pub misfits: Vec<Misfit>,
}

/// Model against measurement.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// All tightenings pooled, one entry a quantity.
    pub pooled: Vec<Misfit>,
    /// Each tightening, worst first by `over_noise` (or fit) of the compared quantity.
    pub tightenings: Vec<TighteningMisfit>,
}
