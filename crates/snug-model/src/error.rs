use thiserror::Error;

/// Why a model cannot be assembled.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
    /// A constant of the rig is out of range.
    #[error("rig: {field} is {value}, allowed is {allowed}")]
    Rig {
        /// Field of [`snug_campaign::Rig`].
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// An effect was named twice.
    #[error("effect `{effect}` is named twice; each effect can be in the model once")]
    DuplicateEffect {
        /// Its name.
        effect: &'static str,
    },
    /// More effects than a simulation carries.
    #[error(
        "the effects need {states} states (at most {maximum_states}) and {parameters} parameters (at most {maximum_parameters})"
    )]
    TooLarge {
        /// States needed.
        states: usize,
        /// Parameters needed.
        parameters: usize,
        /// States allowed.
        maximum_states: usize,
        /// Parameters allowed.
        maximum_parameters: usize,
    },
}
