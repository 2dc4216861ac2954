//! What a fitted model makes of every tightening: estimates and motion.

use crate::error::DiagnoseError;
use crate::locate::Seen;
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::held;
use snug_campaign::{Estimate, Motion};
use snug_identify::{FitTask, identify_all, in_batches};
use snug_model::Model;
use std::borrow::Cow;

/// Motion and estimate of every tightening under one fitted model.
pub(crate) struct TighteningFits<'a> {
    cases: &'a [FitTask<'a>],
    simulated: Vec<Motion>,
    estimates: Vec<Estimate>,
}

impl<'a> TighteningFits<'a> {
    /// Identifies every tightening with the shared parameters held where all tightenings together put them.
    pub fn of(cases: &'a [FitTask<'a>], fitted: &Fitted) -> Result<Self, DiagnoseError> {
        let errors = fitted.shared_errors();
        let fits = in_batches(cases, |some| fits(some, fitted, errors.as_deref()))?;
        let (estimates, simulated) = fits.into_iter().unzip();
        Ok(Self {
            cases,
            simulated,
            estimates,
        })
    }

    /// Measurement, motion and estimate of each.
    pub fn seen(&self) -> Vec<Seen<'_>> {
        self.cases
            .iter()
            .zip(&self.simulated)
            .zip(&self.estimates)
            .map(|((case, simulated), estimate)| Seen {
                tightening: &case.tightening,
                simulated,
                estimate,
                unscored: case.unscored(),
            })
            .collect()
    }
}

/// Estimates and motions, the shared parameters held where all tightenings together put them.
fn fits(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    errors: Option<&[f64]>,
) -> Result<Vec<(Estimate, Motion)>, DiagnoseError> {
    let models: Vec<Cow<'_, Model>> = (cases.iter().enumerate())
        .map(|(member, case)| {
            let held = held(case, fitted, member, errors);
            held.map_or(Cow::Borrowed(&*case.model), Cow::Owned)
        })
        .collect();
    let tasks: Vec<FitTask<'_>> = (cases.iter().zip(&models))
        .map(|(case, model)| case.with_model(model))
        .collect();
    (identify_all(&tasks).into_iter().zip(&tasks))
        .map(|(estimate, task)| {
            let estimate = estimate?;
            let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
            let motion = task.model.simulate(&values, &task.input)?;
            Ok((estimate, motion))
        })
        .collect()
}
