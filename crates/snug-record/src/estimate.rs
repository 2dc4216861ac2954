//! `/estimate`: what was identified on one tightening, at the time its samples begin.

use crate::schema::{Field, Kind, Message, field};
use serde_json::{Map, Value, json};
use snug_campaign::{ParameterEstimate, TighteningResult};

const PARAMETER: &[Field] = &[
    field("name", Kind::Text, "", "Name with unit suffix"),
    field("unit", Kind::Text, "", "Unit"),
    field(
        "value",
        Kind::Double,
        "see unit",
        "Estimated or fixed value",
    ),
    field("standard_error", Kind::Double, "see unit", "Standard error"),
    field(
        "low",
        Kind::Double,
        "see unit",
        "Lower end of the 95 % interval",
    ),
    field(
        "high",
        Kind::Double,
        "see unit",
        "Upper end of the 95 % interval",
    ),
    field("fixed", Kind::Flag, "", "Held fixed"),
];

const CORRELATION: &[Field] = &[
    field("first", Kind::Text, "", "One parameter"),
    field("second", Kind::Text, "", "The other parameter"),
    field("correlation", Kind::Double, "", "Their correlation"),
];

const IDENTIFIABILITY: &[Field] = &[
    field("rank", Kind::Count, "", "Rank of the scaled sensitivities"),
    field("free", Kind::Count, "", "Free parameters"),
    field(
        "condition",
        Kind::Double,
        "",
        "Condition number of the scaled sensitivities",
    ),
    field(
        "strongest_correlation",
        Kind::Object(CORRELATION),
        "",
        "Most correlated pair",
    ),
];

const MEASURES: &[Field] = &[
    field(
        "fit_percent",
        Kind::Double,
        "%",
        "Fit of the displacement (NRMSE)",
    ),
    field(
        "fit_percent_fitted_output",
        Kind::Double,
        "%",
        "Fit of the fitted output (NRMSE)",
    ),
    field(
        "error_over_noise",
        Kind::Double,
        "",
        "Residual over noise: 1 is nothing left but noise",
    ),
    field(
        "rms_displacement_rad",
        Kind::Double,
        "rad",
        "Root-mean-square residual of the displacement",
    ),
    field(
        "euler_accuracy_percent",
        Kind::Double,
        "%",
        "Accuracy of the explicit Euler displacement",
    ),
    field(
        "natural_frequency_hz",
        Kind::Double,
        "Hz",
        "Natural frequency of the hand and arm",
    ),
    field(
        "natural_frequency_low_hz",
        Kind::Double,
        "Hz",
        "Natural frequency: lower end of the 95 % interval",
    ),
    field(
        "natural_frequency_high_hz",
        Kind::Double,
        "Hz",
        "Natural frequency: upper end of the 95 % interval",
    ),
    field(
        "damped_frequency_hz",
        Kind::Double,
        "Hz",
        "Damped frequency of tool, hand and arm",
    ),
    field(
        "damped_frequency_low_hz",
        Kind::Double,
        "Hz",
        "Damped frequency: lower end of the 95 % interval",
    ),
    field(
        "damped_frequency_high_hz",
        Kind::Double,
        "Hz",
        "Damped frequency: upper end of the 95 % interval",
    ),
    field(
        "damping_ratio",
        Kind::Double,
        "",
        "Damping ratio of tool, hand and arm",
    ),
    field(
        "damping_ratio_low",
        Kind::Double,
        "",
        "Damping ratio: lower end of the 95 % interval",
    ),
    field(
        "damping_ratio_high",
        Kind::Double,
        "",
        "Damping ratio: upper end of the 95 % interval",
    ),
    field(
        "thesis_damping_ratio",
        Kind::Double,
        "",
        "Damping ratio with the tool's mass",
    ),
    field("peak_force_f1_n", Kind::Double, "N", "Largest F1"),
    field("peak_force_f2_n", Kind::Double, "N", "Largest F2"),
    field("peak_force_f3_n", Kind::Double, "N", "Largest F3"),
    field("peak_grip_force_n", Kind::Double, "N", "Largest grip force"),
];

/// The message's table.
pub(crate) const ESTIMATE: Message = Message {
    name: "snug.Estimate",
    about: "What was identified on one tightening",
    fields: &[
        field(
            "tightening",
            Kind::Count,
            "",
            "Running number, as in /tightening/window",
        ),
        field("file", Kind::Text, "", "Measurement file"),
        field("number", Kind::Count, "", "Number within the file"),
        field("selected", Kind::Flag, "", "Takes part in the statistics"),
        field(
            "rejections",
            Kind::List(&Kind::Text),
            "",
            "Why it was rejected",
        ),
        field("status", Kind::Text, "", "How the identification ended"),
        field(
            "parameters",
            Kind::List(&Kind::Object(PARAMETER)),
            "",
            "Parameters of the model",
        ),
        field(
            "covariance",
            Kind::List(&Kind::Double),
            "products of the parameters' units",
            "Covariance of the free parameters, row by row",
        ),
        field(
            "active_constraints",
            Kind::List(&Kind::Text),
            "",
            "Constraints active at the optimum",
        ),
        field(
            "identifiability",
            Kind::Object(IDENTIFIABILITY),
            "",
            "How well the data determine the parameters",
        ),
        field("iterations", Kind::Count, "", "Gauss-Newton iterations"),
        field(
            "evaluations",
            Kind::Count,
            "",
            "Evaluations of the residual",
        ),
        field("conic_solves", Kind::Count, "", "Conic programs solved"),
        field(
            "measures",
            Kind::Object(MEASURES),
            "",
            "Agreement of model and measurement",
        ),
    ],
};

/// The message; without an estimate it says only why there is none.
pub(crate) fn message(
    running_number: u64,
    result: &TighteningResult,
) -> Result<Value, serde_json::Error> {
    let mut message = match &result.estimate {
        Some(estimate) => match serde_json::to_value(estimate)? {
            Value::Object(fields) => fields,
            _ => unreachable!("a struct with named fields is an object"),
        },
        None => Map::new(),
    };
    if let Some(estimate) = &result.estimate {
        let parameters = estimate.parameters.iter().map(parameter).collect();
        message.insert("parameters".into(), Value::Array(parameters));
        if let Some((first, second, correlation)) = &estimate.identifiability.strongest_correlation
        {
            message["identifiability"]["strongest_correlation"] =
                json!({"first": first, "second": second, "correlation": correlation});
        }
    }
    message.insert("tightening".into(), running_number.into());
    message.insert("file".into(), result.id.file.as_str().into());
    message.insert("number".into(), result.id.number.into());
    message.insert("selected".into(), result.selection.selected().into());
    message.insert(
        "rejections".into(),
        serde_json::to_value(&result.selection.rejections)?,
    );
    message.insert("measures".into(), serde_json::to_value(&result.measures)?);
    Ok(Value::Object(message))
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
