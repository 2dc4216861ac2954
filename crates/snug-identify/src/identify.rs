//! Tightenings, identified: the glue between model, measurement and solver.

use crate::base_model::fit::BaseFit;
use crate::base_model::noise::FittedInSweeps;
use crate::base_model::{fit, noise};
use crate::batch::BatchSimulator;
use crate::constraint_kind::convex_set;
use crate::error::IdentifyError;
use crate::multistart::decimated::DecimatedRecord;
use crate::multistart::integral_start::integral_start;
use crate::multistart::search::MultistartSearch;
use crate::noise::score_covariance::{OwnedNoise, noise_of};
use crate::residual::tightening::TighteningResidual;
use crate::settings::IdentifySettings;
use crate::task::FitTask;
use snug_campaign::{
    Estimate, FitStatus, Identifiability, Interval, Parameter, ParameterEstimate, Quantity,
    Tightening,
};
use snug_least_squares::{Constraints, Covariance, Fit, SolveError, Status};
use snug_model::{Input, Model, NormalEquations};
use std::iter::once;

/// Of every interval \[–\].
const CONFIDENCE: f64 = 0.95;

/// Identifies the free parameters of `model` from one tightening.
///
/// The residual is measured − simulated of the fitted output. Where the noise floor is of that output, the residual is
/// whitened with it (generalised least squares); otherwise all samples weigh the same. Either way the covariance is that
/// of the estimate under the measured noise, with the uncertainty of what was corrected in the quiet part, and widened
/// where the residual holds more than noise. A fixed parameter with a standard error widens it, too, and keeps that error
/// and its interval in the estimate.
///
/// # Errors
/// As [`FitTask::check`] when the parts contradict each other or hold what is no number, [`IdentifyError::TooShort`]
/// when fewer samples are scored than parameters are free, and what [`snug_least_squares::solve`] refuses.
pub fn identify(
    model: &Model,
    input: &Input,
    tightening: &Tightening,
    settings: &IdentifySettings,
) -> Result<Estimate, IdentifyError> {
    FitTask::new(tightening, input, model, settings).identify()
}

