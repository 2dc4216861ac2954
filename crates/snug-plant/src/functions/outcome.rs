//! Fitted tightenings as the columns that the function answers.

use arrow::array::{
    ArrayRef, BooleanBuilder, Float64Builder, ListBuilder, StringBuilder, StructArray,
    UInt32Builder,
};
use arrow::datatypes::Fields;
use arrow::error::ArrowError;
use snug_campaign::{Estimate, FitStatus, TighteningResult};
use std::sync::Arc;

/// A fit, or the sentence that says why there is none.
pub(super) type Outcome = Result<TighteningResult, String>;

fn status(status: FitStatus) -> &'static str {
    match status {
        FitStatus::Converged => "converged",
        FitStatus::ConvergedAtConstraint => "converged_at_constraint",
        FitStatus::IterationLimit => "iteration_limit",
        FitStatus::Stalled => "stalled",
        FitStatus::NotIdentifiable => "not_identifiable",
        FitStatus::Failed => "failed",
    }
}

fn texts<'a>(values: impl Iterator<Item = Option<&'a str>>) -> ArrayRef {
    let mut column = StringBuilder::new();
    values.for_each(|value| column.append_option(value));
    Arc::new(column.finish())
}

fn numbers(values: impl Iterator<Item = Option<f64>>) -> ArrayRef {
    let mut column = Float64Builder::new();
    values.for_each(|value| column.append_option(value));
    Arc::new(column.finish())
}

fn counts(values: impl Iterator<Item = Option<usize>>) -> ArrayRef {
    let mut column = UInt32Builder::new();
    values
        .for_each(|value| column.append_option(value.and_then(|count| u32::try_from(count).ok())));
    Arc::new(column.finish())
}

fn lists(values: impl Iterator<Item = Vec<String>>) -> ArrayRef {
    let mut column = ListBuilder::new(StringBuilder::new());
    for value in values {
        value
            .iter()
            .for_each(|text| column.values().append_value(text));
        column.append(true);
    }
    Arc::new(column.finish())
}

/// The outcomes of fits of a model with so many parameters as a struct of `fields`.
pub(super) fn columns(
    fields: &Fields,
    parameters: usize,
    outcomes: &[Outcome],
) -> Result<StructArray, ArrowError> {
    let done = || outcomes.iter().map(|outcome| outcome.as_ref().ok());
    let each = || done().map(|one| one.and_then(|one| one.estimate.as_ref()));
    let measure =
        |read: fn(&TighteningResult) -> Option<f64>| numbers(done().map(|one| read(one?)));
    let mut columns: Vec<ArrayRef> = Vec::with_capacity(fields.len());
    for index in 0..parameters {
        let of = || each().map(|one| one?.parameters.get(index));
        columns.push(numbers(of().map(|one| Some(one?.value))));
        columns.push(numbers(of().map(|one| one?.standard_error)));
        columns.push(numbers(of().map(|one| Some(one?.interval?.low))));
        columns.push(numbers(of().map(|one| Some(one?.interval?.high))));
    }
    let mut selected = BooleanBuilder::new();
    done().for_each(|one| selected.append_value(one.is_some_and(|one| one.selection.selected())));
    let reasons = |one: Option<&TighteningResult>| match one {
        Some(one) => one
            .selection
            .rejections
            .iter()
            .map(|reason| reason.name().to_owned())
            .collect(),
        None => vec!["not_identified".to_owned()],
    };
    let constraints =
        |one: Option<&Estimate>| one.map_or_else(Vec::new, |one| one.active_constraints.clone());
    columns.extend([
        texts(each().map(|one| Some(status(one?.status)))),
        texts(
            outcomes
                .iter()
                .map(|outcome| outcome.as_ref().err().map(String::as_str)),
        ),
        Arc::new(selected.finish()),
        lists(done().map(reasons)),
        lists(each().map(constraints)),
        measure(|one| one.measures.error_over_noise),
        measure(|one| one.measures.fit_percent),
        measure(|one| one.measures.natural_frequency_hz),
        measure(|one| one.measures.natural_frequency_low_hz),
        measure(|one| one.measures.natural_frequency_high_hz),
        measure(|one| one.measures.damping_ratio),
        counts(each().map(|one| Some(one?.identifiability.rank))),
        numbers(each().map(|one| Some(one?.identifiability.condition))),
        counts(each().map(|one| Some(one?.iterations))),
    ]);
    StructArray::try_new(fields.clone(), columns, None)
}
