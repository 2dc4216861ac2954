//! Which effects of the catalogue can act on the rig at all.

use crate::data::machine::is_machine;
use crate::error::DiagnoseError;
use crate::library::terms;
use crate::pooled::fitted::Fitted;
use crate::ranking::kin::{are_kin, is_of_all};
use crate::ranking::thresholds::FEW_TURNS;
use snug_campaign::Quantity;
use snug_identify::{FitTask, begin_in_motion};
use snug_model::{ActsOn, BASE_PARAMETERS, Effect, Kind, Law};
use std::f64::consts::TAU;

/// The effects that may be missing beside `current`.
pub(crate) fn candidates(
    cases: &[FitTask<'_>],
    current: &Fitted,
    custom: &[Effect],
) -> Result<Vec<Effect>, DiagnoseError> {
    let case = &cases[0];
    let compared = case.quantity();
    let only_this = cases.iter().all(|case| case.quantity() == compared);
    let all = Effect::ALL.iter().filter(|&&effect| can_act(effect, case));
    let mut all = all
        .map(|&effect| case.model.scale().effect(effect, case.model.rig()))
        .collect::<Result<Vec<Effect>, _>>()?;
    all.retain(|effect| !(only_this && effect.same_as(compared).is_some()));
    all.retain(|effect| !(cases.len() == 1 && effect.of_all().is_some()));
    all.extend(custom);
    all.extend(terms(case.model.scale(), case.model.rig())?);
    // What goes with the angle of a machine is told by the catalogue, where the angle is known: a weight on an arm, or what comes again
    // with every turn.
    let knows_angle = case.tightening.motion.displacement_rad.is_some();
    all.retain(|effect| !(is_machine(case) && knows_angle && effect.name() == "sine_law"));
    let rests = begins_at_rest(cases, current);
    all.retain(|effect| !(rests && effect.sets_initial_motion()));
    all.retain(|effect| !current.effects.contains(effect));
    // Of a few long records kin of what is there may come in its place, not beside it: dry friction with a shape is one friction.
    let has_kin = |effect: &Effect| current.effects.iter().any(|&one| are_kin(one, *effect));
    all.retain(|effect| !(current.are_stretches() && has_kin(effect)));
    all.retain(|&effect| can_stand_beside(&current.effects, effect, case));
    Ok(all)
}

/// Whether a machine's speed is measured and is none at the first sample, and no spring swings that could begin elsewhere: what a start in
/// motion would explain then is a constant force of each recording, as a spring that is none has at an angle of thousands of turns.
fn begins_at_rest(cases: &[FitTask<'_>], current: &Fitted) -> bool {
    let is_speed = |case: &FitTask<'_>| is_machine(case) && case.quantity() == Quantity::Velocity;
    let swings = |(member, case): (usize, &FitTask<'_>)| {
        let named = current.all_named(member);
        let value = |index: usize| {
            let found = named
                .iter()
                .find(|(name, _)| name == BASE_PARAMETERS[index]);
            found.map_or(case.model.parameters()[index].value, |(_, value)| *value)
        };
        TAU * (value(0) / value(2)).sqrt() < case.lasts_s()
    };
    cases.iter().all(is_speed)
        && !begin_in_motion(cases, None)
        && !cases.iter().enumerate().any(swings)
}

/// Whether `effect` can be told beside these, and a simulation can carry it: it has states and parameters for so many only. A law that bends
/// to a little of everything would take the rest of any other.
pub(crate) fn can_stand_beside(others: &[Effect], effect: Effect, case: &FitTask<'_>) -> bool {
    let is_one_of = |&other: &Effect| is_of_all(other, effect) || is_of_all(effect, other);
    let is_mechanical = |other: &Effect| other.description().kind == Kind::Mechanical;
    let takes_theirs = effect.is_general() && others.iter().any(is_mechanical);
    let first = effect.beside();
    !takes_theirs
        && !others.iter().any(is_one_of)
        && first.is_none_or(|first| others.iter().any(|other| other.name() == first))
        && case.model_with(&[others, &[effect]].concat()).is_ok()
}

/// Whether `effect` could be what a measurement like `case` shows.
///
/// Every effect says on which rigs it acts; a machine has no muscles and nerves; what an accelerometer does wrong is not in a
/// displacement that was measured by itself; and a simulation that takes up the measured motion begins with it, and with what is wrong
/// with the zero of a displacement.
pub(crate) fn can_act(effect: Effect, case: &FitTask<'_>) -> bool {
    let description = effect.description();
    let has_accelerometer = case.quantity() == Quantity::Acceleration
        || case.tightening.motion.acceleration_rad_per_s2.is_some();
    let is_taken_up = effect.sets_initial_motion()
        || (effect.shifts_the_zero() && case.quantity() == Quantity::Displacement);
    let is_set = is_taken_up && case.input.is_restarted();
    let is_here = match description.acts_on {
        ActsOn::Hands => !is_machine(case),
        ActsOn::Machines => is_machine(case),
        ActsOn::MachinesOfFewTurns => is_machine(case) && makes_few_turns(case),
        _ => true,
    };
    let is_of_another = match description.kind {
        Kind::Muscular => is_machine(case),
        Kind::Measurement => !has_accelerometer && description.of_accelerometer(),
        _ => false,
    };
    is_here && !is_of_another && !is_set
}

/// Whether the measured angle stays within a few turns; where none was measured, nobody knows.
fn makes_few_turns(case: &FitTask<'_>) -> bool {
    let angle_rad = case.tightening.motion.get(Quantity::Displacement);
    let finite = angle_rad.into_iter().flatten().filter(|a| a.is_finite());
    let reached = finite
        .map(|&a| (a, a))
        .reduce(|(low, high), (a, _)| (low.min(a), high.max(a)));
    reached.is_some_and(|(low, high)| high - low < FEW_TURNS * TAU)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{RIG, SAMPLES, exact};
    use snug_model::{Model, Scale};
    use std::borrow::Cow;

    fn names(case: FitTask<'static>) -> Vec<&'static str> {
        let current = Fitted::made_up(&[], &[1.0], SAMPLES);
        let all = candidates(&[case], &current, &[]).expect("the rig is one");
        all.iter().map(Effect::name).collect()
    }

    fn machine(turns: f64) -> FitTask<'static> {
        let mut case = exact(0, &[], &[]);
        let scale = Scale::Rig {
            torque_nm: 10.0,
            angle_rad: 0.03,
            time_s: 0.04,
        };
        let model = Model::scaled(RIG, &[], scale).expect("the rig is one");
        case.model = Cow::Owned(model);
        let angle = &mut case.tightening.to_mut().motion.displacement_rad;
        let last = angle.as_mut().and_then(|angle| angle.last_mut());
        *last.expect("it was measured") = turns * TAU;
        case
    }

    const OF_MACHINES: [&str; 3] = [
        "second_mode",
        "gravity_torque",
        "asymmetric_viscous_friction",
    ];

    #[test]
    fn a_general_law_stands_beside_sensors_and_no_other_mechanics() {
        let case = machine(0.1);
        let can_come = |others: &[Effect]| can_stand_beside(others, Effect::GeneralBoucWen, &case);
        assert!(can_come(&[]) && can_come(&[Effect::TorqueOffset]));
        assert!(!can_come(&[Effect::TorqueOffset, Effect::CubicStiffness]));
        assert!(can_stand_beside(
            &[Effect::GeneralBoucWen],
            Effect::CubicStiffness,
            &case
        ));
    }

    /// With every candidate more, what is missing must be clearer to be named.
    #[test]
    fn tightenings_by_hand_have_no_candidates_of_machines() {
        let names = names(exact(0, &[], &[]));
        assert!(OF_MACHINES.iter().all(|name| !names.contains(name)));
        assert!(names.contains(&"directional_damping") && names.contains(&"torque_ripple"));
    }

    #[test]
    fn on_machines_friction_by_direction_is_a_drive_s_and_a_weight_is_told_by_the_catalogue() {
        let names = names(machine(0.5));
        assert!(OF_MACHINES.iter().all(|name| names.contains(name)));
        assert!(!names.contains(&"directional_damping") && !names.contains(&"sine_law"));
    }

    #[test]
    fn a_drive_that_makes_many_turns_has_no_weight_on_an_arm_but_a_ripple() {
        let names = names(machine(50.0));
        assert!(!names.contains(&"gravity_torque") && !names.contains(&"sine_law"));
        assert!(names.contains(&"torque_ripple"));
    }
}
