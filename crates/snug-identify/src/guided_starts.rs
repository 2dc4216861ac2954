//! Starts led along the measured motion: every few milliseconds the simulation takes up the measured angle and velocity.
//!
//! No error grows beyond the next restart, so the cost is smooth, and a few steps lead from far away to where the laws agree
//! with the motion that was measured (multiple shooting with known states). If the effect is really at work, the lowest valley
//! of the free run lies close by. If it is not, that is one valley of many.

use crate::race::{Rules, race};
use crate::rough_starts::{RoughRecord, Tried, WORTH, apart, rough_solver};
use crate::{Constraints, IdentifyError, IdentifySettings, Subject};
use snug_campaign::Quantity;
use snug_model::Input;

/// Rough samples from one restart to the next, some 3 ms: enough for a law to show in the velocity.
const APART: usize = 4;
/// A guided fit has gone far enough when this share of the residual could still be removed.
const TOLERANCE: f64 = 1e-2;
/// Most steps of a guided fit.
const MOST_STEPS: usize = 100;
/// Most ends that go on freely.
const MOST_ENDS: usize = 3;
/// Of the race between guided fits.
const RULES: Rules = Rules {
    heat: 20,
    worth: WORTH,
};

/// Tries `starts` along the measured motion, and what that leads to on the rough record without guidance; `None` where
/// another quantity than the acceleration is fitted, which restarts hide, or the rest of the motion is not known.
pub(crate) fn try_guided(
    rough: &RoughRecord,
    subject: &Subject<'_>,
    starts: &[Vec<f64>],
    set: &Constraints,
    settings: &IdentifySettings,
) -> Result<Option<Tried>, IdentifyError> {
    if settings.fitted_output != Quantity::Acceleration {
        return Ok(None);
    }
    let Some(guided) = along_motion(rough, subject) else {
        return Ok(None);
    };
    let residual = rough.residual(subject.model, &guided, settings);
    let solver = rough_solver(settings, TOLERANCE, MOST_STEPS);
    let (ends, work) = race(&residual, starts, set, &solver, RULES)?;
    let ends = apart(ends, MOST_ENDS);
    let mut tried = rough.try_from(&ends, subject, set, settings)?;
    if let Some(tried) = &mut tried {
        tried.work.add(&work);
    }
    Ok(tried)
}

/// The rough record's torque with restarts from the measured motion.
fn along_motion(rough: &RoughRecord, subject: &Subject<'_>) -> Option<Input> {
    let measured = |quantity| subject.tightening.motion.get(quantity);
    let angle_rad = rough.means_of(measured(Quantity::Displacement)?);
    let velocity_rad_per_s = rough.means_of(measured(Quantity::Velocity)?);
    let motions = motions_at(&angle_rad, &velocity_rad_per_s, APART);
    Some(rough.input.clone().with_restarts(APART, motions))
}

/// Angle \[rad\] and velocity \[rad/s\] at every `apart`th sample, to restart a simulation from.
pub fn motions_at(angle_rad: &[f64], velocity_rad_per_s: &[f64], apart: usize) -> Vec<[f64; 2]> {
    let motions = angle_rad.iter().zip(velocity_rad_per_s).step_by(apart);
    motions
        .map(|(angle, velocity)| [*angle, *velocity])
        .collect()
}
