//! After the climb: whether each added term is still needed, and what would do in its place.

use crate::error::DiagnoseError;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::ranking::paired_gain::clearness;
use crate::ranking::rank::gains;
use crate::selection::path::{Attempt, Climb, EQUAL, leaves_more};
use crate::selection::search::Search;
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
