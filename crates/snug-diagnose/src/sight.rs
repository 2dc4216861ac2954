//! What a fitted model makes of every tightening: estimates and motion.

use crate::fitted::Fitted;
use crate::sizes::held;
use crate::{Case, DiagnoseError, Seen};
use snug_campaign::{Estimate, Motion};
use snug_identify::{IdentifySettings, identify};

/// Motion and estimate of every case under one fitted model.
pub(crate) struct Sight<'a> {
    cases: &'a [Case],
    simulated: Vec<Motion>,
    estimates: Vec<Estimate>,
}

impl<'a> Sight<'a> {
    /// Identifies every tightening with the shared parameters held where all tightenings together put them.
    pub fn of(cases: &'a [Case], fitted: &Fitted) -> Result<Self, DiagnoseError> {
        let estimates = estimates(cases, fitted)?;
        let simulated = cases
            .iter()
            .zip(&estimates)
            .map(|(case, estimate)| {
                let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
                held(case, fitted).map_or_else(Default::default, |model| {
                    model.simulate(&values, &case.input)
                })
            })
            .collect();
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

/// Each tightening's estimate with the shared parameters held where all tightenings together put them.
fn estimates(cases: &[Case], fitted: &Fitted) -> Result<Vec<Estimate>, DiagnoseError> {
    cases
        .iter()
        .map(|case| {
            let model = held(case, fitted).unwrap_or_else(|| case.model.clone());
            let settings = IdentifySettings {
                fitted_output: case.quantity,
                constraints: case.constraints.clone(),
                unscored_samples: case.unscored,
                ..IdentifySettings::default()
            };
            Ok(identify(&model, &case.input, &case.tightening, &settings)?)
        })
        .collect()
}
