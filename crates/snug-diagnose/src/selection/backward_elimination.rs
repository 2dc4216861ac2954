//! After the climb: whether each added term is still needed, and what would do in its place.

use crate::error::DiagnoseError;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::ranking::paired_gain::clearness;
use crate::ranking::rank::gains;
use crate::selection::path::{Attempt, Climb, leaves_more};
use crate::selection::search::Search;
use crate::selection::thresholds::EQUAL;
use snug_model::Effect;

/// Tries to do without each added term once.
pub(crate) fn try_removals(search: &Search<'_>, climb: &mut Climb) -> Result<(), DiagnoseError> {
    if climb.additions.len() < 2 {
        return Ok(());
    }
    let added: Vec<Effect> = climb.additions.iter().map(|one| one.effect).collect();
    for effect in added {
        let full = climb.last().clone();
        search
            .watch
            .begin(&format!("trying to do without {}", effect.name()))?;
        let mut effects = full.effects.clone();
        effects.retain(|known| *known != effect);
        // A model that cannot even be run without it needs it.
        let Ok(without) = fit_effects(search.cases, &effects, Some(&full), search.units) else {
            continue;
        };
        let losses = gains(&without.heldout_beyond_torque_noise(), &full);
        let loss: f64 = losses.iter().sum();
        let growth = loss / full.squares();
        let hardly_matters = growth < without.smallest_gain(search.settings);
        let removed = hardly_matters || clearness(&losses, full.scale()) < 1.0;
        climb.attempts.push(Attempt {
            effect,
            removed,
            loss,
            growth,
        });
        if removed {
            climb.additions.retain(|one| one.effect != effect);
            climb.stand_on(without);
        }
    }
    if climb.attempts.iter().any(|attempt| attempt.removed) {
        climb.ranking = search.rank(climb.last(), search.settings.control_campaigns)?;
    }
    Ok(())
}

/// Keeps of each added effect's twins those that still do as well in its place beside the others.
///
/// While another effect was missing, many seemed to explain equally much.
pub(crate) fn look_at_twins_again(
    search: &Search<'_>,
    climb: &mut Climb,
) -> Result<(), DiagnoseError> {
    if climb.additions.len() < 2 {
        return Ok(());
    }
    let full = climb.last().clone();
    let heldout = full.heldout_beyond_torque_noise();
    for addition in &mut climb.additions {
        addition.twins.retain(|twin| !full.effects.contains(twin));
        let mut kept = Vec::new();
        for &twin in &addition.twins {
            search.watch.begin(&format!(
                "trying {} in place of {}",
                twin.name(),
                addition.effect.name()
            ))?;
            if does_as_well(search, &full, &heldout, addition.effect, twin)? {
                kept.push(twin);
            }
        }
        addition.twins = kept;
    }
    Ok(())
}

fn does_as_well(
    search: &Search<'_>,
    full: &Fitted,
    heldout: &[f64],
    effect: Effect,
    twin: Effect,
) -> Result<bool, DiagnoseError> {
    let swap = |known: &Effect| if *known == effect { twin } else { *known };
    let effects: Vec<Effect> = full.effects.iter().map(swap).collect();
    let Ok(swapped) = fit_effects(search.cases, &effects, Some(full), search.units) else {
        return Ok(false);
    };
    let lost: Vec<f64> = gains(heldout, &swapped).iter().map(|gain| -gain).collect();
    Ok(
        clearness(&lost, full.scale()) < EQUAL
            && !leaves_more(&swapped, full, &lost, &search.units),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::made_up::{WHOLE, custom_force, noisy, silent};
    use crate::selection::path::Addition;
    use crate::settings::DiagnoseSettings;
    use snug_identify::FitTask;
    use snug_model::Effect::{CubicStiffness, QuadraticDamping, TorqueDelay, TorqueOffset};

    /// Runs `look` on a climb that added `effects` to the base model of tightenings with a spring that stiffens and a torque
    /// that reads too much.
    fn after_climb<T>(
        effects: &[Effect],
        twins: &[Effect],
        look: impl FnOnce(&Search<'_>, &mut Climb) -> T,
    ) -> T {
        let made_with = [CubicStiffness, TorqueOffset];
        let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, &made_with, &[2e6, 0.5])).collect();
        let (tally, watch) = (Tally::default(), silent());
        let settings = DiagnoseSettings {
            control_campaigns: 0,
            sign_flips: 99,
            starts: 1,
            ..DiagnoseSettings::default()
        };
        let search = Search {
            cases: Cases::new(&cases, &tally),
            own: &[],
            custom: &[],
            units: WHOLE,
            settings: &settings,
            watch: &watch,
        };
        let fitted = fit_effects(search.cases, effects, None, WHOLE).expect("it can be fitted");
        let mut climb = Climb::only(fitted);
        climb.additions = (effects.iter())
            .map(|&effect| Addition {
                effect,
                p_family: 0.01,
                heldout_gain: 0.1,
                twins: twins.to_vec(),
            })
            .collect();
        look(&search, &mut climb)
    }

    #[test]
    fn a_term_that_the_data_do_without_is_taken_out_and_the_others_stay() {
        let added = [CubicStiffness, QuadraticDamping, TorqueOffset];
        after_climb(&added, &[], |search, climb| {
            try_removals(search, climb).expect("it can be fitted");
            let attempts: Vec<(Effect, bool)> = climb
                .attempts
                .iter()
                .map(|one| (one.effect, one.removed))
                .collect();
            let expected = [
                (CubicStiffness, false),
                (QuadraticDamping, true),
                (TorqueOffset, false),
            ];
            assert_eq!(attempts, expected);
            assert_eq!(climb.last().effects, [CubicStiffness, TorqueOffset]);
            let left: Vec<Effect> = climb.additions.iter().map(|one| one.effect).collect();
            assert_eq!(left, [CubicStiffness, TorqueOffset]);
            assert_eq!(climb.rungs.len(), 2, "what was left in is no new rung");
            assert!(
                !climb.ranking.candidates.is_empty(),
                "the last model was ranked against"
            );
            for attempt in &climb.attempts {
                let share = attempt.loss / climb.rungs[0].squares();
                assert!(
                    (attempt.growth / share - 1.0).abs() < 0.05,
                    "a share of what is left"
                );
            }
        });
    }

    #[test]
    fn the_only_term_is_not_tried() {
        after_climb(&[CubicStiffness], &[TorqueOffset], |search, climb| {
            let before = search.cases.tally().done();
            try_removals(search, climb).expect("nothing is fitted");
            look_at_twins_again(search, climb).expect("nothing is fitted");
            assert_eq!(search.cases.tally().done(), before);
            assert!(climb.attempts.is_empty());
            assert_eq!(climb.additions[0].twins, [TorqueOffset]);
        });
    }

    /// 2 p x³ is a cubic spring under another name: in its place beside the others it does exactly as well. A delay does not,
    /// and what is in the model already is nobody's twin.
    #[test]
    fn only_twins_that_do_as_well_beside_the_others_are_kept() {
        let again = custom_force("cubic_again", "2*p*x^3", 0.0);
        let twins = [TorqueOffset, again, TorqueDelay];
        after_climb(&[CubicStiffness, TorqueOffset], &twins, |search, climb| {
            look_at_twins_again(search, climb).expect("it can be fitted");
            assert_eq!(climb.additions[0].twins, [again]);
            assert!(
                climb.additions[1].twins.is_empty(),
                "{:?}",
                climb.additions[1].twins
            );
        });
    }
}
