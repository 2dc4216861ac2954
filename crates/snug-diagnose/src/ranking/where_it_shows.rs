//! An effect that only some people, joints or tools have: looked for in those tightenings that the model fits badly, then asked of
//! all.
//!
//! Where it shows there is much of it, so that its size and shape are found, which one size for all, mostly for those without it,
//! would lead astray.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::data::watch::Watch;
use crate::error::DiagnoseError;
use crate::pooled::fit::{fit_effects, fit_part};
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use crate::pooled::parameter_place::effect_of;
use crate::ranking::paired_gain::gains;
use crate::ranking::refit::{Way, possible, refit};
use crate::ranking::score_test::{Control, Scorer};
use crate::ranking::shows::Shows;
use crate::ranking::thresholds::{BEST, CANDIDATE};
use crate::settings::DiagnoseSettings;
use rayon::prelude::*;
use snug_model::{Effect, Law};

/// The best of `effects` with a size for each group, found in those groups in which it shows that `current` leaves more than noise.
pub(super) fn best_where_it_shows(
    cases: Cases<'_>,
    current: &Fitted,
    effects: &[Effect],
    shows: &Shows,
    clusters: Clusters,
    settings: &DiagnoseSettings,
    watch: &Watch<'_>,
) -> Result<Vec<(Effect, Fitted)>, DiagnoseError> {
    let part = cases.some(&shows.members);
    let there = cases.others(&part);
    let of_part = fit_part(there, &shows.members, current, clusters)?;
    let pooled = PooledModel::shared_by(there, &of_part.effects, &of_part.sharing)?;
    let control = Control {
        campaigns: 0,
        seed: settings.seed,
    };
    let columns = Scorer::new(&pooled, &of_part, clusters, control)
        .score(effects)?
        .columns;
    let heldout = of_part.heldout_beyond_torque_noise();
    type Gaining = Option<(f64, Effect, Fitted)>;
    let found: Vec<Result<Gaining, DiagnoseError>> = effects
        .par_iter()
        .map(|&effect| {
            watch.go_on()?;
            let fitted = refit(
                there,
                &of_part,
                effect,
                &columns,
                Way::Far(None),
                clusters,
                settings,
            );
            let gain = |fitted: &Fitted| gains(&heldout, fitted).iter().sum::<f64>();
            Ok(possible(fitted)?.map(|fitted| (gain(&fitted), effect, fitted)))
        })
        .collect();
    let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut found: Vec<(f64, Effect, Fitted)> = found.into_iter().flatten().collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.truncate(BEST);
    let of_all: Vec<Result<Option<(Effect, Fitted)>, DiagnoseError>> = found
        .into_par_iter()
        .map(|(_, effect, fitted)| {
            watch.go_on()?;
            let fitted = fit_effects(there, &fitted.effects, Some(&fitted), clusters)?;
            let of_all = asked_of_all(cases, current, effect, &fitted, shows, clusters);
            Ok(possible(of_all)?.map(|of_all| (effect, of_all)))
        })
        .collect();
    let of_all = of_all.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(of_all.into_iter().flatten().collect())
}

/// The fit of `effect` to all tightenings, a size for each group: from what was found where it shows, and nothing of it elsewhere.
fn asked_of_all(
    cases: Cases<'_>,
    current: &Fitted,
    effect: Effect,
    found: &Fitted,
    shows: &Shows,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let factor = Some(shows.groups.factor.clone());
    let sharing = current.sharing.with(effect, factor);
    let mut pooled = PooledModel::shared_by(cases, &found.effects, &sharing)?;
    let mut start = current.start(&pooled);
    for (own, &member) in found.own.iter().zip(&shows.members) {
        start.own[member].clone_from(own);
    }
    let there = found.start_of(&pooled, &[]).shared;
    let specs = effect.description().parameters;
    for (place, size) in pooled.shared.iter().enumerate() {
        let Some((_, offset)) =
            effect_of(&pooled.effects, size.index).filter(|(of, _)| *of == effect)
        else {
            continue;
        };
        let group = size.level.as_ref().and_then(|level| {
            let mut levels = shows.groups.levels.iter();
            levels.position(|known| known == level)
        });
        let parameter = &pooled.models[0].parameters()[size.index];
        let nothing = specs[offset].vanishes_at;
        start.shared[place] = match (group, nothing) {
            (Some(group), Some(nothing)) if !shows.in_group[group] => {
                nothing.clamp(parameter.minimum, parameter.maximum)
            }
            _ => there[place],
        };
    }
    let end = pooled.fit(&start, &CANDIDATE)?;
    Ok(Fitted::new(&pooled, end, &clusters))
}