/// Identifies many tightenings, each as [`identify`] does and with the same bits, neighbours with the same settings side by
/// side: as many at a time as the processor's vector registers hold.
pub fn identify_all(tasks: &[FitTask<'_>]) -> Vec<Result<Estimate, IdentifyError>> {
    let alike = tasks.chunk_by(|one, next| one.settings == next.settings);
    alike.flat_map(identify_alike).collect()
}

/// Of tasks that have the same settings.
fn identify_alike(tasks: &[FitTask<'_>]) -> Vec<Result<Estimate, IdentifyError>> {
    let settings = &*tasks[0].settings;
    let quantity = settings.fitted_output;
    let mut attempts: Vec<Result<Attempt<'_>, IdentifyError>> =
        tasks.iter().map(Attempt::new).collect();
    let decimated_records: Vec<Option<DecimatedRecord>> = (attempts.iter().zip(tasks))
        .map(|(attempt, task)| attempt.as_ref().ok()?.decimated(task, quantity))
        .collect();
    let mut in_sweeps: Vec<BaseFit<'_, '_>> = (attempts.iter_mut().flatten())
        .filter_map(Attempt::in_sweeps)
        .collect();
    fit::fit_all(&mut in_sweeps, quantity, &settings.solver);
    drop(in_sweeps);
    let mut fitted_in_sweeps: Vec<FittedInSweeps<'_, '_>> = (attempts.iter_mut().zip(tasks))
        .filter_map(|(attempt, task)| attempt.as_mut().ok()?.fitted_in_sweeps(task))
        .collect();
    noise::ask_all(&mut fitted_in_sweeps, quantity);
    drop(fitted_in_sweeps);
    let simulator = BatchSimulator::default();
    let estimates = (attempts.into_iter().zip(tasks).zip(&decimated_records)).map(
        |((attempt, task), decimated)| async {
            (attempt?.estimate(task, decimated.as_ref(), settings, &simulator)).await
        },
    );
    simulator.finish(estimates)
}

/// A tightening on its way to an estimate.
struct Attempt<'a> {
    residual: TighteningResidual<'a>,
    set: Constraints,
    /// In the order of preference.
    starts: Vec<Vec<f64>>,
    /// The first so many differ in the effects' parameters; what follows are the same again with other m, c, k.
    distinct_starts: usize,
    usual_start: Vec<f64>,
    outcome: Option<Result<Fit, SolveError>>,
    latest: Option<([f64; 3], NormalEquations)>,
    noise: Option<OwnedNoise>,
}

impl<'a> Attempt<'a> {
    fn new(task: &'a FitTask<'a>) -> Result<Self, IdentifyError> {
        task.check()?;
        let residual = task.residual(&task.model)?;
        residual.check_length()?;
        let usual = starts(&task.model);
        let is_rugged = usual.len() > 1 || residual.has_unilateral_contact();
        let near = integral_start(task).filter(|_| is_rugged || residual.is_base());
        Ok(Self {
            residual,
            set: convex_set(&task.model, &task.settings.constraints),
            starts: near.map_or_else(|| usual.clone(), |near| nearer(&usual, &near, is_rugged)),
            distinct_starts: usual.len(),
            usual_start: usual.into_iter().next().unwrap_or_default(),
            outcome: None,
            latest: None,
            noise: None,
        })
    }

    /// As sweeps fit it, if they can.
    fn in_sweeps(&mut self) -> Option<BaseFit<'_, 'a>> {
        match self.starts.as_slice() {
            [start] if self.residual.is_base() => Some(BaseFit {
                residual: &mut self.residual,
                start,
                usual_start: &self.usual_start,
                set: &self.set,
                outcome: &mut self.outcome,
                latest: &mut self.latest,
            }),
            _ => None,
        }
    }

    /// As sweeps ask about its noise: if the last one of the fit was made at the estimate.
    fn fitted_in_sweeps<'r>(&'r mut self, task: &'a FitTask<'a>) -> Option<FittedInSweeps<'r, 'a>> {
        let Some(Ok(fit)) = &self.outcome else {
            return None;
        };
        let (values, found) = self.latest?;
        let is_here = self.residual.all_values(&fit.values).starts_with(&values);
        is_here.then_some(FittedInSweeps {
            residual: &mut self.residual,
            task,
            fit,
            found,
            noise: &mut self.noise,
        })
    }

    /// On what several starts are tried.
    fn decimated(&self, task: &'a FitTask<'a>, quantity: Quantity) -> Option<DecimatedRecord> {
        let is_one = self.starts.len() == 1;
        (!is_one).then(|| DecimatedRecord::of(task, quantity))?
    }

    /// As it is fitted by itself.
    fn multistart_search<'s>(
        &'s self,
        task: &'a FitTask<'a>,
        decimated: Option<&'a DecimatedRecord>,
        settings: &'s IdentifySettings,
        simulator: &'s BatchSimulator<'a>,
    ) -> MultistartSearch<'s, 'a> {
        MultistartSearch {
            residual: &self.residual,
            set: &self.set,
            starts: &self.starts,
            distinct_starts: self.distinct_starts,
            decimated,
            task,
            settings,
            simulator,
        }
    }

    /// The estimate with its covariance, after a fit if that is still to be made.
    async fn estimate(
        mut self,
        task: &'a FitTask<'a>,
        decimated: Option<&'a DecimatedRecord>,
        settings: &IdentifySettings,
        simulator: &BatchSimulator<'a>,
    ) -> Result<Estimate, IdentifyError> {
        let fit = match self.outcome.take() {
            Some(outcome) => outcome?,
            None => {
                let multistart_search =
                    self.multistart_search(task, decimated, settings, simulator);
                multistart_search.lowest().await?
            }
        };
        let noise = match self.noise {
            Some(noise) => noise,
            None => noise_of(&mut self.residual, task, &fit, simulator).await,
        };
        let mut covariance = fit.covariance(noise.as_residual_noise());
        self.residual.widen_by_fixed(&fit, &mut covariance);
        Ok(estimate(&task.model, &self.set, &fit, &covariance))
    }
}

