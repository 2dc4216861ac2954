//! A rig that pushes itself away from where it would rest, as an upright pendulum or an armature near a magnet does: it stays only because a
//! controller holds it, and no stiffness of 0 or more follows it.
//!
//! A controller answers the motion, so that input and output go against each other, as with an input of the wrong sign. The equation of
//! motion tells the two apart: of a wrong sign the inertia would be negative, of such a rig the stiffness is.

use crate::pooled::equation::PlainEquation;
use crate::pooled::fitted::Fitted;
use crate::ranking::applicability::can_act;
use crate::verdict::thresholds::{IS_A_WEIGHT, MOSTLY_EXPLAINED, NEEDS_IT, NEEDS_IT_BESIDE_LAWS};
use snug_campaign::words::suspicion::PushesAway;
use snug_identify::{ConstraintKind, FitTask, MotionEquation, Term};
use snug_model::{BASE_PARAMETERS, Effect, Law};
use std::borrow::Cow;

/// What brings a rig back that pushes itself away near its zero only, as one does that has two places of rest.
const BRINGS_BACK: [Effect; 2] = [Effect::QuadraticStiffness, Effect::CubicStiffness];

/// What a plain regression says of a rig that pushes itself away; `None` of any other, and where it explains too little.
pub(crate) fn pushed_away(cases: &[FitTask<'_>]) -> Option<PushesAway> {
    told(cases, &[], NEEDS_IT).or_else(|| told(cases, &BRINGS_BACK, NEEDS_IT_BESIDE_LAWS))
}

/// The same of a regression with these effects, where one without a negative stiffness must leave so many times as much.
fn told(cases: &[FitTask<'_>], effects: &[Effect], needs_it: f64) -> Option<PushesAway> {
    let regressed = |to: &[ConstraintKind]| {
        let cases = constrained(cases, to);
        let PlainEquation { equation, .. } = PlainEquation::beside(&cases, effects)?;
        let terms = effects.iter().map(|&effect| of_size_1(&equation, effect));
        equation.fit(&terms.collect::<Option<Vec<Term>>>()?)
    };
    let free = regressed(&[])?;
    let [mass, _, stiffness] = free.base;
    if stiffness >= 0.0 || free.explained < MOSTLY_EXPLAINED {
        return None;
    }
    let kept = regressed(&[ConstraintKind::Positive]).map_or(0.0, |held| held.explained);
    let names = BASE_PARAMETERS.iter().map(|name| (*name).to_owned());
    (1.0 - kept > needs_it * (1.0 - free.explained)).then(|| PushesAway {
        effects: effects.iter().map(|one| one.name().to_owned()).collect(),
        promised: free.explained,
        sizes: names.zip(free.base).collect(),
        falls_in_s: falls_in_s(&cases[0], [mass, stiffness]),
    })
}

/// Time in which a rig with this mass \[kg\] and stiffness \[N/m\] falls away to e times as far, undamped \[s\]: √((I + m l²) / −k l²). NaN
/// where a spring brings it back.
pub(crate) fn falls_in_s(case: &FitTask<'_>, [mass, stiffness]: [f64; 2]) -> f64 {
    let rig = case.model.rig();
    let square = rig.lever_arm_m * rig.lever_arm_m;
    ((rig.known_inertia_kg_m2 + mass * square) / (-stiffness * square)).sqrt()
}

/// Whether of a rig that pushes itself away this study would hold the stiffness back to 0 or more, though a free run does not follow it: what
/// effects make of that is no rig, unless it [is a weight on an arm](is_a_weight).
pub(crate) fn may_be_held_back(cases: &[FitTask<'_>], own: &Fitted) -> bool {
    own.effects.is_empty()
        && cases.iter().all(|case| case.input.is_restarted())
        && !may_push_away(cases)
}

/// Whether the sine of the angle in place of a stiffness leaves far less of the measured acceleration, beside dry friction and an offset: a
/// weight on an arm that stands upright. Of a motion too small for that both leave the same.
pub(crate) fn is_a_weight(cases: &[FitTask<'_>]) -> bool {
    let can_act = |case: &FitTask<'_>| can_act(Effect::GravityTorque, case);
    if !cases.iter().all(can_act) {
        return false;
    }
    let free = constrained(cases, &[]);
    let no_spring: Vec<FitTask<'_>> = free.iter().map(without_stiffness).collect();
    let left = |equation: &MotionEquation<'_>, effects: &[Effect]| {
        let terms = effects.iter().map(|&effect| of_size_1(equation, effect));
        let found = equation.fit(&terms.flatten().collect::<Vec<Term>>())?;
        Some(1.0 - found.explained)
    };
    let told_apart = || {
        let PlainEquation { equation, plain } = PlainEquation::of(&free)?;
        let of_a_stiffness = left(&equation, &plain)?;
        let same_averages = MotionEquation::averaged(&no_spring, equation.half_width)?;
        let of_a_weight = left(
            &same_averages,
            &[&plain[..], &[Effect::GravityTorque]].concat(),
        )?;
        tracing::debug!(of_a_weight, of_a_stiffness, "a weight that stands upright");
        Some(of_a_weight < IS_A_WEIGHT * of_a_stiffness)
    };
    told_apart().unwrap_or(false)
}

fn without_stiffness<'a>(case: &'a FitTask<'_>) -> FitTask<'a> {
    let mut case = case.lent();
    let mut model = case.model.clone().into_owned();
    for parameter in model
        .parameters_mut()
        .iter_mut()
        .filter(|one| one.name == BASE_PARAMETERS[2])
    {
        (parameter.fixed, parameter.value) = (true, 0.0);
    }
    case.model = Cow::Owned(model);
    case
}

/// What an effect does whose first parameter is 1 and all others 0.
fn of_size_1(equation: &MotionEquation<'_>, effect: Effect) -> Option<Term> {
    let mut size = vec![0.0; effect.description().parameters.len()];
    *size.first_mut()? = 1.0;
    equation.term(effect, &size)
}

/// Whether a fit of these recordings could have a stiffness below 0.
pub(crate) fn may_push_away(cases: &[FitTask<'_>]) -> bool {
    cases.iter().all(|case| {
        let constraints = &case.settings.constraints;
        !constraints.contains(&ConstraintKind::Positive)
            && !constraints.contains(&ConstraintKind::Stable)
    })
}

fn constrained<'a>(cases: &'a [FitTask<'_>], to: &[ConstraintKind]) -> Vec<FitTask<'a>> {
    let constrained = cases.iter().map(|case| {
        let mut case = case.lent();
        let mut settings = case.settings.clone().into_owned();
        settings.constraints = to.to_vec();
        case.settings = Cow::Owned(settings);
        case
    });
    constrained.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::{Intersample, Quantity, Rig, Tightening};
    use snug_identify::IdentifySettings;
    use snug_model::{Input, Model};

    const RIG: Rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };
    const INTERVAL_S: f64 = 1e-3;

    /// Two sines, and the torque that moves this inertia, damping and stiffness so.
    fn moved(base: [f64; 3], torque_unit: f64) -> FitTask<'static> {
        moved_against(base, 1.0, torque_unit, |angle| base[2] * angle)
    }

    /// The same in so many of another unit's angles, with another law in place of the stiffness.
    fn moved_against(
        base: [f64; 3],
        angle_unit: f64,
        torque_unit: f64,
        law: impl Fn(f64) -> f64,
    ) -> FitTask<'static> {
        let (mut torque_nm, mut angle_rad) = (Vec::new(), Vec::new());
        for sample in 0..6000 {
            let (x, y) = (
                5.0 * f64::from(sample) * INTERVAL_S,
                11.0 * f64::from(sample) * INTERVAL_S,
            );
            let angle = x.sin() + 0.5 * y.sin();
            let velocity = 5.0 * x.cos() + 5.5 * y.cos();
            let acceleration = -25.0 * x.sin() - 60.5 * y.sin();
            let torque = base[0] * acceleration + base[1] * velocity + law(angle);
            torque_nm.push(torque_unit * torque);
            angle_rad.push(angle_unit * angle);
        }
        let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
        let tightening = Tightening::from_torque(RIG, INTERVAL_S, torque_nm);
        let scale = snug_model::Scale::Rig {
            torque_nm: 10.0,
            angle_rad: 1.0,
            time_s: 0.1,
        };
        FitTask {
            tightening: Cow::Owned(tightening.with(Quantity::Displacement, angle_rad)),
            input: Cow::Owned(input),
            model: Cow::Owned(Model::scaled(RIG, &[], scale).expect("the rig is one")),
            settings: Cow::Owned(IdentifySettings {
                fitted_output: Quantity::Displacement,
                constraints: vec![ConstraintKind::Positive],
                ..IdentifySettings::default()
            }),
        }
    }

    #[test]
    fn an_upright_pendulum_pushes_itself_away() {
        let found = pushed_away(&[moved([0.4, 1.9, -30.0], 1.0)]).expect("it does");
        for ((_, found), made) in found.sizes.iter().zip([0.4, 1.9, -30.0]) {
            assert!((found / made - 1.0).abs() < 0.01, "{found} for {made}");
        }
        let expected = (0.4_f64 / 30.0).sqrt();
        assert!((found.falls_in_s / expected - 1.0).abs() < 0.01);
    }

    /// Play of any width, told as a cube and a stiffness, leaves 3.4 times as much or less without a stiffness below 0.
    #[test]
    fn what_has_two_places_of_rest_pushes_itself_away_and_what_has_play_does_not() {
        let against = |law: &dyn Fn(f64) -> f64| {
            pushed_away(&[moved_against([0.4, 1.9, 0.0], 1.0, 1.0, law)])
        };
        let found = against(&|angle| -30.0 * angle + 50.0 * angle.powi(3)).expect("it does");
        assert_eq!(found.effects, ["quadratic_stiffness", "cubic_stiffness"]);
        assert!((found.sizes[2].1 / -30.0 - 1.0).abs() < 0.02, "{found:?}");
        for gap in [0.3, 0.6, 0.8, 0.9, 1.0, 1.1, 1.2] {
            let play = |angle: f64| 60.0 * (angle - angle.clamp(-gap, gap));
            assert_eq!(against(&play), None, "{gap}");
        }
        assert_eq!(against(&|angle| 10.0 * angle + 50.0 * angle.powi(3)), None);
    }

    /// An arm of inertia 0.3 kg m² on a lever of 0.5 m, √((0.3 + 0.4 · 0.25) / (30 · 0.25)) s.
    #[test]
    fn what_is_known_of_the_inertia_slows_the_fall() {
        let mut case = moved([0.4, 1.9, -30.0], 1.0);
        let rig = Rig {
            lever_arm_m: 0.5,
            known_inertia_kg_m2: 0.3,
        };
        let scale = case.model.scale();
        case.model = Cow::Owned(Model::scaled(rig, &[], scale).expect("the rig is one"));
        let found = falls_in_s(&case, [0.4, -30.0]);
        assert!((found - (0.4_f64 / 7.5).sqrt()).abs() < 1e-12);
        assert!(falls_in_s(&case, [0.4, 30.0]).is_nan());
    }

    #[test]
    fn a_spring_does_not_nor_one_whose_torque_has_the_other_sign() {
        assert_eq!(pushed_away(&[moved([0.4, 1.9, 30.0], 1.0)]), None);
        assert_eq!(pushed_away(&[moved([0.4, 1.9, 30.0], -1.0)]), None);
        assert_eq!(pushed_away(&[moved([0.4, 1.9, 0.0], 1.0)]), None);
    }

    #[test]
    fn a_weight_is_told_by_the_sine_of_the_angle_in_whatever_unit_that_is_none() {
        let base = [0.4, 1.9, -30.0];
        let weight = |angle: f64| -30.0 * angle.sin();
        assert!(is_a_weight(&[moved_against(base, 1.0, 1.0, weight)]));
        for unit in [1e-6, 1.0, 1e6] {
            let magnet = |angle: f64| -30.0 * angle * (1.0 + 0.1 * angle * angle);
            assert!(!is_a_weight(&[moved_against(base, unit, 1.0, magnet)]));
            let straight = |angle: f64| -30.0 * angle;
            assert!(!is_a_weight(&[moved_against(base, unit, 1.0, straight)]));
        }
    }
}
