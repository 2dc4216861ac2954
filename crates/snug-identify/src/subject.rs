//! What is identified.

use snug_campaign::Tightening;
use snug_model::{Input, Model};

/// One tightening with the model and the input to identify it with.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// Its free parameters are identified.
    pub model: &'a Model,
    /// The torque.
    pub input: &'a Input,
    /// The measurement.
    pub tightening: &'a Tightening,
}
