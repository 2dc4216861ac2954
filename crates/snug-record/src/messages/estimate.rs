//! `/estimate`: what was identified on one tightening, at the time its samples begin.

use crate::encoding::schema::{
    Field, Message, count, flag, group, list, number, pure_number, text,
};
use serde_json::{Value, json};
use snug_campaign::{ParameterEstimate, TighteningResult};

const PARAMETER: &[Field] = &[
    text("name", "Name with unit suffix"),
    text("unit", "Unit"),
    number("value", "see unit", "Estimated or fixed value"),
    number("standard_error", "see unit", "Standard error"),
    number("low", "see unit", "Lower end of the 95 % interval"),
    number("high", "see unit", "Upper end of the 95 % interval"),
    flag("fixed", "Held fixed"),
];

const CORRELATION: &[Field] = &[
    text("first", "One parameter"),
    text("second", "The other parameter"),
    pure_number("correlation", "Their correlation"),
];

const IDENTIFIABILITY: &[Field] = &[
    count("rank", "Rank of the scaled sensitivities"),
    count("free", "Free parameters"),
    pure_number("condition", "Condition number of the scaled sensitivities"),
    group("strongest_correlation", CORRELATION, "Most correlated pair"),
];

const MEASURES: &[Field] = &[
    number("fit_percent", "%", "Fit of the displacement (NRMSE)"),
    number(
        "fit_percent_fitted_output",
        "%",
        "Fit of the fitted output (NRMSE)",
    ),
    pure_number(
        "error_over_noise",
        "Residual over noise: 1 is nothing left but noise",
    ),
    number(
        "rms_displacement_rad",
        "rad",
        "Root-mean-square residual of the displacement",
    ),
    number(
        "euler_accuracy_percent",
        "%",
        "Accuracy of the explicit Euler displacement",
    ),
    number(
        "natural_frequency_hz",
        "Hz",
        "Natural frequency of the hand and arm",
    ),
    number(
        "natural_frequency_low_hz",
        "Hz",
        "Natural frequency: lower end of the 95 % interval",
    ),
    number(
        "natural_frequency_high_hz",
        "Hz",
        "Natural frequency: upper end of the 95 % interval",
    ),
    number(
        "damped_frequency_hz",
        "Hz",
        "Damped frequency of tool, hand and arm",
    ),
    number(
        "damped_frequency_low_hz",
        "Hz",
        "Damped frequency: lower end of the 95 % interval",
    ),
    number(
        "damped_frequency_high_hz",
        "Hz",
        "Damped frequency: upper end of the 95 % interval",
    ),
    pure_number("damping_ratio", "Damping ratio of tool, hand and arm"),
    pure_number(
        "damping_ratio_low",
        "Damping ratio: lower end of the 95 % interval",
    ),
    pure_number(
        "damping_ratio_high",
        "Damping ratio: upper end of the 95 % interval",
    ),
    pure_number("thesis_damping_ratio", "Damping ratio with the tool's mass"),
    number("peak_force_f1_n", "N", "Largest F1"),
    number("peak_force_f2_n", "N", "Largest F2"),
    number("peak_force_f3_n", "N", "Largest F3"),
    number("peak_grip_force_n", "N", "Largest grip force"),
];

const PREDICTION: &[Field] = &[
    number("fit_percent", "%", "Fit of the fitted output (NRMSE)"),
    number(
        "rms",
        "rad, rad/s or rad/s²",
        "Root-mean-square residual of the fitted output",
    ),
    number("every_s", "s", "From one restart to the next"),
];

const VALIDATION: &[Field] = &[
    group("free_run", PREDICTION, "From the first sample to the last"),
    group(
        "restarted",
        PREDICTION,
        "Restarted from the measured motion",
    ),
];

/// The message's table.
pub(crate) const ESTIMATE: Message = Message {
    name: "snug.Estimate",
    about: "What was identified on one tightening",
    fields: &[
        count("tightening", "Running number, as in /tightening/window"),
        text("file", "Measurement file"),
        count("number", "Number within the file"),
        flag("selected", "Takes part in the statistics"),
        list(text("rejections", "Why it was rejected")),
        text("status", "How the identification ended"),
        list(group("parameters", PARAMETER, "Parameters of the model")),
        list(number(
            "covariance",
            "products of the parameters' units",
            "Covariance of the free parameters, row by row",
        )),
        list(text(
            "active_constraints",
            "Constraints active at the optimum",
        )),
        group(
            "identifiability",
            IDENTIFIABILITY,
            "How well the data determine the parameters",
        ),
        count("iterations", "Gauss-Newton iterations"),
        count("evaluations", "Evaluations of the residual"),
        count("conic_solves", "Conic programs solved"),
        group("measures", MEASURES, "Agreement of model and measurement"),
        group(
            "validation",
            VALIDATION,
            "How well the parameters of others predict it, if it was kept for validation",
        ),
    ],
};

/// The message; without an estimate it says only why there is none.
pub(crate) fn message(
    running_number: u64,
    result: &TighteningResult,
) -> Result<Value, serde_json::Error> {
    let mut message = json!({});
    if let Some(estimate) = &result.estimate {
        message = serde_json::to_value(estimate)?;
        message["parameters"] = estimate.parameters.iter().map(parameter).collect();
        if let Some((first, second, correlation)) = &estimate.identifiability.strongest_correlation
        {
            message["identifiability"]["strongest_correlation"] =
                json!({"first": first, "second": second, "correlation": correlation});
        }
    }
    message["tightening"] = running_number.into();
    message["file"] = result.id.file.as_str().into();
    message["number"] = result.id.number.into();
    message["selected"] = result.selection.selected().into();
    message["rejections"] = serde_json::to_value(&result.selection.rejections)?;
    message["measures"] = serde_json::to_value(&result.measures)?;
    if let Some(validation) = &result.validation {
        message["validation"] = serde_json::to_value(validation)?;
    }
    Ok(message)
}

/// The interval's ends stand beside the value, so that a table shows them as columns.
fn parameter(parameter: &ParameterEstimate) -> Value {
    json!({
        "name": parameter.name,
        "unit": parameter.unit,
        "value": parameter.value,
        "standard_error": parameter.standard_error,
        "low": parameter.interval.map(|interval| interval.low),
        "high": parameter.interval.map(|interval| interval.high),
        "fixed": parameter.fixed,
    })
}
