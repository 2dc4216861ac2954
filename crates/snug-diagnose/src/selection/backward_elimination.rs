//! After the selection: whether each added term is still needed, and what would do in its place.

use crate::error::DiagnoseError;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::ranking::kin::is_simpler;
use crate::ranking::paired_gain::{clearness, gains};
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::{Addition, SelectionPath, justified, least_share, leaves_more};
use crate::selection::simpler::does_for;
use crate::selection::thresholds::{EQUAL, PLAINLY_BETTER, SMALL};
use snug_campaign::words::statement::Fate;
use snug_model::Effect;

/// Tries to do without each added term once.
pub(crate) fn try_removals(
    selection: &ModelSelection<'_>,
    path: &mut SelectionPath,
) -> Result<(), DiagnoseError> {
    if path.additions.len() < 2 {
        return Ok(());
    }
    for added in path.additions.clone() {
        let effect = added.effect;
        let full = path.last().clone();
        let Some(without) = without(selection, &full, effect)? else {
            path.needs(effect);
            continue;
        };
        let losses = gains(&without.heldout_beyond_torque_noise(), &full);
        let loss = lost(&losses, &full, &without);
        let hardly_matters = loss / full.squares() < without.smallest_gain(selection.settings);
        let is_chance = clearness(&losses, full.scale()) < 1.0;
        let stands_in = || is_stand_in(selection, path, &added, [loss, without.squares()]);
        let fate = match hardly_matters || is_chance {
            true => Fate::PredictsAsWell,
            false if stands_in() => Fate::StandsIn,
            false => Fate::Stays,
        };
        match fate {
            Fate::Stays => path.keep(effect, loss),
            fate => path.take_out(effect, without, loss, fate),
        }
    }
    if path.attempts.iter().any(|one| one.fate != Fate::Stays) {
        selection.rank_last(path)?;
        // Why nothing came in beside what is gone does not say why nothing does beside the rest.
        let next = justified(
            &path.ranking,
            path.last(),
            &path.rungs[0],
            selection.settings,
        );
        path.stopped = next.err().or(path.stopped);
    }
    Ok(())
}

/// `full` without `effect`, from where it ended; `None` where that cannot be run.
pub(super) fn without(
    selection: &ModelSelection<'_>,
    full: &Fitted,
    effect: Effect,
) -> Result<Option<Fitted>, DiagnoseError> {
    let doing = format!("trying to do without {}", effect.name());
    selection.watch.begin(&doing)?;
    let mut effects = full.effects.clone();
    effects.retain(|known| *known != effect);
    Ok(fit_effects(selection.cases, &effects, Some(full), selection.clusters).ok())
}

/// What held-out clusters lose of `full` without an effect. Of stretches, as what they gain: no more than the error rises.
fn lost(losses: &[f64], full: &Fitted, without: &Fitted) -> f64 {
    let loss: f64 = losses.iter().sum();
    match full.are_stretches() {
        true => loss.min(without.squares() - full.squares()),
        false => loss,
    }
}

/// Whether an effect without which so much is lost, in all and of what is left `without` it, would not have come in: where the noise is not
/// known, what takes next to nothing.
pub(super) fn is_trifle(
    selection: &ModelSelection<'_>,
    path: &SelectionPath,
    effect: Effect,
    lost: [f64; 2],
) -> bool {
    let of_all = lost[0] / path.rungs[0].squares();
    is_part(selection, path, lost) && of_all < least_share(effect)
}

/// Whether that is no more than a part of what is left where the noise is not known.
fn is_part(
    selection: &ModelSelection<'_>,
    path: &SelectionPath,
    [loss, without]: [f64; 2],
) -> bool {
    !path.last().is_weighted && loss < selection.settings.of_the_rest() * without
}

/// The same, or little of a motion that stays one. It bends to a law that is not there, unless it is the dry friction that every rig has: that
/// of a trolley was found to 1 % while what its load swings further than a spring lets it was left.
fn is_stand_in(
    selection: &ModelSelection<'_>,
    path: &SelectionPath,
    added: &Addition,
    lost: [f64; 2],
) -> bool {
    let of_all = lost[0] / path.rungs[0].squares();
    let is_small = added.share_of_first.max(of_all) < SMALL;
    let is_dry_friction = added.effect.name() == Effect::CoulombFriction.name();
    let leaves_a_motion = || path.last().leaves_a_motion(selection.cases);
    let bends = || is_small && !is_dry_friction && leaves_a_motion();
    is_trifle(selection, path, added.effect, lost) || is_part(selection, path, lost) && bends()
}

