//! Many starts tried on a decimated record: the same tightening with every few samples replaced by their mean.
//!
//! Which minimum a start leads to shows on a record of a few hundred samples as well as on the whole one, for a fraction of
//! the work. Only the ends of the best decimated fits are worth a fit of every sample.

use crate::batch::BatchSimulator;
use crate::multistart::early_stopping::{STOP_SMOOTHED, fit_starts};
use crate::multistart::thresholds::{
    APART, COST_RATIO_LIMIT, ENOUGH_SAMPLES, LONGEST_INTERVAL_S, MOST_DECIMATED_ENDS, MOST_STEPS,
    SAME_MINIMUM, SMOOTHED_TOLERANCE,
};
use crate::residual::restarts::motions_at;
use crate::residual::scoring::Scoring;
use crate::residual::tightening::TighteningResidual;
use crate::settings::IdentifySettings;
use crate::task::FitTask;
use crate::task::decimated::{decimated_input, means};
use snug_campaign::Quantity;
use snug_least_squares::{Constraints, Fit, Settings, SolveError, Work};
use snug_model::{Input, Model};

/// Where fits of every sample should begin.
pub(crate) struct Tried {
    /// Best first.
    pub starts: Vec<Vec<f64>>,
    /// Steps and simulations on the decimated record; of these every one is a fraction of one on the whole.
    pub work: Work,
}

/// A tightening with every few samples replaced by their mean.
pub(crate) struct DecimatedRecord {
    /// Samples that became one.
    factor: usize,
    /// The torque.
    input: Input,
    /// The same with restarts from the measured motion, where that is known and restarts do not hide what is fitted: they do
    /// anything but the acceleration.
    pub restarted: Option<Input>,
    measured: Vec<f64>,
}

impl DecimatedRecord {
    /// Of the tightening's torque and `quantity`; `None` where the record is too short for one, or the simulation is restarted
    /// from the measured motion.
    pub fn of(task: &FitTask<'_>, quantity: Quantity) -> Option<Self> {
        let (input, measured) = (&task.input, task.tightening.motion.get(quantity)?);
        let interval_s = input.interval_s();
        let model = &task.model;
        let longest_s = LONGEST_INTERVAL_S * model.scale().times_hand("s", model.rig());
        let most = (longest_s / interval_s) as usize;
        let factor = most.min(input.samples() / ENOUGH_SAMPLES);
        if factor < 2 || input.is_restarted() {
            return None;
        }
        let torque_nm: Vec<f64> =
            (input.grid_nm().iter().step_by(input.substeps()).copied()).collect();
        let decimated = decimated_input(input, &torque_nm, factor);
        let means_of = |quantity| Some(means(task.tightening.motion.get(quantity)?, factor));
        let restarted = || {
            let angle_rad = means_of(Quantity::Displacement)?;
            let velocity_rad_per_s = means_of(Quantity::Velocity)?;
            Some(along_motion(
                decimated.clone(),
                &angle_rad,
                &velocity_rad_per_s,
            ))
        };
        let restarted = (quantity == Quantity::Acceleration)
            .then(restarted)
            .flatten();
        Some(Self {
            factor,
            input: decimated,
            restarted,
            measured: means(measured, factor),
        })
    }

    /// Measured minus simulated under `input`, which is this record's own or one with restarts.
    pub fn residual<'r>(
        &'r self,
        model: &'r Model,
        input: &'r Input,
        settings: &IdentifySettings,
    ) -> TighteningResidual<'r> {
        let unscored = settings.unscored_samples.div_ceil(self.factor);
        let quantity = settings.fitted_output;
        let scoring = Scoring::new(quantity, input, None, unscored);
        TighteningResidual::new(model, input, &self.measured, quantity, scoring)
            .expect("torque and output have the same means")
    }

    /// The ends of decimated fits from `starts` that are worth a fit of every sample; `None` where no fit has one.
    pub async fn try_from<'a>(
        &'a self,
        starts: &[Vec<f64>],
        task: &'a FitTask<'a>,
        set: &Constraints,
        settings: &IdentifySettings,
        simulator: &BatchSimulator<'a>,
    ) -> Result<Option<Tried>, SolveError> {
        let residual = self.residual(&task.model, &self.input, settings);
        let solver = coarse_solver(settings, SMOOTHED_TOLERANCE);
        let (ends, work) =
            fit_starts(&residual, starts, set, &solver, STOP_SMOOTHED, simulator).await?;
        let starts = apart(ends, MOST_DECIMATED_ENDS);
        Ok((!starts.is_empty()).then_some(Tried { starts, work }))
    }
}

/// A decimated record's torque with restarts from the measured motion.
fn along_motion(input: Input, angle_rad: &[f64], velocity_rad_per_s: &[f64]) -> Input {
    input.with_restarts(APART, motions_at(angle_rad, velocity_rad_per_s, APART))
}

/// Settings of a fit that need not go far.
pub(crate) fn coarse_solver(settings: &IdentifySettings, tolerance: f64) -> Settings {
    Settings {
        gradient_tolerance: tolerance.max(settings.solver.gradient_tolerance),
        max_iterations: MOST_STEPS.min(settings.solver.max_iterations),
        ..settings.solver.clone()
    }
}

/// Of `ends`, lowest first, one of every minimum whose cost is worth it, at most so many.
pub(crate) fn apart(mut ends: Vec<Fit>, most: usize) -> Vec<Vec<f64>> {
    ends.retain(|end| end.cost.is_finite());
    ends.dedup_by(|next, kept| (next.cost / kept.cost - 1.0).abs() < SAME_MINIMUM);
    let lowest = ends.first().map_or(f64::NAN, |end| end.cost);
    let worthy = ends
        .into_iter()
        .filter(|end| end.cost <= COST_RATIO_LIMIT * lowest);
    worthy.map(|end| end.values).take(most).collect()
}
