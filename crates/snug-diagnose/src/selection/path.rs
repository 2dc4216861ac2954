//! What a selection leaves: its rungs, what was added and why, what is still missing and why it stopped.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fitted::Fitted;
use crate::ranking::kin::is_simpler;
use crate::ranking::paired_gain::agreement;
use crate::ranking::rank::{Candidate, Ranking};
use crate::selection::thresholds::{
    AS_MUCH, EQUAL, GOOD_PART, MATTERS, MOST, NO_OTHER, OF_PREDICTIONS, PLAINLY_MORE, PROMISING_P,
    SMALL, TRIFLE,
};
use crate::settings::DiagnoseSettings;
use snug_campaign::words::statement::Fate;
use snug_model::Effect;

/// An effect that was added, with what spoke for it then.
#[derive(Debug, Clone)]
pub(crate) struct Addition {
    pub effect: Effect,
    pub p_family: f64,
    /// Share of the misfit at that rung.
    pub heldout_gain: f64,
    /// Share of the misfit of the study's own model.
    pub share_of_first: f64,
    pub twins: Vec<Effect>,
}

/// What became of an attempt to do without a term.
#[derive(Debug, Clone)]
pub(crate) struct Attempt {
    pub effect: Effect,
    pub fate: Fate,
    /// Growth of the squared residual without it.
    pub loss: f64,
    /// The same as a share of the squared residual.
    pub growth: f64,
}

/// What was ranked beside a model before another was taken.
pub(crate) struct Ranked {
    /// The model as it was fitted then.
    pub beside: Fitted,
    /// Without what only the last ranking is asked for.
    pub ranking: Ranking,
}

/// How far the selection went.
pub(crate) struct SelectionPath {
    /// The models in order, the study's own first.
    pub rungs: Vec<Fitted>,
    /// Of each but the last what was ranked beside it; `None` where nothing was.
    pub ranked: Vec<Option<Ranked>>,
    pub additions: Vec<Addition>,
    pub attempts: Vec<Attempt>,
    /// The ranking against the last model; empty where nothing was ranked against it.
    pub ranking: Ranking,
    /// The ranking's candidate that is supported and matters, where the selection ends without adding it.
    pub chosen: Option<usize>,
    /// Why nothing more was added; `None` where nobody tried.
    pub stopped: Option<Stop>,
}

impl SelectionPath {
    /// A model that is not to be changed and nothing ranked beside it.
    pub fn only(fitted: Fitted) -> Self {
        Self {
            rungs: vec![fitted],
            ranked: Vec::new(),
            additions: Vec::new(),
            attempts: Vec::new(),
            ranking: Ranking::default(),
            chosen: None,
            stopped: None,
        }
    }

    /// One rung up.
    pub fn add(&mut self, addition: Addition, fitted: Fitted) {
        let before = misfit(self.last()) / misfit(&self.rungs[0]);
        self.additions.push(Addition {
            share_of_first: addition.heldout_gain * before,
            ..addition
        });
        self.stand_on(fitted);
    }

    /// Back to rung number `place`, and what was ranked beside it.
    pub fn go_back_to(&mut self, place: usize) {
        self.rungs.truncate(place + 1);
        let effects = &self.rungs[place].effects;
        self.additions.retain(|one| effects.contains(&one.effect));
        let mut later = self.ranked.split_off(place).into_iter();
        let ranked = later.next().flatten();
        self.ranking = ranked.map_or_else(Ranking::default, |ranked| ranked.ranking);
        self.stopped = None;
    }

    /// One rung down: the last model does `without` an effect that was added, and loses so much.
    pub fn take_out(&mut self, effect: Effect, without: Fitted, loss: f64, fate: Fate) {
        let attempt = self.attempt(effect, loss, fate);
        self.attempts.retain(|earlier| earlier.effect != effect);
        self.attempts.push(attempt);
        self.additions.retain(|one| one.effect != effect);
        self.stand_on(without);
        if let [only] = self.additions.as_slice() {
            self.needs(only.effect);
        }
    }

    /// The last model keeps an effect that was added: it explains at least what is lost without it, whatever it took first.
    pub fn keep(&mut self, effect: Effect, loss: f64) {
        self.explains(effect, loss / misfit(&self.rungs[0]));
        self.attempts.push(self.attempt(effect, loss, Fate::Stays));
    }

