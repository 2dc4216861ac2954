//! Every candidate scored, refitted and held out; best first.

mod taken_up;

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::data::watch::{Pieces, Watch};
use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::pooled::long_record;
use crate::pooled::model::PooledModel;
use crate::pooled::sharing::Groups;
use crate::pooled::sizes::{BesideNothing, beside_nothing};
use crate::ranking::by_group::{by_group, explains_more, promised};
use crate::ranking::first_ranking::first_ranking;
use crate::ranking::max_t::Family;
use crate::ranking::paired_gain::{chance, clearness, gains, spread_of_sum};
use crate::ranking::pairs::{Pair, promising_pairs};
use crate::ranking::refit::{Way, followed, possible, refit};
use crate::ranking::score_test::{Control, Scored, Scorer};
use crate::ranking::sensitivity::Column;
use crate::ranking::shows::where_it_shows;
use crate::ranking::thresholds::{
    BEST, BEST_BY_GROUP, BEST_OF_LONG, CONTROL_FLIPS, MOST_OF_ALL, PLAINLY_MISSED, SHAPES_TRIED,
    STRICTER,
};
use crate::ranking::where_it_shows::best_where_it_shows;
use crate::settings::DiagnoseSettings;
use rayon::prelude::*;
use snug_identify::FitTask;
use snug_model::{Effect, Law};
use taken_up::look_beside_restarts;

/// A candidate after its refit.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub effect: Effect,
    /// T of its best column.
    pub score: f64,
    pub p_family: f64,
    pub fitted: Fitted,
    /// Decrease of the squared residual of each cluster with sizes that were fixed without it.
    pub gains: Vec<f64>,
    /// Whether its size has an interval that excludes nothing.
    pub is_told_from_nothing: bool,
    /// Whether it explains what another motion at restarts does not; where nothing is restarted, always.
    pub shows_beside_restarts: bool,
}

impl Candidate {
    /// Σ of the held-out decreases.
    pub fn gain(&self) -> f64 {
        self.gains.iter().sum()
    }

    /// Follows the fit to its end; `heldout` is what the clusters leave without the effect.
    fn settle(
        &mut self,
        cases: Cases<'_>,
        clusters: Clusters,
        heldout: &[f64],
    ) -> Result<(), DiagnoseError> {
        let from = Some(&self.fitted);
        let end = match clusters.are_whole() {
            true => fit_effects(cases, &self.fitted.effects, from, clusters)?,
            false => followed(cases, &self.fitted, clusters)?,
        };
        self.ends_as(end, &cases, heldout);
        Ok(())
    }

    /// Takes this fit in the place of its own.
    fn ends_as(&mut self, fitted: Fitted, cases: &Cases<'_>, heldout: &[f64]) {
        self.gains = gains(heldout, &fitted);
        self.is_told_from_nothing = is_told(cases, &fitted, self.effect, heldout, &self.gains);
        self.fitted = fitted;
    }

    /// Takes a fit that was begun elsewhere, beside `current` and as one of so many.
    pub fn ends_elsewhere(
        &mut self,
        fitted: Fitted,
        cases: &Cases<'_>,
        current: &Fitted,
        family: usize,
    ) {
        self.ends_as(fitted, cases, &current.heldout_beyond_torque_noise());
        self.judge_by_gain(family);
    }

    /// Takes sizes by group in the place of one for all; it was chosen among so many.
    fn becomes(&mut self, fitted: Fitted, cases: &Cases<'_>, heldout: &[f64], forms: usize) {
        self.ends_as(fitted, cases, heldout);
        let of_groups = self.fitted.chance_of_groups(self.effect).unwrap_or(1.0);
        let chances = [self.p_of_gain(forms), of_groups * forms as f64];
        self.p_family = chances.into_iter().fold(self.p_family, f64::min);
    }

    /// What it would explain if groups of tightenings had sizes of their own.
    fn promise_by_group(&self, cases: Cases<'_>, groupings: &[Groups]) -> f64 {
        self.gain() + promised(cases, &self.fitted, self.effect, groupings)
    }

