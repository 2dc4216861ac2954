//! What a fitted model makes of every tightening: estimates and motion.

use crate::fitted::Fitted;
use crate::sizes::held;
use crate::{Case, DiagnoseError, Seen};
use rayon::prelude::*;
use snug_campaign::{Estimate, Motion};
use snug_identify::identify;

/// Motion and estimate of every case under one fitted model.
pub(crate) struct Sight<'a> {
    cases: &'a [Case],
    simulated: Vec<Motion>,
    estimates: Vec<Estimate>,
}

impl<'a> Sight<'a> {
    /// Identifies every tightening with the shared parameters held where all tightenings together put them.
    pub fn of(cases: &'a [Case], fitted: &Fitted) -> Result<Self, DiagnoseError> {
        let seen: Vec<(Estimate, Motion)> = cases
            .par_iter()
            .map(|case| see(case, fitted))
            .collect::<Result<_, _>>()?;
        let (estimates, simulated) = seen.into_iter().unzip();
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

/// A tightening's estimate and motion with the shared parameters held where all tightenings together put them.
fn see(case: &Case, fitted: &Fitted) -> Result<(Estimate, Motion), DiagnoseError> {
    let model = held(case, fitted).unwrap_or_else(|| case.model.clone());
    let estimate = identify(&model, &case.input, &case.tightening, &case.settings())?;
    let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
    let motion = model.simulate(&values, &case.input);
    Ok((estimate, motion))
}
