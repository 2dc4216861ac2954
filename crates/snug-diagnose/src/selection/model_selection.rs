//! What is looked for beside a model: the ranking of all candidates, and which of them to add.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::data::watch::Watch;
use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fit::{fit_effects, fit_part, fit_sharing};
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use crate::pooled::sharing::{Groups, Sharing};
use crate::question::{Begun, Until};
use crate::ranking::applicability::candidates;
use crate::ranking::by_group::{by_group, explains_more};
use crate::ranking::kin::is_simpler;
use crate::ranking::paired_gain::gains;
use crate::ranking::rank::{Candidate, Ranking, rank};
use crate::selection::path::{Addition, SelectionPath, justified, laws_may_matter, misfit, twins};
use crate::selection::thresholds::{
    ENOUGH_AHEAD, EQUAL, JUST_AS_MUCH, LEAVES_OF_GENERAL, LITTLE_LEFT, MOST_EFFECTS, MUCH_LEFT,
    SEEDS,
};
use crate::settings::DiagnoseSettings;
use snug_least_squares::PooledSettings;
use snug_model::{Effect, Law};

/// What stays the same while effects are looked for.
#[derive(Clone, Copy)]
pub(crate) struct ModelSelection<'a> {
    pub cases: Cases<'a>,
    /// Effects of the study's own model.
    pub own: &'a [Effect],
    /// Which of their sizes differ between groups.
    pub sharing: &'a Sharing,
    /// Effects that the study declares but does not use: candidates, too.
    pub custom: &'a [Effect],
    pub clusters: Clusters,
    pub settings: &'a DiagnoseSettings,
    pub watch: &'a Watch<'a>,
    /// Whether to end where the simulation takes too few steps for what is found.
    pub may_ask_for_steps: bool,
    /// Where to look no further.
    pub until: Option<&'a Until<'a>>,
}

