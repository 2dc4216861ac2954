//! Starts led along the measured motion: every few milliseconds the simulation takes up the measured angle and velocity.
//!
//! No error grows beyond the next restart, so the cost is smooth, and a few steps lead from far away to where the laws agree
//! with the motion that was measured (multiple shooting with known states). If the effect is really at work, the lowest valley
//! of the free run lies close by. If it is not, that is one valley of many.

use crate::batch::Simulator;
use crate::identify::{IdentifySettings, Subject};
use crate::multistart::decimated::{RoughRecord, Tried, WORTH, apart, rough_solver};
use crate::multistart::early_stopping::{Rules, race};
use snug_least_squares::{Constraints, SolveError};
use snug_model::Input;

/// Rough samples from one restart to the next, some 3 ms: enough for a law to show in the velocity.
const APART: usize = 4;
/// A guided fit has gone far enough when this share of the residual could still be removed.
const TOLERANCE: f64 = 0.1;
/// Most ends that go on freely.
const MOST_ENDS: usize = 3;
/// Of the race between guided fits.
const RULES: Rules = Rules {
    heat: 8,
    worth: WORTH,
};

/// Tries `starts` along the measured motion, and what that leads to on the rough record without guidance; `None` where
/// nothing guides.
pub(crate) async fn try_guided<'a>(
    rough: &'a RoughRecord,
    subject: &Subject<'a>,
    starts: &[Vec<f64>],
    set: &Constraints,
    settings: &IdentifySettings,
    simulator: &Simulator<'a>,
) -> Result<Option<Tried>, SolveError> {
    let Some(guided) = &rough.guided else {
        return Ok(None);
    };
    let residual = rough.residual(subject.model, guided, settings);
    let solver = rough_solver(settings, TOLERANCE);
    let (ends, work) = race(&residual, starts, set, &solver, RULES, simulator).await?;
    let ends = apart(ends, MOST_ENDS);
    let mut tried = rough
        .try_from(&ends, subject, set, settings, simulator)
        .await?;
    if let Some(tried) = &mut tried {
        tried.work.add(&work);
    }
    Ok(tried)
}

/// A rough record's torque with restarts from the measured motion.
pub(crate) fn along_motion(input: Input, angle_rad: &[f64], velocity_rad_per_s: &[f64]) -> Input {
    input.with_restarts(APART, motions_at(angle_rad, velocity_rad_per_s, APART))
}

/// Angle \[rad\] and velocity \[rad/s\] at every `apart`th sample, to restart a simulation from.
pub fn motions_at(angle_rad: &[f64], velocity_rad_per_s: &[f64], apart: usize) -> Vec<[f64; 2]> {
    let motions = angle_rad.iter().zip(velocity_rad_per_s).step_by(apart);
    motions
        .map(|(angle, velocity)| [*angle, *velocity])
        .collect()
}
