//! What a sample must be for a test to say anything: long enough, finite, not constant.

use std::fmt;

use serde::Serialize;

use crate::{Result, StatisticsError};

/// Which of the given samples an error speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Sample {
    /// The argument of this name.
    Named(&'static str),
    /// The group at this position, counted from 0.
    Group(usize),
}

impl fmt::Display for Sample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Named(name) => write!(f, "sample `{name}`"),
            Self::Group(index) => write!(f, "group {index} (counted from 0)"),
        }
    }
}

impl From<&'static str> for Sample {
    fn from(name: &'static str) -> Self {
        Self::Named(name)
    }
}

impl From<usize> for Sample {
    fn from(index: usize) -> Self {
        Self::Group(index)
    }
}

/// Beyond this magnitude a square, or a sum of squares, could overflow.
const LARGEST_MAGNITUDE: f64 = 1e150;

/// Checks that every value can be worked with and that there are enough of them.
pub(crate) fn check_sample(
    sample: impl Into<Sample>,
    values: &[f64],
    method: &'static str,
    required: usize,
) -> Result<()> {
    let sample = sample.into();
    if values.len() < required {
        return Err(StatisticsError::TooFew {
            sample,
            method,
            required,
            found: values.len(),
        });
    }
    check_finite(sample, values)
}

/// Checks that every value is finite and can be squared.
pub(crate) fn check_finite(sample: impl Into<Sample>, values: &[f64]) -> Result<()> {
    match values
        .iter()
        .position(|value| value.is_nan() || value.abs() > LARGEST_MAGNITUDE)
    {
        Some(index) => Err(StatisticsError::NotFinite {
            sample: sample.into(),
            index,
            value: values[index],
        }),
        None => Ok(()),
    }
}

/// Checks `k` groups: enough of them, each with enough finite values.
pub(crate) fn check_groups<G: AsRef<[f64]>>(
    groups: &[G],
    method: &'static str,
    required: usize,
) -> Result<()> {
    if groups.len() < 2 {
        return Err(StatisticsError::TooFewGroups {
            method,
            what: "groups",
            required: 2,
            found: groups.len(),
        });
    }
    groups
        .iter()
        .enumerate()
        .try_for_each(|(index, group)| check_sample(index, group.as_ref(), method, required))
}

/// Checks that two arguments run in step.
pub(crate) fn check_lengths(
    (left, left_length): (&'static str, usize),
    (right, right_length): (&'static str, usize),
) -> Result<()> {
    if left_length == right_length {
        Ok(())
    } else {
        Err(StatisticsError::LengthMismatch {
            left,
            left_length,
            right,
            right_length,
        })
    }
}

/// Checks a confidence level.
pub(crate) fn check_confidence(confidence: f64) -> Result<()> {
    if confidence > 0.0 && confidence < 1.0 {
        Ok(())
    } else {
        Err(StatisticsError::OutOfRange {
            argument: "confidence",
            value: confidence,
            allowed: "between 0 and 1, both excluded",
        })
    }
}

/// True when all values are the same (or there is none).
pub(crate) fn is_constant(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0] == pair[1])
}
