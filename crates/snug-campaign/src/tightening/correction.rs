//! What preparation measured in the quiet part and took out before the fit.

use crate::measurement::quantity::Quantity;
use serde::{Deserialize, Serialize};

/// A sensor error that was measured in the quiet part and taken out before the fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Correction {
    /// The effect of the catalogue it corresponds to, for example `acceleration_bias`.
    pub effect: String,
    /// The measured quantity whose constant error it is; `None` where it is that of another signal, as the torque.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constant_of: Option<Quantity>,
    /// Size that was subtracted, in its unit.
    pub value: f64,
    /// Its standard error under the measured (coloured) noise, in its unit.
    pub standard_error: f64,
    /// Unit of the size.
    pub unit: String,
    /// Whether it differs from zero beyond chance.
    pub significant: bool,
}
