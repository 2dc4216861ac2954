//! Whether the size of an effect differs between groups of tightenings: asked of a fit with one size for all, then tried.
//!
//! With g_i and S_i the projected gradient and curvature of a tightening over the effect's sizes (Rao's score test): a group
//! wants to move by δ = S_G⁻¹ Σ g, and all groups together lower the squared residual by Q = Σ gᵀδ. Under one size for all
//! Q over the scatter within the groups is χ² with a degree of freedom less for each size than there are groups.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use crate::pooled::sharing::Groups;
use crate::ranking::paired_gain::{clearness, gains};
use crate::ranking::thresholds::{CANDIDATE, CLEARLY, GROUPINGS_TRIED};
use crate::settings::DiagnoseSettings;
use snug_least_squares::matrix::inner_product as dot;
use snug_model::Effect;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// What groups of one factor would make of the size of an effect that all share so far.
struct Promise<'g> {
    groups: &'g Groups,
    /// Q: by how much the squared residual would fall.
    gain: f64,
    /// Chance of as much where all have the same size.
    p: f64,
}

/// The fit with the sizes of `effect` by group, by the factor that explains most, where that plainly explains more in
/// tightenings that took no part than one size for all; `family` is how many effects are asked.
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
    let places = fitted.places_that_may_differ(effect);
    let least = fitted.smallest_gain(settings) * fitted.squares();
    let level = settings.level / (family.max(1) * groupings.len().max(1)) as f64;
    let mut promises: Vec<Promise<'_>> = (groupings.iter())
        .filter_map(|groups| promise(fitted, &places, groups))
        .filter(|promise| promise.gain > least && promise.p <= level)
        .collect();
    promises.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    promises.truncate(GROUPINGS_TRIED);
    // Of those that explain as much the coarsest.
    promises.sort_by_key(|promise| promise.groups.levels.len());
    let mut best: Option<Fitted> = None;
    for promise in promises {
        let sharing = fitted.sharing.with(effect, Some(promise.groups.factor));
        let mut pooled = PooledModel::shared_by(cases, &fitted.effects, &sharing)?;
        let start = fitted.start(&pooled);
        let Ok(end) = pooled.fit(&start, &CANDIDATE) else {
            continue;
        };
        let several = Fitted::new(&pooled, end, &clusters);
        if explains_more(best.as_ref().unwrap_or(fitted), &several, least) {
            best = Some(several);
        }
    }
    Ok(best)
}

/// By how much the squared residual would fall at most if sizes of `effect` differed between the groups of one factor.
pub(crate) fn promised(fitted: &Fitted, effect: Effect, groupings: &[Groups]) -> f64 {
    let places = fitted.places_that_may_differ(effect);
    let promises = groupings
        .iter()
        .filter_map(|groups| promise(fitted, &places, groups));
    promises.map(|promise| promise.gain).fold(0.0, f64::max)
}

/// Whether `several` explains plainly more than `one` in tightenings that took no part.
pub(crate) fn explains_more(one: &Fitted, several: &Fitted, least: f64) -> bool {
    let gains = gains(&one.heldout_beyond_torque_noise(), several);
    gains.iter().sum::<f64>() > least && clearness(&gains, several.scale()) > CLEARLY
}

/// Q of `groups` over the sizes at `places`.
fn promise<'g>(fitted: &Fitted, places: &[usize], groups: &'g Groups) -> Option<Promise<'g>> {
    let (mut gain, mut within) = (0.0, 0.0);
    let mut counted = 0;
    for members in groups.members() {
        let (curvature, gradient) = fitted.of_sizes(&members, places)?;
        let Some(shift) = curvature.solve_scaled(&gradient) else {
            continue;
        };
        let shift: Vec<f64> = shift.iter().map(|step| -step).collect();
        gain -= 2.0 * dot(&gradient, &shift) + curvature.quadratic(&shift);
        for &member in &members {
            let (own, mut left) = fitted.of_sizes(&[member], places)?;
            for (row, left) in left.iter_mut().enumerate() {
                *left += (0..shift.len())
                    .map(|j| own.at(row, j) * shift[j])
                    .sum::<f64>();
            }
            let step = own.solve_scaled(&left).unwrap_or_default();
            within += step
                .iter()
                .zip(&left)
                .map(|(step, left)| step * left)
                .sum::<f64>();
            counted += 1;
        }
    }
    let (sizes, of_groups) = (places.len() as f64, groups.levels.len() as f64);
    let scatter = within / (sizes * (counted as f64 - of_groups)).max(1.0);
    let noise = fitted.scale().max(scatter);
    let freedom = sizes * (of_groups - 1.0);
    let p = ChiSquared::new(freedom).map_or(1.0, |chi| chi.sf(gain / noise));
    Some(Promise { groups, gain, p })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, close, noisy, quick};
    use snug_campaign::Factor;
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
            Some(Factor::Participant)
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
            .map(|one| one.factor)
            .collect();
        assert!(
            asked.starts_with(&[Factor::Participant, Factor::Joint]),
            "{asked:?}"
        );
        assert!(!asked.contains(&Factor::Strategy) && !asked.contains(&Factor::Pace));
    }
}
