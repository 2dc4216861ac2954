//! A test's outcome as results state it.

use snug_statistics::{StatisticsError, TestResult};

/// What a test found, or why it could not be made.
pub struct Stated {
    /// Name of the statistic; empty without one.
    pub statistic_name: String,
    /// Its value.
    pub statistic: Option<f64>,
    /// Degrees of freedom.
    pub degrees_of_freedom: Vec<f64>,
    /// p value.
    pub p: Option<f64>,
    /// Why there is none.
    pub note: Option<String>,
}

impl From<Result<TestResult, StatisticsError>> for Stated {
    fn from(outcome: Result<TestResult, StatisticsError>) -> Self {
        match outcome {
            Ok(test) => Self {
                statistic_name: test.statistic_name.to_owned(),
                statistic: Some(test.statistic),
                degrees_of_freedom: test.degrees_of_freedom,
                p: Some(test.p),
                note: None,
            },
            Err(error) => Self {
                statistic_name: String::new(),
                statistic: None,
                degrees_of_freedom: Vec::new(),
                p: None,
                note: Some(error.to_string()),
            },
        }
    }
}
