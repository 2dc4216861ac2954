//! A model's parameter as MATLAB's idnlgrey has it: name, unit, value, bounds, fixed or free, and who said so.

use serde::{Deserialize, Serialize};

/// Who said what a parameter's value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ParameterSource {
    /// The built-in default.
    Default,
    /// The study file.
    Study,
    /// An estimate.
    Identified,
}

/// One parameter of a model; numbers in its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name with unit suffix, for example `stiffness_n_per_m`.
    pub name: String,
    /// Unit as people write it, for example `N/m`.
    pub unit: String,
    /// Value: the start of an identification, or the fixed value.
    pub value: f64,
    /// Smallest allowed value (−∞ for none).
    pub minimum: f64,
    /// Largest allowed value (∞ for none).
    pub maximum: f64,
    /// A fixed parameter is not identified.
    pub fixed: bool,
    /// Standard error of a fixed value that was found elsewhere; `None` where it is known exactly or identified.
    #[serde(default)]
    pub standard_error: Option<f64>,
    /// Where the value comes from.
    pub source: ParameterSource,
}
