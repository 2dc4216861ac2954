//! One tightening, identified: the glue between model, measurement and solver.

use crate::residual_noise::noise_of;
use crate::{
    ConstraintKind, Constraints, Covariance, DenseResidual, Fit, IdentifyError, Settings,
    Simulation, Status, TighteningResidual, Whitening, convex_set, solve_from_starts,
};
use serde::{Deserialize, Serialize};
use snug_campaign::{
    Estimate, FitStatus, Identifiability, Interval, Parameter, ParameterEstimate, Quantity,
    Tightening,
};
use snug_model::{Input, Model};

/// How tightenings are identified.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct IdentifySettings {
    /// Which output is fitted: `Acceleration`, `Velocity` or `Displacement`; default `Acceleration`.
    pub fitted_output: Quantity,
    /// What must hold of m, c, k; default `[Positive, LightlyDamped]`.
    pub constraints: Vec<ConstraintKind>,
    /// Samples at the window's start that count for nothing; default 0.
    pub unscored_samples: usize,
    /// How the model is run beside the measurement: `Automatic`, `FreeRun` or `Restarted(every_s: …)`; default
    /// `Automatic`.
    pub simulation: Simulation,
    /// The solver's own settings.
    pub solver: Settings,
}

impl Default for IdentifySettings {
    fn default() -> Self {
        Self {
            fitted_output: Quantity::Acceleration,
            constraints: vec![ConstraintKind::Positive, ConstraintKind::LightlyDamped],
            unscored_samples: 0,
            simulation: Simulation::Automatic,
            solver: Settings::default(),
        }
    }
}

/// Identifies the free parameters of `model` from one tightening.
///
/// The residual is measured − simulated of the fitted output. Where the noise floor is of that output, the residual is
/// whitened with it (generalised least squares); otherwise all samples weigh the same. Either way the covariance is that
/// of the estimate under the measured noise, with the uncertainty of what was corrected in the quiet part, and widened
/// where the residual holds more than noise. A fixed parameter with a standard error widens it, too, and keeps that error
/// and its interval in the estimate.
///
/// # Errors
/// [`IdentifyError::MissingOutput`] when the tightening does not hold the fitted output, [`IdentifyError::TooShort`]
/// when fewer samples are scored than parameters are free, and what [`crate::solve`] refuses.
pub fn identify(
    model: &Model,
    input: &Input,
    tightening: &Tightening,
    settings: &IdentifySettings,
) -> Result<Estimate, IdentifyError> {
    let quantity = settings.fitted_output;
    let measured = tightening
        .motion
        .get(quantity)
        .ok_or(IdentifyError::MissingOutput { quantity })?;
    let whitening = tightening
        .noise
        .as_ref()
        .filter(|noise| noise.quantity == quantity)
        .and_then(Whitening::new);
    let residual = TighteningResidual::new(
        model,
        input,
        measured,
        quantity,
        whitening.as_ref(),
        settings.unscored_samples,
    );
    residual.check_length()?;
    let set = convex_set(model, &settings.constraints);
    let mut problem = DenseResidual::new(residual);
    let fit = solve_from_starts(&mut problem, &starts(model), &set, &settings.solver)?;
    let mut residual = problem.into_inner();
    let noise = noise_of(&mut residual, tightening, input, &fit);
    let mut covariance = fit.covariance(noise.as_residual_noise());
    residual.widen_by_fixed(&fit, &mut covariance);
    Ok(estimate(model, &set, &fit, &covariance))
}

/// Free values of the usual start, then of the further ones.
fn starts(model: &Model) -> Vec<Vec<f64>> {
    let free = model.free();
    let usual: Vec<f64> = model.parameters().iter().map(|p| p.value).collect();
    std::iter::once(usual)
        .chain(model.further_starts())
        .map(|values| free.iter().map(|&index| values[index]).collect())
        .collect()
}

/// Of every interval.
const CONFIDENCE: f64 = 0.95;
/// Standard errors to either side that hold 95 % of a normal distribution.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

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
            let half = NORMAL_QUANTILE * error;
            within(
                (value - half, value + half),
                (parameter.minimum, parameter.maximum),
            )
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
