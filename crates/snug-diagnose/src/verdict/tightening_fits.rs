//! What a fitted model makes of every tightening: estimates and motion.

use crate::data::case::Case;
use crate::error::DiagnoseError;
use crate::locate::Seen;
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::held;
use rayon::prelude::*;
use snug_campaign::{Estimate, Motion};
use snug_identify::{SIDE_BY_SIDE, Subject, identify_all};
use snug_model::Model;

/// Motion and estimate of every case under one fitted model.
pub(crate) struct Sight<'a> {
    cases: &'a [Case],
    simulated: Vec<Motion>,
    estimates: Vec<Estimate>,
}

impl<'a> Sight<'a> {
    /// Identifies every tightening with the shared parameters held where all tightenings together put them.
    pub fn of(cases: &'a [Case], fitted: &Fitted) -> Result<Self, DiagnoseError> {
        let alike: Vec<&[Case]> = (cases.chunks(SIDE_BY_SIDE))
            .flat_map(|some| some.chunk_by(|one, next| one.settings() == next.settings()))
            .collect();
        let errors = fitted.shared_errors();
        let seen = (alike.into_par_iter())
            .map(|some| see(some, fitted, errors.as_deref()))
            .collect::<Result<Vec<_>, _>>()?;
        let (estimates, simulated) = seen.into_iter().flatten().unzip();
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
                unscored: case.unscored,
            })
            .collect()
    }
}

/// Estimates and motions of cases with the same settings, the shared parameters held where all tightenings together put them.
fn see(
    cases: &[Case],
    fitted: &Fitted,
    errors: Option<&[f64]>,
) -> Result<Vec<(Estimate, Motion)>, DiagnoseError> {
    let models: Vec<Model> = (cases.iter())
        .map(|case| held(case, fitted, errors).unwrap_or_else(|| case.model.clone()))
        .collect();
    let subjects: Vec<Subject<'_>> = (cases.iter().zip(&models))
        .map(|(case, model)| Subject {
            model,
            input: &case.input,
            tightening: &case.tightening,
        })
        .collect();
    let Some(first) = cases.first() else {
        return Ok(Vec::new());
    };
    let estimates = identify_all(&subjects, &first.settings());
    (estimates.into_iter().zip(&subjects))
        .map(|(estimate, subject)| {
            let estimate = estimate?;
            let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
            let motion = subject.model.simulate(&values, subject.input);
            Ok((estimate, motion))
        })
        .collect()
}