    fn attempt(&self, effect: Effect, loss: f64, fate: Fate) -> Attempt {
        Attempt {
            effect,
            fate,
            loss,
            growth: loss / self.last().squares(),
        }
    }

    /// Without an effect that was added the last model is nothing: it explains all that all of them do.
    pub fn needs(&mut self, effect: Effect) {
        self.explains(effect, 1.0 - misfit(self.last()) / misfit(&self.rungs[0]));
    }

    fn explains(&mut self, effect: Effect, share: f64) {
        let mut additions = self.additions.iter_mut();
        if let Some(one) = additions.find(|one| one.effect == effect) {
            one.share_of_first = one.share_of_first.max(share);
        }
    }

    /// The last model as it fits from another place, against which nothing is ranked yet.
    pub fn replace_last(&mut self, fitted: Fitted) {
        self.rungs.pop();
        self.rungs.push(fitted);
        self.ranking = Ranking::default();
    }

    /// What was beside the effects of the last model before, and taken out, is not told from nothing there: added again, it would be taken
    /// out again, and so on for ever.
    pub fn doubt_what_was_taken_out(&mut self) {
        let Some((last, before)) = self.rungs.split_last() else {
            return;
        };
        for candidate in &mut self.ranking.candidates {
            let is_with_it = |one: &Fitted| {
                one.effects.len() == last.effects.len() + 1
                    && one.effects.contains(&candidate.effect)
                    && last
                        .effects
                        .iter()
                        .all(|effect| one.effects.contains(effect))
            };
            candidate.is_told_from_nothing &= !before.iter().any(is_with_it);
        }
    }

    /// Another last model, against which nothing is ranked yet.
    pub fn stand_on(&mut self, fitted: Fitted) {
        let ranking = std::mem::take(&mut self.ranking);
        let were_ranked = !ranking.candidates.is_empty();
        let ranked = were_ranked.then(|| Ranked {
            beside: self.last().clone(),
            ranking: Ranking {
                columns: Vec::new(),
                pairs: Vec::new(),
                ..ranking
            },
        });
        self.ranked.push(ranked);
        self.rungs.push(fitted);
    }

    /// What was reached by `ended`, the end of the way; also where whoever watches ended it.
    pub fn until_interrupted(
        mut self,
        ended: Result<(), DiagnoseError>,
    ) -> Result<Self, DiagnoseError> {
        match ended {
            Err(DiagnoseError::Interrupted) => self.stopped = Some(Stop::Interrupted),
            ended => ended?,
        }
        Ok(self)
    }

    /// Whether whoever watches ended it on the way.
    pub fn is_interrupted(&self) -> bool {
        self.stopped == Some(Stop::Interrupted)
    }

    /// The same, sizes of its models and of what it chose as they are without what the noise of the logged torque pulls at them.
    pub fn without_torque_noise(mut self, cases: Cases<'_>) -> Result<Self, DiagnoseError> {
        let chosen = self
            .chosen
            .map(|index| &mut self.ranking.candidates[index].fitted);
        for fitted in self.rungs.iter_mut().chain(chosen) {
            *fitted = fitted.without_torque_noise(cases)?;
        }
        Ok(self)
    }

    /// The last model.
    pub fn last(&self) -> &Fitted {
        self.rungs.last().expect("a selection begins with a rung")
    }

    /// A candidate that is not supported, but might be with more tightenings: chance seldom does as much, or it explains a
    /// good part of an error that is beyond the noise, or most of one of which nobody knows how much is noise.
    pub fn is_promising(&self, settings: &DiagnoseSettings) -> Option<&Candidate> {
        let (first, last) = (&self.rungs[0], self.last());
        self.ranking.candidates.iter().find(|candidate| {
            let is_seldom = candidate.p_family < PROMISING_P;
            let gain = candidate.gain_beside(last);
            let explains = match last.is_weighted {
                true => last.is_beyond_noise() && gain > GOOD_PART * misfit(last),
                false => self.is_most(candidate, gain),
            };
            let is_clear = (is_seldom || explains)
                && gain > 2.0 * settings.smallest_gain * last.squares()
                && candidate.clearness() > 1.0
                && (last.is_weighted || gain > least_share(candidate.effect) * first.squares());
            !candidate.is_supported(settings)
                && candidate.shows_beside_restarts
                && (is_clear || self.takes_most_where_fitted(candidate))
        })
    }