impl ModelSelection<'_> {
    /// The study's own model, nothing ranked beside it.
    pub fn compare(&self) -> Result<SelectionPath, DiagnoseError> {
        let fitted = fit_sharing(self.cases, self.own, self.sharing, None, self.clusters)?;
        Ok(SelectionPath::only(fitted))
    }

    /// What could be missing beside the study's own model; nothing is added. Whoever watches may end it.
    pub fn diagnose(&self, mut path: SelectionPath) -> Result<SelectionPath, DiagnoseError> {
        let ended = self.name_the_first(&mut path);
        path.until_interrupted(ended)
    }

    fn name_the_first(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        self.rank_last(path)?;
        let next = justified(&path.ranking, path.last(), &path.rungs[0], self.settings);
        if self.puts_differing_first(path, next.ok())? {
            return Ok(());
        }
        match next {
            Ok(best) => {
                let steps = self.choose(path.last(), &path.ranking, best, MOST_EFFECTS)?;
                let first = steps.first().map(|(addition, _)| addition.effect);
                let all = &path.ranking.candidates;
                path.chosen = all
                    .iter()
                    .position(|candidate| Some(candidate.effect) == first);
            }
            Err(stop) => path.stopped = Some(stop),
        }
        Ok(())
    }

    /// The study's own model with `effects` added one after the other, and what is missing then, or as many of them as
    /// were added before whoever watches ended it.
    pub fn add(
        &self,
        effects: &[Effect],
        mut path: SelectionPath,
    ) -> Result<SelectionPath, DiagnoseError> {
        let begun: Vec<Begun> = effects.iter().copied().map(Begun::as_usual).collect();
        let ended = self.put_in(&begun, &mut path, |_, _| true);
        let ended = ended.and_then(|()| self.name_the_next(&mut path));
        path.until_interrupted(ended)
    }

    fn name_the_next(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        self.rank_last(path)?;
        let next = justified(&path.ranking, path.last(), &path.rungs[0], self.settings);
        if self.puts_differing_first(path, next.ok())? {
            return Ok(());
        }
        match next {
            Ok(best) => path.chosen = Some(self.single(path.last(), &path.ranking, best)),
            Err(stop) => path.stopped = Some(stop),
        }
        Ok(())
    }

    /// Ranks what is missing beside the last model.
    pub(super) fn rank(&self, path: &SelectionPath) -> Result<Ranking, DiagnoseError> {
        let current = path.last();
        self.must_be_resolved(current)?;
        let beside = list(&current.effects);
        (self.watch).begin(&format!("ranking what is missing beside {beside}"))?;
        let mut all = candidates(&self.cases, current, self.custom)?;
        let laws_may_matter = laws_may_matter(&path.rungs[0], current);
        all.retain(|effect| laws_may_matter || !is_unlisted(*effect));
        let mut ranking = rank(
            self.cases,
            current,
            &all,
            self.clusters,
            self.settings,
            self.settings.control_campaigns,
            self.watch,
        )?;
        let most = LEAVES_OF_GENERAL * current.squares();
        (ranking.candidates).retain(|one| !one.effect.is_general() || one.fitted.squares() < most);
        self.what_may_come_in_must_be_resolved(&ranking)?;
        Ok(ranking)
    }

    /// The same effects, fitted from there to the end; sizes that differed between groups are one again where what was added makes
    /// them alike.
    pub fn settled(&self, fitted: &Fitted) -> Result<Fitted, DiagnoseError> {
        let fit =
            |fitted: &Fitted| fit_effects(self.cases, &fitted.effects, Some(fitted), self.clusters);
        let mut settled = fit(fitted)?;
        for effect in settled.effects.clone() {
            if settled.sharing.factor(effect).is_some()
                && let Some(one) = self.with_one_size(&settled, effect)?
            {
                settled = fit(&one)?;
            }
        }
        Ok(settled)
    }

    /// The last model with sizes of one of its effects that differ between groups, where that explains as much of what is left as
    /// `next`, the candidate that would come in otherwise: before another effect is blamed, this one may be larger for some.
    pub fn last_by_group(
        &self,
        path: &SelectionPath,
        next: Option<usize>,
    ) -> Result<Option<Fitted>, DiagnoseError> {
        let last = path.last();
        if last.is_exact {
            return Ok(None);
        }
        let groupings = Groups::worth_trying(&self.cases);
        let (family, heldout) = (last.effects.len(), last.heldout_beyond_torque_noise());
        let gain = |fitted: &Fitted| gains(&heldout, fitted).iter().sum::<f64>();
        let mut best: Option<Fitted> = None;
        for &effect in &last.effects {
            let (cases, clusters, settings) = (self.cases, self.clusters, self.settings);
            let found = by_group(cases, last, effect, &groupings, family, clusters, settings)?;
            let known = best.as_ref().map_or(0.0, gain);
            best = found.filter(|found| gain(found) > known).or(best);
        }
        let other = next.map_or(0.0, |next| path.ranking.candidates[next].gain());
        let best = best.filter(|best| gain(best) >= other);
        best.map(|best| self.settled(&best)).transpose()
    }

    /// The fit with one size of `effect` for all, where the groups' own do not plainly explain more.
    fn with_one_size(
        &self,
        fitted: &Fitted,
        effect: Effect,
    ) -> Result<Option<Fitted>, DiagnoseError> {
        let sharing = fitted.sharing.with(effect, None);
        let mut pooled = PooledModel::shared_by(self.cases, &fitted.effects, &sharing)?;
        let start = fitted.start(&pooled);
        let Ok(end) = pooled.fit(&start, &PooledSettings::default()) else {
            return Ok(None);
        };
        let one = Fitted::new(&pooled, end, &self.clusters);
        let least = one.smallest_gain(self.settings) * one.squares();
        Ok((!explains_more(&one, fitted, least)).then_some(one))
    }

    /// The best candidate, or a supported one that is as good and the likelier story: an effect of the catalogue, else the
    /// term that makes most of the base model superfluous.
    fn single(&self, current: &Fitted, ranking: &Ranking, best: usize) -> usize {
        let all = &ranking.candidates;
        let is_equal = |other: usize| all[other].keeps_up_with(&all[best], &self.clusters);
        let does = |listed: usize| {
            let is_richer = all[best].is_richer_than(&all[listed]);
            is_equal(listed) || (is_richer && all[listed].does_for(&all[best], current))
        };
        if let Some(listed) = self.listed(current, ranking).filter(|&listed| does(listed)) {
            return listed;
        }
        let equals: Vec<usize> = (best..all.len())
            .filter(|&other| all[other].is_supported(self.settings) && is_equal(other))
            .collect();
        let fits: Vec<&Fitted> = equals.iter().map(|&one| &all[one].fitted).collect();
        // Of several the first, which is the last that is asked.
        let likeliest = equals
            .into_iter()
            .rev()
            .max_by_key(|&one| all[one].fitted.makes_superfluous(&fits));
        self.special_case(current, ranking, likeliest.unwrap_or(best))
    }

    /// The law in no catalogue itself, or a supported special case of it that does for it or explains as much.
    pub(super) fn special_case(&self, current: &Fitted, ranking: &Ranking, law: usize) -> usize {
        let all = &ranking.candidates;
        let does = |case: &Candidate| {
            is_simpler(case.effect, all[law].effect)
                && case.is_supported(self.settings)
                && (case.does_for(&all[law], current) || self.explains_as_much(case, &all[law]))
        };
        all.iter().position(does).unwrap_or(law)
    }

    fn explains_as_much(&self, one: &Candidate, other: &Candidate) -> bool {
        one.gain() > JUST_AS_MUCH * other.gain() && one.keeps_up_with(other, &self.clusters)
    }

    /// The first supported effect of the catalogue, or of those that explain as much the one with the fewest sizes and shapes to do
    /// it with: a law that holds a simpler one as a special case explains all that that does. Of a few long records one that does for
    /// the first explains as much, too.
    fn listed(&self, current: &Fitted, ranking: &Ranking) -> Option<usize> {
        let all = &ranking.candidates;
        let is_listed = |c: &Candidate| !is_unlisted(c.effect) && c.is_supported(self.settings);
        let first = all.iter().position(is_listed)?;
        let explains_as_much = |&other: &usize| {
            let (other, first) = (&all[other], &all[first]);
            let as_much = self.explains_as_much(other, first);
            let is_richer = first.is_richer_than(other);
            is_listed(other) && (as_much || (is_richer && other.does_for(first, current)))
        };
        (first..all.len())
            .filter(explains_as_much)
            .min_by_key(|&other| all[other].has_to_say())
    }

    /// What to add: one effect, or, where one leaves much, the two that together leave least. Of equals a catalogue
    /// effect comes before an unlisted term.
    pub fn choose(
        &self,
        current: &Fitted,
        ranking: &Ranking,
        best: usize,
        room: usize,
    ) -> Result<Vec<Step>, DiagnoseError> {
        let winner = &ranking.candidates[best];
        let single = self.single(current, ranking, best);
        let leaves_much = self.leaves_much(&ranking.candidates[single].fitted, current);
        let half = |listed: usize| ranking.candidates[listed].gain() > 0.5 * winner.gain();
        let challenged =
            is_unlisted(winner.effect) && self.listed(current, ranking).is_some_and(half);
        if let Some(steps) = self.shared_in_place_of(current, ranking, single)? {
            return Ok(steps);
        }
        let alone = vec![self.step(ranking, single, current)];
        // In stretches of one long record the next rung shows as much, for a third of the work.
        let pays = room > 1 && self.clusters.are_whole();
        if !pays || !(challenged || leaves_much) {
            return Ok(alone);
        }
        let Some((seed, together, second)) = self.best_pair(current, ranking)? else {
            return Ok(alone);
        };
        let one = &ranking.candidates[single];
        let better = together.gain() > one.gain() && together.ahead_of(one) > EQUAL;
        // Two catalogue effects that leave as little as one unlisted term are the likelier story.
        let as_good = is_unlisted(one.effect) && together.keeps_up_with(one, &self.clusters);
        Ok(match better || as_good {
            true => self.larger_first(current, ranking, seed, second),
            false => alone,
        })
    }

    /// A pair as two steps, the one that explains more by itself, and is supported by itself, first.
    fn larger_first(
        &self,
        current: &Fitted,
        ranking: &Ranking,
        seed: usize,
        second: Step,
    ) -> Vec<Step> {
        let (addition, both) = second;
        let mut before = ranking.candidates.iter().take(seed);
        let is_it = |c: &Candidate| c.effect == addition.effect && c.is_supported(self.settings);
        match before.position(is_it) {
            Some(larger) => {
                let (smaller, _) = self.step(ranking, seed, current);
                vec![self.step(ranking, larger, current), (smaller, both)]
            }
            None => vec![self.step(ranking, seed, current), (addition, both)],
        }
    }

    /// Whether `left` is far from the noise for a model that should explain what `current` misses.
    fn leaves_much(&self, left: &Fitted, current: &Fitted) -> bool {
        misfit(left) > MUCH_LEFT * misfit(current) && !left.is_noise()
    }

    /// Whether `left` is next to nothing of what `current` misses, so that no others could be far ahead.
    fn completes(&self, left: &Fitted, current: &Fitted) -> bool {
        misfit(left) < LITTLE_LEFT * misfit(current) && left.is_noise()
    }

    /// The two catalogue effects that together explain most: where the first stands in the ranking, both, the second.
    ///
    /// Looked for from the best few until two are found that leave next to nothing; as long as they leave much, from the
    /// second of them, too: one that explains little by itself may be what the best beside it stood in for.
    fn best_pair(
        &self,
        current: &Fitted,
        ranking: &Ranking,
    ) -> Result<Option<(usize, Candidate, Step)>, DiagnoseError> {
        let heldout = current.heldout_beyond_torque_noise();
        let mut pair: Option<(usize, Candidate, Step)> = None;
        let all = ranking.candidates.iter().enumerate();
        let supported =
            all.filter(|(_, c)| !is_unlisted(c.effect) && c.is_supported(self.settings));
        let mut seeds: Vec<usize> = supported.map(|(seed, _)| seed).take(SEEDS).collect();
        let mut next = 0;
        let is_complete = |pair: &Option<(usize, Candidate, Step)>| {
            (pair.as_ref()).is_some_and(|(_, both, _)| self.completes(&both.fitted, current))
        };
        while let Some(&seed) = seeds.get(next)
            && !is_complete(&pair)
        {
            next += 1;
            if let Some((together, second)) = self.beside(ranking, seed, &heldout)?
                && (pair.as_ref()).is_none_or(|(_, known, _)| together.gain() > known.gain())
            {
                pair = Some((seed, together, second));
            }
            if let Some((_, together, (second, _))) = &pair
                && next == seeds.len()
                && self.leaves_much(&together.fitted, current)
            {
                let mut all = ranking.candidates.iter();
                let place = all.position(|c| c.effect == second.effect);
                seeds.extend(place.filter(|place| !seeds.contains(place)));
            }
        }
        Ok(pair)
    }

    /// What explains most beside the candidate at `seed`, judged by `heldout`, what was left without either.
    fn beside(
        &self,
        ranking: &Ranking,
        seed: usize,
        heldout: &[f64],
    ) -> Result<Option<(Candidate, Step)>, DiagnoseError> {
        let first = &ranking.candidates[seed].fitted;
        self.watch
            .begin(&format!("looking ahead from {}", list(&first.effects)))?;
        let mut seconds = candidates(&self.cases, first, self.custom)?;
        seconds.retain(|&effect| !is_unlisted(effect));
        let mut found = match self.cases.len() > ENOUGH_AHEAD {
            true => self.second_of_part(first, &seconds)?,
            false => self.second_of(self.cases, first, &seconds)?,
        };
        if let Some((together, _)) = &mut found {
            together.gains = gains(heldout, &together.fitted);
        }
        Ok(found)
    }

    /// What of `seconds` is justified beside `first`, a fit of `cases`.
    fn second_of(
        &self,
        cases: Cases<'_>,
        first: &Fitted,
        seconds: &[Effect],
    ) -> Result<Option<(Candidate, Step)>, DiagnoseError> {
        let (clusters, settings) = (self.clusters, self.settings);
        let next = rank(cases, first, seconds, clusters, settings, 0, self.watch)?;
        let second = justified(&next, first, first, settings).ok();
        Ok(second.map(|index| {
            let together = next.candidates[index].clone();
            (together, self.step(&next, index, first))
        }))
    }

    /// The same of many tightenings: the second is found on a part of them, since two are looked for only where much is
    /// left, then fitted to all. The chance and the twins are those of the part.
    fn second_of_part(
        &self,
        first: &Fitted,
        seconds: &[Effect],
    ) -> Result<Option<(Candidate, Step)>, DiagnoseError> {
        let members = first.spread(ENOUGH_AHEAD);
        let part = self.cases.some(&members);
        let cases = self.cases.others(&part);
        let of_part = fit_part(cases, &members, first, self.clusters)?;
        let Some((_, (ahead, _))) = self.second_of(cases, &of_part, seconds)? else {
            return Ok(None);
        };
        let found = self.second_of(self.cases, first, &[ahead.effect])?;
        Ok(found.map(|(together, (mut addition, fitted))| {
            (addition.p_family, addition.twins) = (ahead.p_family, ahead.twins);
            (together, (addition, fitted))
        }))
    }

    pub fn step(&self, ranking: &Ranking, index: usize, current: &Fitted) -> Step {
        let candidate = &ranking.candidates[index];
        let share = candidate.share_beside(current);
        let addition = Addition {
            effect: candidate.effect,
            p_family: candidate.p_family,
            heldout_gain: share,
            share_of_first: share,
            twins: twins(ranking, index, &self.clusters),
        };
        (addition, candidate.fitted.clone())
    }
}

/// What is added, and the model with it.
pub(crate) type Step = (Addition, Fitted);

fn list(effects: &[Effect]) -> String {
    match effects {
        [] => "the base model".to_owned(),
        some => some
            .iter()
            .map(|effect| effect.name())
            .collect::<Vec<_>>()
            .join(" + "),
    }
}

#[cfg(test)]
mod tests;
