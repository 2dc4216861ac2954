//! Whether a machine's recordings begin in motion, or away from where an encoder reads nothing: then how each begins is no effect to be
//! looked for, but part of how it is simulated, as mass, damping and stiffness are.

use crate::study::Study;
use crate::study::beginning::{ANGLE, BEGINS};
use crate::tasks::cases::with_settled;
use snug_campaign::Quantity;
use snug_identify::{FitTask, SpectralStart, begin_elsewhere, begin_in_motion};
use snug_model::ParameterSettings;
use std::f64::consts::TAU;

/// The study with every recording beginning as it moves then, and its recordings; `None` where none of them begins in motion, as far as
/// that shows, or the model cannot be simulated so.
///
/// Where a spring is so soft that no recording sees the mass swing on it once, a constant force of it at the angle of the start is no
/// spring: that angle is held at 0 then, unless it is measured, and is another. Such a rig rests wherever it is left, and where an encoder
/// reads nothing is no matter of it.
pub(super) fn moving<'a>(
    study: &Study,
    cases: &'a [FitTask<'_>],
    start: Option<&SpectralStart>,
) -> Option<(Study, Vec<FitTask<'a>>)> {
    let is_told = |name: &String| name == BEGINS.name();
    let base = start.map(|start| start.values);
    let swings = start.is_some_and(|start| swings(start, cases));
    let is_elsewhere = !swings && begin_elsewhere(cases);
    if study.model.effects.iter().any(is_told) || !(is_elsewhere || begin_in_motion(cases, base)) {
        return None;
    }
    let mut study = study.clone();
    study.model.effects.insert(0, BEGINS.name().to_owned());
    // What no torque moves and swings was pulled out to an angle.
    let is_pulled =
        |case: &FitTask<'_>| case.is_undriven() && case.quantity() == Quantity::Displacement;
    if !swings && !is_elsewhere && !cases.iter().all(is_pulled) {
        let held = ParameterSettings {
            value: Some(0.0),
            fixed: true,
            ..ParameterSettings::default()
        };
        let parameters = &mut study.model.parameters;
        parameters.entry(ANGLE.to_owned()).or_insert(held);
    }
    let cases = with_settled(&study, cases.iter().map(FitTask::lent).collect()).ok()?;
    cases.iter().all(can_be_simulated).then_some((study, cases))
}

/// Whether the mass swings on the spring within the longest of the recordings.
pub(super) fn swings(start: &SpectralStart, cases: &[FitTask<'_>]) -> bool {
    let [mass, _, stiffness] = start.values;
    TAU * (mass / stiffness).sqrt() < longest_s(cases)
}

/// How long the longest of the recordings lasts \[s\].
pub(super) fn longest_s(cases: &[FitTask<'_>]) -> f64 {
    cases.iter().map(FitTask::lasts_s).fold(0.0, f64::max)
}

/// Whether step by step, as no model without effects has to be, the model can be simulated from where it begins.
fn can_be_simulated(case: &FitTask<'_>) -> bool {
    let values: Vec<f64> = case.model.parameters().iter().map(|p| p.value).collect();
    case.squares_left(&case.model, &values)
        .is_ok_and(f64::is_finite)
}