/// Puts for each added effect a simpler one that does as well in its place beside the others: while another was missing, the richer
/// explained some of that, too. Of one that stands alone its kin were compared as it was chosen. Of few long records it may have been fitted
/// since to be the simpler one, which from elsewhere is not found.
pub(crate) fn prefer_simpler(
    selection: &ModelSelection<'_>,
    path: &mut SelectionPath,
) -> Result<(), DiagnoseError> {
    let are_whole = selection.clusters.are_whole();
    if path.additions.len() < 2 && are_whole {
        return Ok(());
    }
    let mut is_changed = false;
    for place in 0..path.additions.len() {
        let rich = path.additions[place].effect;
        let full = path.last().clone();
        let heldout = full.heldout_beyond_torque_noise();
        for simple in selection.in_place_of(rich, &full, is_simpler)? {
            let swapped = selection.with_other(&full, rich, simple)?;
            let does = |one: &Fitted| match are_whole {
                true => is_as_good(selection, &full, &heldout, one),
                false => does_for(one, &full, &path.rungs[0]),
            };
            let Some(swapped) = swapped.filter(does) else {
                continue;
            };
            let addition = &mut path.additions[place];
            addition.effect = simple;
            addition.twins.retain(|twin| *twin != simple);
            addition.twins.insert(0, rich);
            path.replace_last(swapped);
            is_changed = true;
            break;
        }
    }
    if is_changed {
        selection.rank_last(path)?;
    }
    Ok(())
}

/// Keeps of each added effect's twins those that still do as well in its place beside the others. Of few long records one that does plainly
/// better takes the place.
///
/// While another effect was missing, many seemed to explain equally much.
pub(crate) fn look_at_twins_again(
    selection: &ModelSelection<'_>,
    path: &mut SelectionPath,
) -> Result<(), DiagnoseError> {
    if path.additions.len() < 2 {
        return Ok(());
    }
    let mut is_changed = false;
    for place in 0..path.additions.len() {
        let mut twins = as_good(selection, path, place)?;
        if let Some((twin, settled)) = better_twin(selection, path, place, &twins)? {
            path.additions[place].effect = twin;
            path.replace_last(settled);
            twins = as_good(selection, path, place)?;
            is_changed = true;
        }
        path.additions[place].twins = twins.into_iter().map(|(twin, _)| twin).collect();
    }
    if is_changed {
        selection.rank_last(path)?;
    }
    Ok(())
}

/// Twins of the effect that was added at this `place` that do as well in its place beside the others, and with what model.
fn as_good(
    selection: &ModelSelection<'_>,
    path: &SelectionPath,
    place: usize,
) -> Result<Vec<(Effect, Fitted)>, DiagnoseError> {
    let (full, addition) = (path.last(), &path.additions[place]);
    let heldout = full.heldout_beyond_torque_noise();
    let others = addition
        .twins
        .iter()
        .filter(|twin| !full.effects.contains(twin));
    let mut found = Vec::new();
    for &twin in others {
        let swapped = selection.with_other(full, addition.effect, twin)?;
        let as_good = swapped.filter(|one| is_as_good(selection, full, &heldout, one));
        found.extend(as_good.map(|swapped| (twin, swapped)));
    }
    Ok(found)
}

/// The best of these `twins`, with its model settled, where the last model does plainly worse with the effect at this `place`, of few long
/// records. No richer one for which that does: one load of three recordings was told another in each, the same but for less than its error.
fn better_twin(
    selection: &ModelSelection<'_>,
    path: &SelectionPath,
    place: usize,
    twins: &[(Effect, Fitted)],
) -> Result<Option<(Effect, Fitted)>, DiagnoseError> {
    if selection.clusters.are_whole() {
        return Ok(None);
    }
    let least = (twins.iter()).min_by(|(_, a), (_, b)| a.squares().total_cmp(&b.squares()));
    let (full, effect) = (path.last(), path.additions[place].effect);
    let does = |twin: Effect, rich: &Fitted| {
        is_simpler(effect, twin) && does_for(full, rich, &path.rungs[0])
    };
    let is_better = |(twin, one): &&(Effect, Fitted)| {
        one.squares() < PLAINLY_BETTER * full.squares() && !does(*twin, one)
    };
    let Some((twin, fitted)) = least.filter(is_better) else {
        return Ok(None);
    };
    let settled = selection.settled(fitted)?;
    let heldout = settled.heldout_beyond_torque_noise();
    let is_worse = !is_as_good(selection, &settled, &heldout, full);
    Ok(is_worse.then_some((*twin, settled)))
}

