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
    /// The catalogue has no effect of that name.
    #[error("there is no effect `{name}`; the catalogue has: {}", known.join(", "))]
    UnknownEffect {
        /// The name.
        name: String,
        /// Every name of the catalogue.
        known: Vec<&'static str>,
    },
    /// The model has no parameter of that name.
    #[error("the model has no parameter `{name}`; it has: {}", known.join(", "))]
    UnknownParameter {
        /// The name.
        name: String,
        /// Every parameter of the model.
        known: Vec<String>,
    },
    /// A parameter's value is not finite, or outside its limits, or the limits are the wrong way round.
    #[error("parameter `{name}`: value {value} must be finite and within {minimum} to {maximum}")]
    ParameterRange {
        /// The parameter.
        name: String,
        /// Its value.
        value: f64,
        /// Its smallest allowed value.
        minimum: f64,
        /// Its largest allowed value.
        maximum: f64,
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