    /// Standard deviations by which that sum exceeds 0.
    pub fn clearness(&self) -> f64 {
        clearness(&self.gains, self.fitted.scale())
    }

    /// Standard deviations by which it explains more than `other`.
    pub fn ahead_of(&self, other: &Self) -> f64 {
        clearness(&self.beyond(other), self.fitted.scale())
    }

    /// By how much it explains more than `other` of each cluster.
    pub fn beyond(&self, other: &Self) -> Vec<f64> {
        let pairs = self.gains.iter().zip(&other.gains);
        pairs.map(|(own, other)| own - other).collect()
    }

    /// Judges it by its gain, too, as one of `family`.
    pub fn judge_by_gain(&mut self, family: usize) {
        self.p_family = self.p_family.min(self.p_of_gain(family));
    }

    /// Chance of so clear a gain in held-out clusters, among `family` candidates (Bonferroni): for effects that push
    /// elsewhere once the model follows them, so that no score against the model without them sees them.
    fn p_of_gain(&self, family: usize) -> f64 {
        (chance(&self.gains, self.fitted.scale()) * family as f64).min(1.0)
    }

    /// Standard error over clusters of the share of `misfit` (per cluster) that it removes: that of the ratio of two sums.
    pub fn share_error(&self, misfit: &[f64]) -> f64 {
        let whole: f64 = misfit.iter().sum();
        let share = self.gain() / whole;
        let pairs = self.gains.iter().zip(misfit);
        let rest: Vec<f64> = pairs.map(|(gain, misfit)| gain - share * misfit).collect();
        spread_of_sum(&rest) / whole.abs()
    }
}

/// The candidates, best first.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ranking {
    pub candidates: Vec<Candidate>,
    /// Effects whose starts this rig cannot be simulated with.
    pub impossible: Vec<Effect>,
    /// Pairs that promise more together than either alone, best first; looked for in a few long records only.
    pub pairs: Vec<Pair>,
    /// What every candidate was scored with.
    pub columns: Vec<Column>,
    /// Campaigns of nothing but noise, and in how many of them something was called supported.
    pub control: (usize, usize),
}

/// Scores and refits every effect of `candidates` beside those of `current`.
pub(crate) fn rank(
    cases: Cases<'_>,
    current: &Fitted,
    candidates: &[Effect],
    clusters: Clusters,
    settings: &DiagnoseSettings,
    control_campaigns: usize,
    watch: &Watch<'_>,
) -> Result<Ranking, DiagnoseError> {
    cases.tally().ranking();
    watch.pieces(Pieces::Of(candidates.len()));
    let pooled = PooledModel::shared_by(cases, &current.effects, &current.sharing)?;
    let control = Control {
        campaigns: control_campaigns,
        seed: settings.seed,
    };
    let scorer = Scorer::new(&pooled, current, clusters, control);
    let scored = scorer.score(candidates)?;
    let control = negative_control(&scorer, &scored, candidates, settings);
    let pairs = (scored.gram.as_ref())
        .map(|gram| promising_pairs(&scored.columns, gram, settings))
        .unwrap_or_default();
    let columns = scored.columns;
    cases.tally().signatures(cases.len() * columns.len());
    let family = Family::new(&columns, settings.sign_flips, settings.seed);
    let heldout = current.heldout_beyond_torque_noise();
    let leaves_noise = !clusters.are_whole() && current.leaves_white_noise(cases);
    let promises = match clusters.are_whole() || leaves_noise {
        true => Vec::new(),
        false => first_ranking(cases, current, candidates),
    };
    let refitted: Vec<Result<Option<Candidate>, DiagnoseError>> = candidates
        .par_iter()
        .map(|&effect| {
            watch.go_on()?;
            let way = match leaves_noise {
                true => Way::Nearby,
                false => Way::Far(promises.iter().find(|promise| promise.effect == effect)),
            };
            let fitted = refit(cases, current, effect, &columns, way, clusters, settings);
            watch.pieces(Pieces::Done);
            Ok(possible(fitted)?.map(|fitted| {
                let p_family = family.p(&columns, effect);
                judged(cases, effect, fitted, &heldout, &columns, p_family)
            }))
        })
        .collect();
    let refitted = refitted.into_iter().collect::<Result<Vec<_>, _>>()?;
    let outcomes = candidates.iter().zip(&refitted);
    let impossible = outcomes.filter(|(_, outcome)| outcome.is_none());
    let impossible = impossible.map(|(&effect, _)| effect).collect();
    let mut candidates: Vec<Candidate> = refitted.into_iter().flatten().collect();
    let is_noise = leaves_noise || (clusters.are_whole() && current.is_at_floor());
    follow_best(cases, &heldout, is_noise, &mut candidates, clusters, watch)?;
    try_by_group(cases, &heldout, &mut candidates, clusters, settings, watch)?;
    look_where_it_shows(cases, current, &mut candidates, clusters, settings, watch)?;
    look_beside_restarts(cases, current, &mut candidates, settings);
    Ok(Ranking {
        candidates,
        impossible,
        pairs,
        columns,
        control,
    })
}

