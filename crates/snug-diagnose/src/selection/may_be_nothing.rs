//! What may be nothing beside the other effects, and goes.

use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::{BesideNothing, beside_nothing};
use crate::ranking::paired_gain::gains;
use crate::ranking::rank::is_all_size;
use crate::ranking::thresholds::PLAINLY_MISSED;
use crate::selection::backward_elimination::{is_trifle, without};
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::SelectionPath;
use snug_campaign::words::statement::Fate;
use snug_model::Effect;

/// Takes out what may be nothing beside the others, the interval of its size says: it stood in for what has come in since. Where of
/// several each may be nothing, they stand in for each other, and the one without which least is lost goes first. What has no shape and is
/// missed plainly is not nothing, whatever its interval says; what has no interval and would not have come in for what it takes is. Of fewer
/// additions than `least` none is looked at.
pub(crate) fn take_out_what_may_be_nothing(
    selection: &ModelSelection<'_>,
    path: &mut SelectionPath,
    least: usize,
) -> Result<(), DiagnoseError> {
    while path.additions.len() >= least {
        let full = path.last().clone();
        let mut least: Option<(Effect, Fitted, Fate)> = None;
        for effect in path.additions.iter().map(|one| one.effect) {
            let told = beside_nothing(&selection.cases, &full, effect);
            let is_unknown = told == BesideNothing::Unknown;
            if told == BesideNothing::Told || is_unknown && full.is_weighted {
                continue;
            }
            let Some(without) = without(selection, &full, effect)? else {
                continue;
            };
            let loss = without.squares() - full.squares();
            let fate = match told {
                BesideNothing::Held => {
                    let is_missed =
                        is_all_size(effect) && without.squares() > PLAINLY_MISSED * full.squares();
                    (!is_missed).then_some(Fate::MayBeNothing)
                }
                _ => is_trifle(selection, path, effect, [loss, without.squares()])
                    .then_some(Fate::PredictsAsWell),
            };
            let known = least
                .as_ref()
                .map_or(f64::INFINITY, |(_, one, _)| one.squares());
            if let Some(fate) = fate.filter(|_| without.squares() < known) {
                least = Some((effect, without, fate));
            }
        }
        let Some((effect, without, fate)) = least else {
            return Ok(());
        };
        let losses = gains(&without.heldout_beyond_torque_noise(), &full);
        let loss = losses.iter().sum();
        path.take_out(effect, without, loss, fate);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::clusters::Clusters;
    use crate::pooled::fit::fit_effects;
    use crate::selection::backward_elimination::try_removals;
    use crate::selection::path::Addition;
    use crate::tests::made_up::{WHOLE, machine_with_friction, noisy, quick, with_selection};
    use snug_identify::FitTask;
    use snug_model::Effect::{CubicStiffness, QuadraticDamping, SecondMode, TorqueOffset};

    fn added(effect: Effect) -> Addition {
        Addition {
            effect,
            p_family: 0.01,
            heldout_gain: 0.1,
            share_of_first: 0.1,
            twins: Vec::new(),
        }
    }

    /// What took little as it came in, for others stood in for it, is no small effect where much is lost without it; what may be
    /// nothing beside the others is taken out, whatever it took.
    #[test]
    fn what_stands_in_for_another_is_taken_out_and_what_is_needed_is_not_small() {
        let made_with = [CubicStiffness, TorqueOffset];
        let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, &made_with, &[2e6, 0.5])).collect();
        let effects = [QuadraticDamping, CubicStiffness, TorqueOffset];
        with_selection(&cases, &quick(99), |selection| {
            let fitted = |effects: &[Effect]| fit_effects(selection.cases, effects, None, WHOLE);
            let mut path = SelectionPath::only(fitted(&effects).expect("it can be fitted"));
            path.additions = effects.map(added).to_vec();
            take_out_what_may_be_nothing(selection, &mut path, 2).expect("it can be fitted");
            let left: Vec<Effect> = path.additions.iter().map(|one| one.effect).collect();
            assert_eq!(left, made_with);
            assert_eq!(path.last().effects, left);
            let [attempt] = path.attempts.as_slice() else {
                panic!("one was taken out: {:?}", path.attempts)
            };
            assert!(attempt.fate == Fate::MayBeNothing && attempt.effect == QuadraticDamping);

            path.rungs[0] = fitted(&[]).expect("it can be fitted");
            path.additions[0].share_of_first = 1e-3;
            try_removals(selection, &mut path).expect("it can be fitted");
            let share = path.additions[0].share_of_first;
            assert!(share > 0.1, "{share}");
        });
    }

    /// A second mode of a machine that has none ends damped as much as it may be, and has no interval.
    #[test]
    fn what_has_no_interval_and_takes_nothing_is_taken_out() {
        let mut case = machine_with_friction(0.0);
        let motion = &mut case.tightening.to_mut().motion;
        let speed = motion.velocity_rad_per_s.as_mut();
        let mut state = 1_u64;
        for speed in speed.expect("it was measured") {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            *speed += 0.02 * ((state >> 33) as f64 / 2.0_f64.powi(30) - 1.0);
        }
        let cases = [case];
        with_selection(&cases, &quick(9), |selection| {
            let clusters = Clusters::of(&cases);
            let selection = ModelSelection {
                clusters,
                ..*selection
            };
            let fitted = |effects: &[Effect], from: Option<&Fitted>| {
                fit_effects(selection.cases, effects, from, clusters).expect("it can be fitted")
            };
            let alone = fitted(&[], None);
            // Others took 99 % before.
            let first = Fitted::made_up(&[], &[100.0 * alone.squares()], 100);
            let mut path = SelectionPath::only(first.unweighted());
            path.rungs.push(fitted(&[SecondMode], Some(&alone)));
            path.additions = vec![added(SecondMode)];
            let told = beside_nothing(&cases, path.last(), SecondMode);
            assert_eq!(told, BesideNothing::Unknown);
            take_out_what_may_be_nothing(&selection, &mut path, 1).expect("it can be fitted");
            assert!(path.additions.is_empty() && path.last().effects.is_empty());
            assert_eq!(path.attempts[0].fate, Fate::PredictsAsWell);
        });
    }
}
