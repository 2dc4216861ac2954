//! Whether a machine's recordings begin in motion, or away from where an encoder reads nothing: then how each begins is no effect to be
//! looked for, but part of how it is simulated, as mass, damping and stiffness are.

use crate::study::Study;
use crate::tasks::cases::with_settled;
use snug_campaign::{Quantity, Tightening};
use snug_identify::{FitTask, SpectralStart, begin_elsewhere, begin_in_motion};
use snug_model::{Effect, Model, ModelSettings, ParameterSettings};
use std::f64::consts::TAU;

/// The effect that says how a recording begins, its angle and its speed.
const BEGINS: Effect = Effect::InitialMotion;
const ANGLE: &str = "theta0_rad";
const SPEED: &str = "omega0_rad_per_s";

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

/// Lets the first angle and speed of `model`, if it has them and the study does not say where they begin, begin as they were measured, and
/// reach as far around that as they otherwise would around 0.
pub(crate) fn as_measured(model: &mut Model, tightening: &Tightening, settings: &ModelSettings) {
    if !model.effects().any(|effect| effect == BEGINS) {
        return;
    }
    for (name, quantity) in [(ANGLE, Quantity::Displacement), (SPEED, Quantity::Velocity)] {
        let told = settings.parameters.get(name);
        let measured = tightening.motion.get(quantity).and_then(<[f64]>::first);
        let mut all = model.parameters_mut().iter_mut();
        let Some((first, parameter)) = measured.zip(all.find(|one| one.name == name)) else {
            continue;
        };
        if told.is_none() && !parameter.fixed && first.is_finite() {
            parameter.value = *first;
            parameter.minimum = parameter.minimum.min(first + parameter.minimum);
            parameter.maximum = parameter.maximum.max(first + parameter.maximum);
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::Rig;

    const RIG: Rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };

    fn begun(settings: &ModelSettings, angle_rad: f64) -> Vec<[f64; 3]> {
        let tightening = Tightening::from_torque(RIG, 1e-3, vec![0.0; 3])
            .with(Quantity::Displacement, vec![angle_rad; 3]);
        let mut model = Model::new(RIG, &[BEGINS]).expect("the rig is one");
        as_measured(&mut model, &tightening, settings);
        let own = model.parameters().iter().skip(3);
        own.map(|one| [one.value, one.minimum, one.maximum])
            .collect()
    }

    /// 12 rad, around which as much is allowed as otherwise around 0; of the speed nothing is measured.
    #[test]
    fn a_recording_begins_where_it_was_measured() {
        let settings = ModelSettings::default();
        let (usual, found) = (begun(&settings, 0.0), begun(&settings, 12.0));
        assert_eq!(usual[0][0], 0.0);
        assert_eq!(found[0], [12.0, usual[0][1], 12.0 + usual[0][2]]);
        assert_eq!(found[1], usual[1]);
    }

    #[test]
    fn what_the_study_says_of_it_stays() {
        let mut settings = ModelSettings::default();
        let told = ParameterSettings::default();
        settings.parameters.insert(ANGLE.to_owned(), told);
        assert_eq!(begun(&settings, 12.0)[0][0], 0.0);
    }
}