/// A refitted candidate beside what was left without it.
fn judged(
    cases: Cases<'_>,
    effect: Effect,
    fitted: Fitted,
    heldout: &[f64],
    columns: &[Column],
    p_family: f64,
) -> Candidate {
    let own = columns.iter().filter(|column| column.effect == effect);
    let gains = gains(heldout, &fitted);
    Candidate {
        effect,
        score: own.map(Column::statistic).fold(0.0, f64::max),
        p_family,
        is_told_from_nothing: is_told(&cases, &fitted, effect, heldout, &gains),
        shows_beside_restarts: true,
        gains,
        fitted,
    }
}

/// Whether an effect has sizes and no shape: what it takes, it takes by its size alone.
pub(crate) fn is_all_size(effect: Effect) -> bool {
    let mut parameters = effect.description().parameters.iter();
    parameters.all(|one| one.vanishes_at.is_some()) && !is_unlisted(effect)
}

/// Whether an effect's size is told from nothing: by its interval, or, of few long records and of an effect without a shape, by what
/// stretches that took no part leave without it, where a bound of the others forbids what the interval holds.
fn is_told(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    effect: Effect,
    heldout: &[f64],
    gains: &[f64],
) -> bool {
    let (without, gain): (f64, f64) = (heldout.iter().sum(), gains.iter().sum());
    match beside_nothing(cases, fitted, effect) {
        BesideNothing::Told => true,
        BesideNothing::Held => {
            let is_open = fitted.are_stretches() && !fitted.is_weighted;
            is_open && is_all_size(effect) && without > PLAINLY_MISSED * (without - gain)
        }
        BesideNothing::Unknown => false,
    }
}

/// Follows the best to their ends, judges every gain by chance too, and sorts.
fn follow_best(
    cases: Cases<'_>,
    heldout: &[f64],
    is_noise: bool,
    candidates: &mut [Candidate],
    clusters: Clusters,
    watch: &Watch<'_>,
) -> Result<(), DiagnoseError> {
    sort(candidates);
    let followed = match clusters.are_whole() {
        _ if is_noise => 0,
        false if long_record::take_long(&cases) => BEST_OF_LONG,
        _ => BEST,
    };
    let best = candidates.par_iter_mut().take(followed);
    best.try_for_each(|candidate| {
        watch.go_on()?;
        candidate.settle(cases, clusters, heldout)
    })?;
    let family_size = candidates.len();
    let left: f64 = heldout.iter().sum();
    for candidate in &mut *candidates {
        let takes_most = !clusters.are_whole() && candidate.gain() > MOST_OF_ALL * left;
        let stricter = if takes_most { 1 } else { STRICTER };
        let p_of_gain = candidate.p_of_gain(family_size * stricter);
        let p = candidate.p_family.min(p_of_gain);
        candidate.p_family = (p * shapes_tried(candidate.effect)).min(1.0);
    }
    sort(candidates);
    Ok(())
}

