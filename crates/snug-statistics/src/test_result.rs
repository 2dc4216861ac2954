//! What a test says: statistic, degrees of freedom, p value.

use crate::distributions::student_t_two_sided;
use serde::Serialize;

/// What every hypothesis test of this crate states.
///
/// All p values are two-sided where the statistic has a sign.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TestResult {
    /// The method in the field's words, such as `Welch t test`.
    pub method: &'static str,
    /// Name of the statistic: `t`, `F`, `U`, `W`, `H`, …
    pub statistic_name: &'static str,
    /// Value of the statistic.
    pub statistic: f64,
    /// Degrees of freedom: none for rank and permutation tests, one for t and chi-squared,
    /// numerator and denominator for F.
    pub degrees_of_freedom: Vec<f64>,
    /// Probability, if the null hypothesis holds, of a statistic at least as extreme.
    pub p: f64,
}

impl TestResult {
    /// A two-sided test of Student's `t` with `df` degrees of freedom.
    pub(crate) fn of_t(method: &'static str, t: f64, df: f64) -> Self {
        Self {
            method,
            statistic_name: "t",
            statistic: t,
            degrees_of_freedom: vec![df],
            p: student_t_two_sided(t, df),
        }
    }
}

/// A confidence interval, in the unit of the quantity it belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// Lower limit.
    pub low: f64,
    /// Upper limit.
    pub high: f64,
    /// Confidence level, such as 0.95.
    pub confidence: f64,
}
