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
