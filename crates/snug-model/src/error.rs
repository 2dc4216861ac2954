//! Why a model cannot be assembled or simulated, in words that name what is allowed.

use snug_campaign::{did_you_mean, excerpt};
use thiserror::Error;

/// Why a model cannot be assembled or simulated.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A simulation is asked for with a parameter that is no finite number.
    #[error("{name} is {value}: a simulation needs finite numbers")]
    ParameterValue {
        /// The parameter.
        name: String,
        /// Its value.
        value: f64,
    },
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
    /// Neither the catalogue nor the study has an effect of that name.
    #[error("there is no effect `{}`{}; there are: {}", excerpt(name), did_you_mean(name, known), known.join(", "))]
    UnknownEffect {
        /// The name.
        name: String,
        /// Every name of the study's custom effects and of the catalogue.
        known: Vec<&'static str>,
    },
    /// The model has no parameter of that name.
    #[error("the model has no parameter `{}`{}; it has: {}", excerpt(name), did_you_mean(name, known), known.join(", "))]
    UnknownParameter {
        /// The name.
        name: String,
        /// Every parameter of the model.
        known: Vec<String>,
    },
    /// A parameter's value is not finite, or outside its limits, or the limits are the wrong way round.
    #[error(
        "parameter `{name}`: its value is {value}, its minimum {minimum}, its maximum {maximum}; allowed is a minimum below the maximum and a finite value between them"
    )]
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
    /// A standard error was stated for a parameter that is not fixed, or is negative or not finite.
    #[error(
        "parameter `{name}`: its standard_error is {standard_error}; allowed is 0 or more, and only where the parameter is `fixed: true`"
    )]
    StandardError {
        /// The parameter.
        name: String,
        /// Its stated standard error.
        standard_error: f64,
    },
    /// A custom effect's name cannot be used.
    #[error("custom effect: the name `{}` {problem}", excerpt(name))]
    CustomName {
        /// The name.
        name: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A custom effect's parameter cannot be used.
    #[error(
        "custom effect `{}`: the parameter `{}` {problem}",
        excerpt(effect),
        excerpt(parameter)
    )]
    CustomParameter {
        /// The effect.
        effect: String,
        /// Its parameter.
        parameter: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A custom effect's parameter starts outside its range, or the range is the wrong way round.
    #[error(
        "custom effect `{}`: the parameter `{}` has start {start}, minimum {minimum}, maximum {maximum}; allowed is a minimum below the maximum and a finite start between them",
        excerpt(effect),
        excerpt(parameter)
    )]
    CustomRange {
        /// The effect.
        effect: String,
        /// Its parameter.
        parameter: String,
        /// Its starting value.
        start: f64,
        /// Its smallest value.
        minimum: f64,
        /// Its largest value.
        maximum: f64,
    },
    /// A custom effect's expression cannot be read.
    #[error(
        "custom effect `{}`: in the expression `{}`, at character {position}, found {}; allowed is {allowed}",
        excerpt(effect),
        excerpt(expression),
        excerpt(found)
    )]
    Expression {
        /// The effect.
        effect: String,
        /// Its expression.
        expression: String,
        /// Character at which it fails, counted from 1.
        position: usize,
        /// What stands there.
        found: String,
        /// What may stand there.
        allowed: String,
    },
    /// A custom effect's expression has no value where a tightening passes.
    #[error(
        "custom effect `{}`: the expression `{}` is {value} at x = {x_m} m, v = {v_m_per_s} m/s, T = {torque_nm} Nm, t = {since_onset_s} s with its parameters at their starting values; it must be a finite number",
        excerpt(effect),
        excerpt(expression)
    )]
    ExpressionValue {
        /// The effect.
        effect: String,
        /// Its expression.
        expression: String,
        /// What comes out.
        value: f64,
        /// Displacement \[m\].
        x_m: f64,
        /// Velocity \[m/s\].
        v_m_per_s: f64,
        /// Torque \[Nm\].
        torque_nm: f64,
        /// Time since onset \[s\].
        since_onset_s: f64,
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
    /// A simulation was given another number of values, or room for another number, than it takes.
    #[error("simulation: {what} has length {found}, it must be {expected}")]
    Length {
        /// What was given: `values`, `output`, `sensitivity`.
        what: &'static str,
        /// How long it is.
        found: usize,
        /// How long it must be.
        expected: usize,
    },
    /// A sensitivity was asked for to a parameter that the model does not have.
    #[error("simulation: there is no parameter number {index} (counted from 0) of {parameters}")]
    ParameterIndex {
        /// The parameter asked for.
        index: usize,
        /// How many the model has.
        parameters: usize,
    },
    /// More sensitivities were asked for than a simulation carries.
    #[error("simulation: sensitivities to {free} parameters, at most {maximum} can be asked for")]
    TooManyFree {
        /// How many were asked for.
        free: usize,
        /// [`crate::MAXIMUM_FREE`].
        maximum: usize,
    },
    /// The input has no samples.
    #[error("simulation: the input has no samples")]
    NoSamples,
    /// A time of the input is out of range.
    #[error("simulation: the input's {what} is {value_s} s, allowed is {allowed}")]
    InputTime {
        /// Which time: `interval_s`, `onset_s`, `rest_before_s`.
        what: &'static str,
        /// What it is \[s\].
        value_s: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A sample of the input is no finite number.
    #[error("simulation: the torque is {value_nm} Nm at sample {sample} (counted from 0)")]
    InputValue {
        /// Which sample, counted from 0.
        sample: usize,
        /// What it is \[Nm\].
        value_nm: f64,
    },
}