    /// Whether an effect of the catalogue, its size told from nothing, takes most of what a long record is left with where it is fitted, and of
    /// what the study's own model left no small part, whatever it takes elsewhere: how far a motor has turned between two stretches is known
    /// less well than the wave of its ripple.
    fn takes_most_where_fitted(&self, candidate: &Candidate) -> bool {
        let last = self.last();
        last.are_stretches()
            && !last.is_weighted
            && candidate.is_told_from_nothing
            && self.is_most(candidate, last.squares() - candidate.fitted.squares())
    }

    /// Whether so much, taken by an effect of the catalogue, is most of what the last model misses and no small part of what the study's own
    /// does.
    fn is_most(&self, candidate: &Candidate, taken: f64) -> bool {
        !is_unlisted(candidate.effect)
            && taken > MOST * misfit(self.last())
            && taken > SMALL * misfit(&self.rungs[0])
    }
}

/// Why the selection stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stop {
    /// No candidate reaches the level.
    NothingSupported { best_p: f64 },
    /// The best of the rest is beyond chance, but the interval of its size holds nothing.
    SizeMayBeNothing { effect: Effect },
    /// What the best of the rest explains, another motion at restarts explains, too.
    OfRestarts { effect: Effect },
    /// The best supported candidate lowers the error by too little to matter.
    TooSmall { effect: Effect, share: f64 },
    /// What is left is rounding.
    Exact,
    /// What the best of the rest takes away is a trifle beside what the study's own model leaves.
    Trifle { effect: Effect, share: f64 },
    /// The model cannot carry more.
    Full,
    /// Whoever watches ended it; what it reached by then holds, what it would have reached is not known.
    Interrupted,
}

impl Candidate {
    /// Whether the data support it: beyond chance over the family, a gain in held-out tightenings, and a size that is told from
    /// nothing.
    pub fn is_supported(&self, settings: &DiagnoseSettings) -> bool {
        self.p_family <= settings.level
            && self.gains_clearly()
            && self.is_told_from_nothing
            && self.shows_beside_restarts
    }

    /// Whether of a long record it plainly leaves more than `other`.
    pub fn falls_short_of(&self, other: &Self, clusters: &Clusters) -> bool {
        leaves_more(&self.fitted, &other.fitted, &other.beyond(self), clusters)
    }

    /// Whether it explains hardly less than `best`.
    pub fn keeps_up_with(&self, best: &Self, clusters: &Clusters) -> bool {
        self.gain() > AS_MUCH * best.gain()
            && best.ahead_of(self) < EQUAL
            && !self.falls_short_of(best, clusters)
    }

    /// Whether it holds `simple` as a special case and takes hardly more or less of any cluster: it has been fitted to be that.
    fn does_nothing_but(&self, simple: &Self) -> bool {
        let apart: f64 = self.beyond(simple).iter().map(|gain| gain.abs()).sum();
        is_simpler(simple.effect, self.effect) && apart < NO_OTHER * simple.gain()
    }

    /// What held-out clusters gain beside `current`. Where leaving out a stretch leaves the others hardly a size, the gain in it has no
    /// bounds; a fall of the error has.
    pub fn gain_beside(&self, current: &Fitted) -> f64 {
        match current.are_stretches() {
            true => self.gain().min(current.squares() - self.fitted.squares()),
            false => self.gain(),
        }
    }

    /// The same as a share of what `current` misses.
    pub fn share_beside(&self, current: &Fitted) -> f64 {
        self.gain_beside(current) / misfit(current)
    }

    /// Whether held-out tightenings gain, and by more than one would expect of their scatter.
    fn gains_clearly(&self) -> bool {
        self.gain() > 0.0 && self.clearness() > 1.0
    }
}

