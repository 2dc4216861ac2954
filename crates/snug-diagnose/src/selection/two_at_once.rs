//! Two effects that are justified together where neither is alone: of a few long records, in which each would have to make up for the
//! other, and of any an effect with the one that is told beside it only.

use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::is_told_from_nothing;
use crate::ranking::applicability::{can_stand_beside, candidates};
use crate::ranking::paired_gain::gains;
use crate::ranking::pairs::Pair;
use crate::ranking::rank::{Candidate, Ranking, rank};
use crate::selection::model_selection::{ModelSelection, Step};
use crate::selection::path::{SelectionPath, least_share, misfit};
use crate::selection::thresholds::{GOOD_PART, SEEDS, SMALL};
use snug_model::{Effect, Law};

/// A pair, fitted: both, and the second as a step from the first, which stands at `seed` in the ranking.
pub(super) struct Both {
    pub both: Candidate,
    seed: usize,
    second: Step,
    /// Whether the second is supported beside the first.
    second_is_supported: bool,
}

impl ModelSelection<'_> {
    /// The two effects of the last ranking's promising pairs that explain most and are justified, as two steps.
    pub fn two_at_once(&self, path: &SelectionPath) -> Result<Option<Vec<Step>>, DiagnoseError> {
        let (current, ranking) = (path.last(), &path.ranking);
        if !current.is_weighted && misfit(current) < SMALL * misfit(&path.rungs[0]) {
            // All that is left would be told as small.
            return Ok(None);
        }
        let mut best: Option<Both> = None;
        let beyond_chance = |pair: &Pair| pair.p_family <= self.settings.level;
        let beside = self.with_what_is_told_beside(current, ranking)?;
        let pairs = ranking.pairs.iter().copied().filter(beyond_chance);
        for pair in pairs.chain(beside) {
            let [a, b] = pair.effects.map(|effect| effect.name());
            self.watch.begin(&format!("trying {a} and {b} together"))?;
            let Some(mut found) = self.together(current, ranking, pair)? else {
                continue;
            };
            if second_is_told_beside_first(pair) {
                found.both.judge_by_gain(ranking.candidates.len());
                if !found.second_is_supported {
                    continue;
                }
            }
            let known = best.as_ref().map_or(0.0, |best| best.both.gain());
            if found.both.gain() > known && self.are_justified(path, pair.effects, &found.both) {
                best = Some(found);
            }
        }
        Ok(best.map(|pair| self.as_steps(current, ranking, pair)))
    }

    /// Each of the best candidates that takes a good part and beside which alone another effect is told, with that: held out, what has two
    /// waves may be told worse with one of them than with none. Of chance nothing is known yet.
    fn with_what_is_told_beside(
        &self,
        current: &Fitted,
        ranking: &Ranking,
    ) -> Result<Vec<Pair>, DiagnoseError> {
        let takes_part = |one: &&Candidate| one.gain_beside(current) > GOOD_PART * misfit(current);
        let best = ranking.candidates.iter().take(SEEDS).filter(takes_part);
        let mut pairs = Vec::new();
        for first in best {
            let all = candidates(&self.cases, &first.fitted, &[])?.into_iter();
            let with = all.map(|second| Pair {
                effects: [first.effect, second],
                p_family: 1.0,
            });
            pairs.extend(with.filter(|&pair| second_is_told_beside_first(pair)));
        }
        Ok(pairs)
    }

    pub(super) fn as_steps(&self, current: &Fitted, ranking: &Ranking, pair: Both) -> Vec<Step> {
        let (mut first, alone) = self.step(ranking, pair.seed, current);
        let (mut second, both) = pair.second;
        // What either does by itself says little.
        for addition in [&mut first, &mut second] {
            addition.p_family = pair.both.p_family;
            addition.heldout_gain = pair.both.share_beside(current);
            addition.twins.clear();
        }
        vec![(first, alone), (second, both)]
    }

    /// Both, from the end of one of them and from that of the other, whichever leads lower.
    pub(super) fn together(
        &self,
        current: &Fitted,
        ranking: &Ranking,
        pair: Pair,
    ) -> Result<Option<Both>, DiagnoseError> {
        let heldout = current.heldout_beyond_torque_noise();
        let [a, b] = pair.effects;
        let (mut lowest, mut both_show): (Option<Both>, bool) = (None, true);
        for (first, second) in [(a, b), (b, a)] {
            let mut all = ranking.candidates.iter();
            let Some(seed) = all.position(|candidate| candidate.effect == first) else {
                continue;
            };
            let alone = &ranking.candidates[seed].fitted;
            if !can_stand_beside(&alone.effects, second, &self.cases[0]) {
                continue;
            }
            let (clusters, settings) = (self.clusters, self.settings);
            let next = rank(
                self.cases,
                alone,
                &[second],
                clusters,
                settings,
                0,
                self.watch,
            )?;
            let Some(mut both) = next.candidates.first().cloned() else {
                continue;
            };
            both_show &= both.shows_beside_restarts;
            let known = lowest.as_ref().map(|one| one.both.fitted.squares());
            if known.is_some_and(|known| known <= both.fitted.squares()) {
                continue;
            }
            both.gains = gains(&heldout, &both.fitted);
            both.p_family = pair.p_family;
            lowest = Some(Both {
                second: self.step(&next, 0, alone),
                second_is_supported: next.candidates[0].is_supported(self.settings),
                both,
                seed,
            });
        }
        if let Some(lowest) = &mut lowest {
            lowest.both.shows_beside_restarts = both_show;
        }
        Ok(lowest)
    }

    /// Beyond chance among all pairs, with two sizes that are told from nothing, and by enough to matter.
    fn are_justified(&self, path: &SelectionPath, pair: [Effect; 2], both: &Candidate) -> bool {
        let (current, first) = (path.last(), &path.rungs[0]);
        let share = |of: &Fitted| both.gain() / of.squares();
        both.is_supported(self.settings)
            && pair
                .iter()
                .all(|&effect| is_told_from_nothing(&self.cases, &both.fitted, effect))
            && share(current) >= current.smallest_gain(self.settings)
            && (current.is_weighted || share(first) >= least_share(both.effect))
    }
}

fn second_is_told_beside_first(pair: Pair) -> bool {
    let [first, second] = pair.effects;
    second.beside() == Some(first.name())
}
