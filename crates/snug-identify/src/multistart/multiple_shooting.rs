//! Multiple shooting from measured states: every few milliseconds the simulation takes up the measured angle and velocity.
//!
//! No error grows beyond the next restart, so the cost is smooth, and a few steps lead from far away to where the laws agree
//! with the motion that was measured (multiple shooting with known states). If the effect is really at work, the lowest minimum
//! of the free run lies close by. If it is not, that is one minimum of many.

use crate::batch::BatchSimulator;
use crate::multistart::decimated::{
    COST_RATIO_LIMIT, DecimatedRecord, Tried, apart, coarse_solver,
};
use crate::multistart::early_stopping::{EarlyStopping, fit_starts};
use crate::settings::IdentifySettings;
use crate::task::FitTask;
use snug_least_squares::{Constraints, SolveError};

/// A restarted fit has gone far enough when this share of the residual could still be removed.
const TOLERANCE: f64 = 0.1;
/// Most ends that go on freely.
const MOST_ENDS: usize = 3;
/// When a start along the measured motion is stopped.
const RULES: EarlyStopping = EarlyStopping {
    warm_up_steps: 8,
    cost_ratio_limit: COST_RATIO_LIMIT,
};

/// Tries `starts` along the measured motion, and what that leads to on the decimated record, run freely; `None` where
/// nothing guides.
pub(crate) async fn try_multiple_shooting<'a>(
    decimated: &'a DecimatedRecord,
    task: &'a FitTask<'a>,
    starts: &[Vec<f64>],
    set: &Constraints,
    settings: &IdentifySettings,
    simulator: &BatchSimulator<'a>,
) -> Result<Option<Tried>, SolveError> {
    let Some(restarted) = &decimated.restarted else {
        return Ok(None);
    };
    let residual = decimated.residual(&task.model, restarted, settings);
    let solver = coarse_solver(settings, TOLERANCE);
    let (ends, work) = fit_starts(&residual, starts, set, &solver, RULES, simulator).await?;
    let ends = apart(ends, MOST_ENDS);
    let mut tried = decimated
        .try_from(&ends, task, set, settings, simulator)
        .await?;
    if let Some(tried) = &mut tried {
        tried.work.add(&work);
    }
    Ok(tried)
}
