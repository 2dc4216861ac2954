//! Whether the size of an effect differs between groups of tightenings: asked of a fit with one size for all, then tried.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use crate::pooled::sharing::Groups;
use crate::ranking::by_time;
use crate::ranking::paired_gain::{clearness, gains};
use crate::ranking::score_of_groups::{Promise, promise};
use crate::ranking::thresholds::{CANDIDATE, CLEARLY, GROUPINGS_TRIED, LIKELIER};
use crate::settings::DiagnoseSettings;
use snug_campaign::Factor;
use snug_model::Effect;

/// The fit with the sizes of `effect` by group, by the factor that explains most, where that plainly explains more in
/// tightenings that took no part than one size for all; `family` is how many effects are asked.
///
/// Of conditions that explain as much the one with fewest groups is taken; a part of the campaign's time only where it is far likelier
/// than any condition, and single files only where they plainly explain more than that.
pub(crate) fn by_group(
    cases: Cases<'_>,
    fitted: &Fitted,
    effect: Effect,
    groupings: &[Groups],
    family: usize,
    clusters: Clusters,
    settings: &DiagnoseSettings,
) -> Result<Option<Fitted>, DiagnoseError> {
    if !clusters.are_whole() || fitted.sharing.factor(effect).is_some() {
        return Ok(None);
    }
    let least = fitted.smallest_gain(settings) * fitted.squares();
    let level = settings.level / (family.max(1) * groupings.len().max(1)) as f64;
    let promises = promises(cases, fitted, effect, groupings)
        .into_iter()
        .filter(|promise| promise.gain > least && promise.p <= level);
    let mut best: Option<Fitted> = None;
    for promise in worth_fitting(promises.collect()) {
        let factor = Some(promise.groups.factor.clone());
        let sharing = fitted.sharing.with(effect, factor);
        let mut pooled = PooledModel::shared_by(cases, &fitted.effects, &sharing)?;
        let start = fitted.start(&pooled);
        let Ok(end) = pooled.fit(&start, &CANDIDATE) else {
            continue;
        };
        let several = Fitted::new(&pooled, end, &clusters);
        let is_better = match &best {
            Some(by_condition) if promise.groups.factor.is_of_time() && several.is_weighted => {
                is_likelier(by_condition, &several, cases.len())
            }
            best => explains_more(best.as_ref().unwrap_or(fitted), &several, least),
        };
        if is_better {
            best = Some(several);
        }
    }
    Ok(best)
}

/// The most promising groupings by conditions and files, and one by time where that is worth more than any by a condition, in the
/// order in which they are tried.
fn worth_fitting(promises: Vec<Promise>) -> Vec<Promise> {
    let (of_time, mut others): (Vec<Promise>, Vec<Promise>) = promises
        .into_iter()
        .partition(|promise| promise.groups.factor.is_of_time());
    let conditions = others
        .iter()
        .filter(|promise| promise.groups.factor != Factor::File);
    let of_conditions = conditions.map(|promise| promise.worth).fold(0.0, f64::max);
    others.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    others.truncate(GROUPINGS_TRIED);
    let of_time = of_time
        .into_iter()
        .max_by(|a, b| a.worth.total_cmp(&b.worth));
    others.extend(of_time.filter(|promise| promise.worth > of_conditions));
    let order = |promise: &Promise| match &promise.groups.factor {
        Factor::File => (2, promise.groups.levels.len()),
        factor => (u8::from(factor.is_of_time()), promise.groups.levels.len()),
    };
    others.sort_by_key(order);
    others
}

/// By how much the squared residual would fall at most if sizes of `effect` differed between the groups of one factor.
pub(crate) fn promised(
    cases: Cases<'_>,
    fitted: &Fitted,
    effect: Effect,
    groupings: &[Groups],
) -> f64 {
    let promises = promises(cases, fitted, effect, groupings).into_iter();
    promises.map(|promise| promise.gain).fold(0.0, f64::max)
}