/// Whether `swapped` explains hardly less than `full` of tightenings that took no part; `heldout` is what `full` leaves of them.
fn is_as_good(
    selection: &ModelSelection<'_>,
    full: &Fitted,
    heldout: &[f64],
    swapped: &Fitted,
) -> bool {
    let lost: Vec<f64> = gains(heldout, swapped).iter().map(|gain| -gain).collect();
    clearness(&lost, full.scale()) < EQUAL
        && !leaves_more(swapped, full, &lost, &selection.clusters)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::selection::path::Addition;
    use crate::tests::made_up::{
        WHOLE, custom_force, machine_with_friction, noisy, quick, with_selection,
    };
    use snug_identify::FitTask;
    use snug_model::Effect::{
        CoulombFriction, CubicStiffness, QuadraticDamping, StribeckFriction, TorqueDelay,
        TorqueOffset,
    };

    /// Runs `look` on a selection that added `effects` to the base model of tightenings with a spring that stiffens and a torque
    /// that reads too much.
    fn after_selection<T>(
        effects: &[Effect],
        twins: &[Effect],
        look: impl FnOnce(&ModelSelection<'_>, &mut SelectionPath) -> T,
    ) -> T {
        let made_with: [(Effect, f64); 2] = [(CubicStiffness, 2e6), (TorqueOffset, 0.5)];
        after_selection_of(made_with, effects, twins, look)
    }

    /// The same of tightenings with these.
    fn after_selection_of<T>(
        made_with: [(Effect, f64); 2],
        effects: &[Effect],
        twins: &[Effect],
        look: impl FnOnce(&ModelSelection<'_>, &mut SelectionPath) -> T,
    ) -> T {
        let (made_with, sizes) = (
            made_with.map(|(effect, _)| effect),
            made_with.map(|(_, size)| size),
        );
        let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, &made_with, &sizes)).collect();
        with_selection(&cases, &quick(99), |selection| {
            let fitted =
                fit_effects(selection.cases, effects, None, WHOLE).expect("it can be fitted");
            let mut path = SelectionPath::only(fitted);
            path.additions = (effects.iter())
                .map(|&effect| Addition {
                    effect,
                    p_family: 0.01,
                    heldout_gain: 0.1,
                    share_of_first: 0.1,
                    twins: twins.to_vec(),
                })
                .collect();
            look(selection, &mut path)
        })
    }

    #[test]
    fn a_term_that_the_data_do_without_is_taken_out_and_the_others_stay() {
        let added = [CubicStiffness, QuadraticDamping, TorqueOffset];
        after_selection(&added, &[], |selection, path| {
            try_removals(selection, path).expect("it can be fitted");
            let attempts: Vec<(Effect, bool)> = path
                .attempts
                .iter()
                .map(|one| (one.effect, one.fate != Fate::Stays))
                .collect();
            let expected = [
                (CubicStiffness, false),
                (QuadraticDamping, true),
                (TorqueOffset, false),
            ];
            assert_eq!(attempts, expected);
            assert_eq!(path.last().effects, [CubicStiffness, TorqueOffset]);
            let left: Vec<Effect> = path.additions.iter().map(|one| one.effect).collect();
            assert_eq!(left, [CubicStiffness, TorqueOffset]);
            assert_eq!(path.rungs.len(), 2, "what was left in is no new rung");
            assert!(
                !path.ranking.candidates.is_empty(),
                "the last model was ranked against"
            );
            for attempt in &path.attempts {
                let share = attempt.loss / path.rungs[0].squares();
                assert!(
                    (attempt.growth / share - 1.0).abs() < 0.05,
                    "a share of what is left"
                );
            }
        });
    }

    #[test]
    fn the_only_term_is_not_tried() {
        after_selection(&[CubicStiffness], &[TorqueOffset], |selection, path| {
            let before = selection.cases.tally().done();
            try_removals(selection, path).expect("nothing is fitted");
            look_at_twins_again(selection, path).expect("nothing is fitted");
            assert_eq!(selection.cases.tally().done(), before);
            assert!(path.attempts.is_empty());
            assert_eq!(path.additions[0].twins, [TorqueOffset]);
        });
    }

    /// 2 p x³ is a cubic spring under another name: in its place beside the others it does exactly as well. A delay does not,
    /// and what is in the model already is nobody's twin.
    #[test]
    fn only_twins_that_do_as_well_beside_the_others_are_kept() {
        let again = custom_force("cubic_again", "2*p*x^3", 0.0);
        let twins = [TorqueOffset, again, TorqueDelay];
        after_selection(
            &[CubicStiffness, TorqueOffset],
            &twins,
            |selection, path| {
                look_at_twins_again(selection, path).expect("it can be fitted");
                assert_eq!(path.additions[0].twins, [again]);
                assert!(
                    path.additions[1].twins.is_empty(),
                    "{:?}",
                    path.additions[1].twins
                );
            },
        );
    }

    /// Dry friction is a friction that goes with the speed in which nothing goes.
    #[test]
    fn dry_friction_is_told_where_a_richer_one_came_in_while_a_spring_was_missing() {
        let made_with = [(CoulombFriction, 4.0), (CubicStiffness, 2e6)];
        let added = [StribeckFriction, CubicStiffness];
        after_selection_of(made_with, &added, &[], |selection, path| {
            prefer_simpler(selection, path).expect("it can be fitted");
            assert_eq!(path.additions[0].effect, CoulombFriction);
            assert_eq!(path.additions[0].twins, [StribeckFriction]);
            assert_eq!(path.last().effects, [CoulombFriction, CubicStiffness]);
            assert!(!path.ranking.candidates.is_empty(), "it was ranked against");
        });
    }

    /// Of an effect that took such a share of the first error as it came in, so many times what is left would be lost; that is a hundredth of
    /// the first error.
    #[test]
    fn a_small_part_of_a_motion_that_stays_one_is_a_stand_in() {
        let cases = [machine_with_friction(3.0)];
        with_selection(&cases, &quick(9), |selection| {
            let left = fit_effects(selection.cases, &[], None, WHOLE).expect("it can be fitted");
            assert!(left.leaves_a_motion(selection.cases));
            let squares = left.squares();
            let mut path = SelectionPath::only(left);
            path.rungs.insert(
                0,
                Fitted::made_up(&[], &[100.0 * squares], 100).unweighted(),
            );
            let added = |share_of_first| Addition {
                effect: QuadraticDamping,
                p_family: 0.01,
                heldout_gain: 0.3,
                share_of_first,
                twins: Vec::new(),
            };
            let stands_in = |path: &SelectionPath, share: f64, times: f64| {
                let loss = times * squares;
                is_stand_in(selection, path, &added(share), [loss, loss + squares])
            };
            assert!(stands_in(&path, 0.02, 0.5), "a third of the rest");
            assert!(!stands_in(&path, 0.02, 2.0), "two thirds of the rest");
            assert!(!stands_in(&path, 0.2, 0.5), "it took a fifth as it came in");
            assert!(stands_in(&path, 0.2, 0.05), "half a thousandth of all");
            path.rungs[1] = Fitted::made_up(&[], &[squares], 100);
            assert!(!stands_in(&path, 0.02, 0.5), "the noise is known");
        });
    }

    #[test]
    fn stretches_lose_no_more_than_the_error_rises() {
        let fitted = |squares| Fitted::made_up(&[], &[squares; 8], 100).unweighted();
        let [full, without] = [fitted(1.0), fitted(1.5)];
        assert_eq!(lost(&[1.0; 8], &full, &without), 8.0);
        let [full, without] = [full, without].map(Fitted::in_stretches);
        assert_eq!(lost(&[1.0; 8], &full, &without), 4.0);
        assert_eq!(lost(&[0.125; 8], &full, &without), 1.0);
    }
}
