//! How much of a measured output there is to explain.

use snug_identify::FitTask;

/// Σ of squares of the fitted output about its mean, over what is scored of all recordings; about the mean between two restarts where
/// the model is restarted, since what it takes up it need not explain.
pub(crate) fn power(cases: &[FitTask<'_>]) -> f64 {
    let about_mean = |values: &[f64]| -> f64 {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|y| (y - mean).powi(2)).sum()
    };
    let of_case = |case: &FitTask<'_>| -> f64 {
        let scored = &case.measured()[case.unscored()..];
        let apart = case.input.samples_between_restarts();
        (scored
            .chunks(apart.unwrap_or(scored.len()).max(1))
            .map(about_mean))
        .sum()
    };
    cases.iter().map(of_case).sum()
}