/// Free values of the usual start, then of the further ones.
fn starts(model: &Model) -> Vec<Vec<f64>> {
    let free = model.free();
    let usual: Vec<f64> = model.parameters().iter().map(|p| p.value).collect();
    once(usual)
        .chain(model.further_starts())
        .map(|values| free.iter().map(|&index| values[index]).collect())
        .collect()
}

/// The same starts with m, c, k that explain the tightening as far as it can be without an effect: from values of other
/// tightenings, a search first takes what m, c, k lack for the effect, and wanders.
///
/// Where valley lies beside valley, the starts are kept as they are, too: an effect that acts for long makes such m, c, k
/// worthless, and who tries several starts side by side hardly notices as many more.
fn nearer(usual: &[Vec<f64>], near: &[f64], is_rugged: bool) -> Vec<Vec<f64>> {
    let nearer = |start: &Vec<f64>| [near, &start[near.len()..]].concat();
    let kept = if is_rugged { usual } else { &[] };
    usual
        .iter()
        .map(nearer)
        .chain(kept.iter().cloned())
        .collect()
}

/// The fit in the words everyone shares; intervals end where a parameter's own bounds do.
fn estimate(model: &Model, set: &Constraints, fit: &Fit, covariance: &Covariance) -> Estimate {
    let free = model.free();
    let parameters = (model.parameters().iter().enumerate())
        .map(
            |(index, parameter)| match free.iter().position(|&free| free == index) {
                Some(column) => ParameterEstimate {
                    value: fit.values[column],
                    standard_error: covariance.standard_errors[column],
                    interval: covariance
                        .interval(column, fit.values[column], CONFIDENCE)
                        .map(|ends| within(ends, set.bounds_of(column))),
                    fixed: false,
                    ..as_fixed(parameter)
                },
                None => as_fixed(parameter),
            },
        )
        .collect();
    let name = |column: usize| model.parameters()[free[column]].name.clone();
    Estimate {
        parameters,
        covariance: covariance.matrix.clone(),
        status: status(fit.status),
        active_constraints: fit
            .active
            .iter()
            .map(|active| active.name.clone())
            .collect(),
        identifiability: Identifiability {
            rank: fit.identifiability.rank,
            free: fit.identifiability.free,
            condition: fit.identifiability.condition,
            strongest_correlation: fit
                .identifiability
                .strongest
                .map(|(first, second, correlation)| (name(first), name(second), correlation)),
        },
        iterations: fit.work.iterations,
        evaluations: fit.work.evaluations + fit.work.linearizations,
        conic_solves: fit.work.conic_solves,
    }
}

/// A fixed parameter with what is stated about it.
fn as_fixed(parameter: &Parameter) -> ParameterEstimate {
    let value = parameter.value;
    ParameterEstimate {
        name: parameter.name.clone(),
        unit: parameter.unit.clone(),
        value,
        standard_error: parameter.standard_error,
        interval: parameter.standard_error.map(|error| {
            let Interval { low, high } = Interval::normal(value, error);
            within((low, high), (parameter.minimum, parameter.maximum))
        }),
        fixed: true,
    }
}

fn within((low, high): (f64, f64), (minimum, maximum): (f64, f64)) -> Interval {
    Interval {
        low: low.max(minimum),
        high: high.min(maximum),
    }
}

fn status(status: Status) -> FitStatus {
    match status {
        Status::Converged => FitStatus::Converged,
        Status::ConvergedAtConstraint => FitStatus::ConvergedAtConstraint,
        Status::IterationLimit => FitStatus::IterationLimit,
        Status::Stalled => FitStatus::Stalled,
        Status::NotIdentifiable => FitStatus::NotIdentifiable,
        Status::Failed => FitStatus::Failed,
    }
}

impl FitTask<'_> {
    /// Its estimate, as [`identify`](crate::identify).
    ///
    /// # Errors
    /// As [`identify`](crate::identify).
    pub fn identify(&self) -> Result<Estimate, IdentifyError> {
        let mut outcomes = identify_all(std::slice::from_ref(self));
        outcomes.pop().expect("one outcome for one task")
    }
}

#[cfg(test)]
mod tests;
