//! One tightening under a fit: its own numbers, and what the model makes of it.

use super::by_hand::{HandNumber, range};
use super::cases::LiveCases;
use super::fit::LiveFit;
use super::step::{height_nm, step_response};
use crate::error::DiagnoseError;
use crate::pooled::parameter_place::effect_of;
use crate::pooled::sizes::held;
use crate::verdict::tightening_fits::held_models;
use snug_campaign::{Estimate, Interval, ParameterEstimate};
use snug_identify::derived::{self, Derived};
use snug_identify::{FitTask, identify, identify_all, in_batches};
use snug_model::{BASE_PARAMETERS, Model};

/// One tightening under a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct LiveTightening {
    /// Mass, damping and stiffness with 95 % intervals, each in its unit; the effects' sizes held where all tightenings put them, known
    /// as well as they are.
    pub base: Vec<ParameterEstimate>,
    /// At how many Hz mass, damping and stiffness ring, with a 95 % interval; `None` where they do not. With the damping ratio it is their
    /// pair of poles.
    pub rings_at_hz: Option<Derived>,
    /// Their damping ratio \[–\]; `None` without a spring.
    pub damping_ratio: Option<Derived>,
    /// The compared output as simulated, in its SI unit, a value for each sample of the window.
    pub output: Vec<f64>,
    /// The same, in its SI unit, had the torque stepped from nothing to [its largest](LiveCases::step_nm) at the window's start; `None`
    /// where the model runs away.
    pub step: Option<Vec<f64>>,
    /// Every number of its model, in the model's order, as it may be set by hand.
    pub numbers: Vec<HandNumber>,
}

impl LiveCases {
    /// The tightening number `member` of [`LiveCases::tasks`] under `fit`.
    ///
    /// # Errors
    /// What the model or the fit of this one tightening refuses.
    ///
    /// # Panics
    /// Where there is no such tightening.
    pub fn tightening(
        &self,
        fit: &LiveFit,
        member: usize,
    ) -> Result<LiveTightening, DiagnoseError> {
        let (case, fitted) = (&self.cases[member], &fit.fitted);
        let errors = fitted.shared_errors();
        let model = match held(case, fitted, member, errors.as_deref()) {
            Some(model) => model,
            None => case.model_with(&fitted.effects)?,
        };
        let values: Vec<f64> = model.parameters().iter().map(|p| p.value).collect();
        let output = case.simulated(&model, &values)?;
        let mut estimate = identify(&model, &case.input, &case.tightening, &case.settings)?;
        let shared: Vec<(&str, Interval)> = (fit.sizes().iter().flat_map(|(_, sizes)| sizes))
            .filter_map(|size| {
                let (low, high) = (size.low?, size.high?);
                Some((size.name.as_str(), Interval { low, high }))
            })
            .collect();
        let known = |index: usize, name: &str| {
            let of_all = shared.iter().find(|(known, _)| *known == name);
            let own = estimate.parameters.get(index).and_then(|one| one.interval);
            own.or(of_all.map(|(_, interval)| *interval))
        };
        let numbers = (model.parameters().iter().zip(&values).enumerate())
            .map(|(index, (parameter, &value))| {
                let interval = known(index, &parameter.name);
                let bounds = [parameter.minimum, parameter.maximum];
                HandNumber {
                    name: parameter.name.clone(),
                    unit: parameter.unit.clone(),
                    value,
                    interval,
                    range: range(value, interval, bounds),
                    effect: effect_of(&fitted.effects, index).map(|(effect, _)| effect),
                }
            })
            .collect();
        let rig = case.model.rig();
        let rings_at_hz = derived::damped_frequency(rig, &estimate);
        let damping_ratio = derived::damping(rig, &estimate);
        estimate.parameters.truncate(BASE_PARAMETERS.len());
        Ok(LiveTightening {
            base: estimate.parameters,
            rings_at_hz,
            damping_ratio,
            step: step_response(case, &model, &values),
            output,
            numbers,
        })
    }
}

impl LiveCases {
    /// The torque \[Nm\] to which the step responses of tightening number `member` step: its largest in size, with its sign.
    ///
    /// # Panics
    /// Where there is no such tightening.
    pub fn step_nm(&self, member: usize) -> f64 {
        height_nm(&self.cases[member])
    }

    /// The model of each tightening, the effects' sizes held as in [`LiveCases::tightening`], and what is identified with it.
    ///
    /// # Errors
    /// What the fit of a tightening refuses.
    pub fn estimates(&self, fit: &LiveFit) -> Result<Vec<(Model, Estimate)>, DiagnoseError> {
        let models = held_models(&self.cases, &fit.fitted);
        let tasks: Vec<FitTask<'_>> = (self.cases.iter().zip(&models))
            .map(|(case, model)| case.with_model(model))
            .collect();
        let estimates = in_batches(&tasks, |some| {
            identify_all(some)
                .into_iter()
                .collect::<Result<Vec<_>, _>>()
        })?;
        let models = models.iter().map(|model| model.clone().into_owned());
        Ok(models.zip(estimates).collect())
    }
}
