//! Multiple shooting from measured states: every few milliseconds the simulation takes up the measured angle and velocity.
//!
//! No error grows beyond the next restart, so the cost is smooth, and a few steps lead from far away to where the laws agree
//! with the motion that was measured (multiple shooting with known states). If the effect is really at work, the lowest minimum
//! of the free run lies close by. If it is not, that is one minimum of many.

use crate::batch::BatchSimulator;
use crate::multistart::decimated::{DecimatedRecord, Tried, apart, coarse_solver};
use crate::multistart::early_stopping::{STOP_LED, fit_starts};
use crate::multistart::thresholds::{LED_TOLERANCE, MOST_LED_ENDS};
use crate::settings::IdentifySettings;
use crate::task::FitTask;
use snug_least_squares::{Constraints, SolveError};

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
    let solver = coarse_solver(settings, LED_TOLERANCE);
    let (ends, work) = fit_starts(&residual, starts, set, &solver, STOP_LED, simulator).await?;
    let ends = apart(ends, MOST_LED_ENDS);
    let mut tried = decimated
        .try_from(&ends, task, set, settings, simulator)
        .await?;
    if let Some(tried) = &mut tried {
        tried.work.add(&work);
    }
    Ok(tried)
}