/// What each of the groupings would make of the sizes of `effect`, and the best by time.
fn promises(
    cases: Cases<'_>,
    fitted: &Fitted,
    effect: Effect,
    groupings: &[Groups],
) -> Vec<Promise> {
    let places = fitted.places_that_may_differ(effect);
    let by_condition = groupings
        .iter()
        .filter_map(|groups| promise(fitted, &places, groups.clone(), 1));
    by_condition
        .chain(by_time::promises(&cases, fitted, &places))
        .collect()
}

/// Whether a change at one of so many places is likelier than groups of a condition: by squared residuals over the noise, two for each
/// size more and twice the logarithm of the places (Akaike). A condition that is off by a few tightenings is wrong in these alone, which
/// a mean over all of them does not show.
fn is_likelier(by_condition: &Fitted, of_time: &Fitted, places: usize) -> bool {
    let noise = of_time.scale().max(1.0);
    let cost = |fitted: &Fitted| fitted.squares() / noise + 2.0 * fitted.shared.len() as f64;
    cost(by_condition) - cost(of_time) - 2.0 * (places as f64).ln() > LIKELIER
}

/// Whether `several` explains plainly more than `one` in tightenings that took no part.
pub(crate) fn explains_more(one: &Fitted, several: &Fitted, least: f64) -> bool {
    let gains = gains(&one.heldout_beyond_torque_noise(), several);
    gains.iter().sum::<f64>() > least && clearness(&gains, several.scale()) > CLEARLY
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, close, noisy, quick};
    use snug_identify::FitTask;
    use snug_model::Effect::CubicStiffness;

    /// Twelve tightenings of three people, whose springs stiffen as much as this.
    fn people(sizes: [f64; 3]) -> Vec<FitTask<'static>> {
        (0..12)
            .map(|number| {
                let person = number % 3;
                let mut case = noisy(number, &[CubicStiffness], &[sizes[person]]);
                let conditions = &mut case.tightening.to_mut().conditions;
                conditions.participant = Some(format!("TP{}", person + 1));
                case
            })
            .collect()
    }

    /// The fit by group, if the data ask for it.
    fn asked(cases: &[FitTask<'_>]) -> Option<Fitted> {
        let tally = Tally::default();
        let counted = Cases::new(cases, &tally);
        let one = fit_effects(counted, &[CubicStiffness], None, WHOLE).expect("it can be fitted");
        let groupings = Groups::worth_trying(cases);
        let settings = quick(99);
        by_group(
            counted,
            &one,
            CubicStiffness,
            &groupings,
            1,
            WHOLE,
            &settings,
        )
        .expect("it can be fitted")
    }

    #[test]
    fn sizes_that_differ_between_people_are_found_each_with_its_own() {
        let cases = people([2e6, 0.0, 4e6]);
        let fitted = asked(&cases).expect("they differ");
        assert_eq!(
            fitted.sharing.factor(CubicStiffness),
            Some(&Factor::Participant)
        );
        for (found, truth) in fitted.shared.iter().zip([2e6, 0.0, 4e6]) {
            close(found + 1e6, truth + 1e6, 0.05);
        }
        assert!(fitted.is_at_floor(), "{}", fitted.error());
    }

    #[test]
    fn one_size_for_all_stays_one() {
        assert!(asked(&people([2e6; 3])).is_none());
    }

    /// Two of each person, alike in every joint: strategy says the same as joint and is not asked again, pace is not known.
    #[test]
    fn factors_are_asked_that_group_and_group_differently() {
        let mut cases = people([2e6; 3]);
        for (number, case) in cases.iter_mut().enumerate() {
            let conditions = &mut case.tightening.to_mut().conditions;
            conditions.joint = Some(["Soft", "Hard"][number % 2].to_owned());
            conditions.strategy = Some(["QS", "TT"][number % 2].to_owned());
        }
        let asked: Vec<Factor> = Groups::worth_trying(&cases)
            .iter()
            .map(|one| one.factor.clone())
            .collect();
        assert!(
            asked.starts_with(&[Factor::Participant, Factor::Joint]),
            "{asked:?}"
        );
        assert!(!asked.contains(&Factor::Strategy) && !asked.contains(&Factor::Pace));
    }
}
