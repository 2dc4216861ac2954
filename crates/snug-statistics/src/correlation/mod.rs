//! Association of two quantities measured together.

mod pearson;
mod spearman;

pub use pearson::{Correlation, pearson};
pub use spearman::spearman;

use crate::sample::{check_lengths, check_sample};
use crate::{Interval, Result, TestResult, distributions};

/// Checks a pair of samples for a correlation.
fn check_pair(first: &[f64], second: &[f64], method: &'static str) -> Result<()> {
    check_lengths(("first", first.len()), ("second", second.len()))?;
    check_sample("first", first, method, 3)?;
    check_sample("second", second, method, 3)
}

/// Test of a correlation by `t = r √((n − 2)/(1 − r²))` on n − 2 degrees of freedom.
fn t_test(method: &'static str, name: &'static str, r: f64, count: usize) -> TestResult {
    let df = count as f64 - 2.0;
    let t = r * (df / ((1.0 - r) * (1.0 + r))).sqrt();
    TestResult {
        method,
        statistic_name: name,
        statistic: r,
        degrees_of_freedom: vec![df],
        p: if r.abs() >= 1.0 {
            0.0
        } else {
            distributions::student_t_two_sided(t, df)
        },
    }
}

/// Interval by Fisher's transform: `atanh r ± z width`.
fn fisher_interval(r: f64, width: f64, confidence: f64) -> Interval {
    let reach = distributions::normal_quantile(0.5 + 0.5 * confidence) * width;
    let centre = r.atanh();
    Interval {
        low: (centre - reach).tanh(),
        high: (centre + reach).tanh(),
        confidence,
    }
}