/// The first supported candidate that removes enough to matter, beside what `current` leaves and what the study's own model
/// `first` left, or why there is none.
pub(crate) fn justified(
    ranking: &Ranking,
    current: &Fitted,
    first: &Fitted,
    settings: &DiagnoseSettings,
) -> Result<usize, Stop> {
    if current.is_exact {
        return Err(Stop::Exact);
    }
    let all = &ranking.candidates;
    let supported = |index: &usize| all[*index].is_supported(settings);
    let share = |index: usize, of: &Fitted| all[index].gain_beside(current) / of.squares();
    let matters = |index: &usize| share(*index, current) >= current.smallest_gain(settings);
    // What takes most of the rest leaves the other sizes wrong while it is missing, however little that is beside the beginning.
    let of_the_rest = settings.of_the_rest();
    let takes_much =
        |index: usize| !is_unlisted(all[index].effect) && share(index, current) > of_the_rest;
    let is_enough = |index: &usize| {
        current.is_weighted
            || share(*index, first) >= least_share(all[*index].effect)
            || takes_much(*index)
    };
    match (0..all.len()).find(supported) {
        Some(best) => {
            let mut those = (best..all.len()).filter(supported).filter(matters);
            let Some(next) = those.next() else {
                return Err(Stop::TooSmall {
                    effect: all[best].effect,
                    share: share(best, current),
                });
            };
            let mut those = std::iter::once(next).chain(those);
            those.find(is_enough).ok_or(Stop::Trifle {
                effect: all[next].effect,
                share: share(next, first),
            })
        }
        None => {
            let gaining = all.iter().filter(|candidate| candidate.gains_clearly());
            let is_beyond_chance = |one: &&Candidate| one.p_family <= settings.level;
            if let Some(one) = gaining.clone().find(is_beyond_chance) {
                let effect = one.effect;
                return Err(match one.shows_beside_restarts {
                    true => Stop::SizeMayBeNothing { effect },
                    false => Stop::OfRestarts { effect },
                });
            }
            Err(Stop::NothingSupported {
                best_p: gaining.map(|one| one.p_family).fold(1.0, f64::min),
            })
        }
    }
}

impl DiagnoseSettings {
    /// Share of what is left that an effect must take which takes next to nothing of all \[–\].
    pub(super) fn of_the_rest(&self) -> f64 {
        match self.for_prediction {
            true => OF_PREDICTIONS,
            false => MOST,
        }
    }
}

/// Whether `current` leaves so much of what the study's own model `first` left that a law in no catalogue could still be told. Where the
/// noise is known, any may.
pub(crate) fn laws_may_matter(first: &Fitted, current: &Fitted) -> bool {
    current.is_weighted || current.squares() >= MATTERS * first.squares()
}

/// Share of what the study's own model left that an effect must take away where the noise is not known.
pub(crate) fn least_share(effect: Effect) -> f64 {
    match is_unlisted(effect) {
        true => MATTERS,
        false => TRIFLE,
    }
}

/// Squared residual beyond the noise of each cluster; where the noise is not known, all of it.
pub(crate) fn misfits(fitted: &Fitted) -> Vec<f64> {
    let blocks = fitted.blocks.iter();
    blocks
        .map(|block| block.squares - noise(fitted, block.count))
        .collect()
}

/// Squared residual beyond the noise; where the noise is not known, all of it.
pub(crate) fn misfit(fitted: &Fitted) -> f64 {
    let squares = fitted.squares();
    (squares - noise(fitted, fitted.count())).max(squares * 1e-3)
}

/// What noise alone leaves of `count` squared residuals; nothing is known of it where the noise is not.
fn noise(fitted: &Fitted, count: usize) -> f64 {
    if fitted.is_weighted {
        count as f64
    } else {
        0.0
    }
}

/// Whether `one` plainly leaves more than `other` of a long record, by `lost` in each stretch: its few stretches hardly
/// make a statistic of their sum, and what wins one of them by much and loses most is another effect.
pub(crate) fn leaves_more(one: &Fitted, other: &Fitted, lost: &[f64], clusters: &Clusters) -> bool {
    !clusters.are_whole()
        && (one.squares() > PLAINLY_MORE * other.squares()
            || agreement(lost, other.scale()) > EQUAL)
}

/// Candidates that these data cannot tell from the one at `index`. A term in no catalogue is no twin of an effect: of
/// equals the effect that is known is named.
pub(crate) fn twins(ranking: &Ranking, index: usize, clusters: &Clusters) -> Vec<Effect> {
    let chosen = &ranking.candidates[index];
    ranking
        .candidates
        .iter()
        .filter(|other| {
            other.effect != chosen.effect
                && (is_unlisted(chosen.effect) || !is_unlisted(other.effect))
                && other.gains_clearly()
                && chosen.ahead_of(other) > -EQUAL
                && other.keeps_up_with(chosen, clusters)
                && !other.does_nothing_but(chosen)
        })
        .map(|other| other.effect)
        .collect()
}

#[cfg(test)]
mod tests;