/// Lets the sizes of the best differ between groups of tightenings where that leaves no more than the noise, and sorts again: what
/// people, joints or tools have more or less of is explained better by that than by what another effect makes of it. Where more
/// is left, sizes that differ may stand in for another effect that is missing, too.
fn try_by_group(
    cases: Cases<'_>,
    heldout: &[f64],
    candidates: &mut [Candidate],
    clusters: Clusters,
    settings: &DiagnoseSettings,
    watch: &Watch<'_>,
) -> Result<(), DiagnoseError> {
    if !clusters.are_whole() {
        return Ok(());
    }
    let groupings = Groups::worth_trying(&cases);
    let family = candidates.len();
    // Those that promise most, wherever they stand with one size for all: what few have is little of everyone.
    let mut promising: Vec<(f64, &mut Candidate)> = (candidates.iter_mut())
        .filter(|candidate| !is_unlisted(candidate.effect))
        .map(|candidate| (candidate.promise_by_group(cases, &groupings), candidate))
        .collect();
    promising.sort_by(|a, b| b.0.total_cmp(&a.0));
    let best = promising.into_par_iter().take(BEST_BY_GROUP);
    best.try_for_each(|(_, candidate)| {
        watch.go_on()?;
        let (fitted, effect) = (&candidate.fitted, candidate.effect);
        let found = by_group(
            cases, fitted, effect, &groupings, family, clusters, settings,
        )?;
        if let Some(fitted) = found.filter(Fitted::is_noise) {
            candidate.becomes(fitted, &cases, heldout, family * (1 + groupings.len()));
        }
        Ok::<(), DiagnoseError>(())
    })?;
    sort(candidates);
    Ok(())
}

/// Where nothing leaves as little as noise, and the misfit sits in some groups only: candidates are looked for there.
fn look_where_it_shows(
    cases: Cases<'_>,
    current: &Fitted,
    candidates: &mut [Candidate],
    clusters: Clusters,
    settings: &DiagnoseSettings,
    watch: &Watch<'_>,
) -> Result<(), DiagnoseError> {
    if !clusters.are_whole() || candidates.iter().any(|one| one.fitted.is_noise()) {
        return Ok(());
    }
    let groupings = Groups::worth_trying(&cases);
    let effects: Vec<Effect> = (candidates.iter())
        .map(|candidate| candidate.effect)
        .filter(|effect| !is_unlisted(*effect))
        .collect();
    let heldout = current.heldout_beyond_torque_noise();
    let forms = candidates.len() * (1 + groupings.len());
    for shows in where_it_shows(&cases, current, &groupings) {
        let found =
            best_where_it_shows(cases, current, &effects, &shows, clusters, settings, watch)?;
        let mut is_found = false;
        for (effect, fitted) in found {
            let least = fitted.smallest_gain(settings) * fitted.squares();
            let candidate = candidates.iter_mut().find(|one| one.effect == effect);
            if let Some(candidate) = candidate
                && fitted.is_at_floor()
                && explains_more(&candidate.fitted, &fitted, least)
            {
                candidate.becomes(fitted, &cases, &heldout, forms);
                is_found = true;
            }
        }
        if is_found {
            break;
        }
    }
    sort(candidates);
    Ok(())
}

/// How many shapes of an effect were looked at before its starts were read off the data.
fn shapes_tried(effect: Effect) -> f64 {
    match effect.wavelength().is_some() || effect.resonance().is_some() {
        true => SHAPES_TRIED,
        false => 1.0,
    }
}

/// Campaigns of nothing but noise, and in how many of them one of the candidates would be called supported.
fn negative_control(
    scorer: &Scorer<'_, '_>,
    scored: &Scored,
    candidates: &[Effect],
    settings: &DiagnoseSettings,
) -> (usize, usize) {
    let campaigns = scorer.control_campaigns();
    let is_false_alarm = |&campaign: &usize| {
        let columns = scorer.of_noise(scored, campaign);
        let family = Family::new(&columns, CONTROL_FLIPS, settings.seed);
        let mut ps = candidates.iter().map(|&effect| family.p(&columns, effect));
        ps.any(|p| p <= settings.level)
    };
    let alarms = (0..campaigns).into_par_iter().filter(is_false_alarm);
    (campaigns, alarms.count())
}

/// Those first that explain most.
fn sort(candidates: &mut [Candidate]) {
    candidates.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
}

#[cfg(test)]
mod tests;
