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
use crate::pooled::sharing::Groups;
use crate::pooled::thresholds::AT_FLOOR;
use crate::ranking::paired_gain::gains;
use crate::ranking::refit::{possible, refit};
use crate::ranking::score_test::{Control, Scorer};
use crate::ranking::thresholds::{BEST, BEYOND_THE_QUIET, CANDIDATE, FEWEST_WHERE_IT_SHOWS};
use crate::settings::DiagnoseSettings;
use rayon::prelude::*;
use snug_model::{Effect, Law};
use snug_statistics::descriptive::{median, standard_deviation};

/// Groups of which some are fitted badly.
#[derive(Debug, PartialEq)]
struct Shows {
    groups: Groups,
    /// Whether a group is one of them.
    in_group: Vec<bool>,
    /// Their tightenings.
    members: Vec<usize>,
}

/// The best of `effects` with a size for each group, found in those groups in which `current` leaves more than noise; nothing where
/// all or none do.
pub(super) fn best_where_it_shows(
    cases: Cases<'_>,
    current: &Fitted,
    effects: &[Effect],
    groupings: &[Groups],
    clusters: Clusters,
    settings: &DiagnoseSettings,
    watch: &Watch<'_>,
) -> Result<Vec<(Effect, Fitted)>, DiagnoseError> {
    let Some(shows) = where_it_shows(current, groupings) else {
        return Ok(Vec::new());
    };
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
            let fitted = refit(there, &of_part, effect, &columns, None, clusters, settings);
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
            let of_all = asked_of_all(cases, current, effect, &fitted, &shows, clusters);
            Ok(possible(of_all)?.map(|of_all| (effect, of_all)))
        })
        .collect();
    let of_all = of_all.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(of_all.into_iter().flatten().collect())
}

/// The groups of the factor that best parts what `current` fits badly from what it fits to the noise: those in which more is left than
/// chance puts between groups, the others together being left at the noise; in the fewest tightenings.
fn where_it_shows(current: &Fitted, groupings: &[Groups]) -> Option<Shows> {
    if !current.is_weighted {
        return None;
    }
    let of_factor = |groups: &Groups| {
        let members = groups.members();
        let left = |members: &Vec<usize>| {
            let blocks = || members.iter().map(|&member| &current.blocks[member]);
            let count = blocks().map(|block| block.count).sum::<usize>().max(1) as f64;
            let squares = blocks().map(|block| block.squares).sum::<f64>();
            (squares / count, count)
        };
        let left: Vec<(f64, f64)> = members.iter().map(left).collect();
        let quiet = left
            .iter()
            .map(|(scale, _)| *scale)
            .fold(f64::INFINITY, f64::min);
        let spread = usual_spread(current, &members)?;
        let by_chance = |count: usize| BEYOND_THE_QUIET * spread / (count as f64).sqrt();
        let in_group: Vec<bool> = (left.iter().zip(&members))
            .map(|((scale, _), members)| *scale > quiet + by_chance(members.len()))
            .collect();
        let rest = left.iter().zip(&in_group).filter(|(_, shows)| !**shows);
        let (squares, count) = rest.fold((0.0, 0.0), |(squares, all), ((scale, count), _)| {
            (squares + scale * count, all + count)
        });
        let is_rest_quiet = squares < AT_FLOOR * AT_FLOOR * count;
        let members: Vec<usize> = (0..groups.of.len())
            .filter(|&member| in_group[groups.of[member]])
            .collect();
        let parts = members.len() >= FEWEST_WHERE_IT_SHOWS
            && members.len() < groups.of.len()
            && is_rest_quiet;
        parts.then(|| Shows {
            groups: groups.clone(),
            in_group,
            members,
        })
    };
    let all = groupings.iter().filter_map(of_factor);
    all.min_by_key(|shows| (shows.members.len(), shows.groups.levels.len()))
}

/// Standard deviation of the tightenings' mean squares within a group, the median over groups: of the noise each knows a little more
/// or less than it has. `None` where no group has two.
fn usual_spread(current: &Fitted, groups: &[Vec<usize>]) -> Option<f64> {
    let scale = |&member: &usize| {
        let block = &current.blocks[member];
        block.squares / block.count.max(1) as f64
    };
    let of_group = |members: &Vec<usize>| {
        let scales: Vec<f64> = members.iter().map(scale).collect();
        standard_deviation(&scales).ok()
    };
    let spreads: Vec<f64> = groups.iter().filter_map(of_group).collect();
    median(&spreads).ok()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::exact;
    use snug_campaign::Factor;
    use snug_identify::FitTask;

    /// Twelve tightenings of three people under two joints that leave these mean squares.
    fn of(left: impl Fn(usize, usize) -> f64) -> Option<Shows> {
        let mut cases: Vec<FitTask> = (0..12).map(|number| exact(number, &[], &[])).collect();
        let mut squares = Vec::new();
        for (number, case) in cases.iter_mut().enumerate() {
            let (person, joint) = (number % 3, number / 3 % 2);
            let conditions = &mut case.tightening.to_mut().conditions;
            conditions.participant = Some(format!("TP{person}"));
            conditions.joint = Some(["Soft", "Hard"][joint].to_owned());
            squares.push(100.0 * left(person, joint));
        }
        let current = Fitted::made_up(&[], &squares, 100);
        where_it_shows(&current, &Groups::worth_trying(&cases))
    }

    #[test]
    fn people_who_fit_badly_are_where_it_shows() {
        let shows = of(|person, _| if person == 1 { 1.5 } else { 1.0 }).expect("one does");
        assert_eq!(shows.groups.factor, Factor::Participant);
        assert_eq!(shows.members, [1, 4, 7, 10]);
        let shows = of(|_, joint| if joint == 1 { 1.5 } else { 1.0 }).expect("one does");
        assert_eq!(shows.groups.factor, Factor::Joint);
        assert_eq!(shows.members.len(), 6);
    }

    #[test]
    fn where_all_fit_badly_or_none_there_is_no_such_place() {
        assert_eq!(of(|_, _| 1.0), None);
        assert_eq!(of(|person, _| 1.2 + person as f64), None);
    }
}
