//! Which verdict the data allow, and what to check where no model fits.

use crate::library::is_unlisted;
use crate::pooled::equation::PlainEquation;
use crate::pooled::fitted::Fitted;
use crate::pooled::thresholds::AT_FLOOR;
use crate::question::Goal;
use crate::selection::simpler::is_plain;
use crate::selection::thresholds::MOST;
use crate::verdict::answer::{Examination, Judged, Places};
use crate::verdict::changes::changes;
use crate::verdict::earned::{self, leaves_a_motion};
use crate::verdict::floor;
use crate::verdict::thresholds::{
    ALL_BUT_EXPLAINED, BESIDE_EFFECTS, MOSTLY_EXPLAINED, REPEATS, WIDER,
};
use snug_campaign::Verdict;
use snug_campaign::words::explained::{Explained, is_white};
use snug_campaign::words::suspicion::{FailedFit, OtherUnits, StandsApart, Suspicion};

impl Examination<'_> {
    /// The verdict by candidates, unless the rig changes while it is measured and it cannot be that.
    pub(super) fn judged(&self, places: &Places) -> Judged {
        let plain = PlainEquation::of(&self.cases);
        let plain = plain.as_ref();
        let of_models = || {
            // What no simulation misses did not change.
            let is_known = !self.path.is_interrupted() && !places.leaves_noise;
            let plain = plain.filter(|_| is_known)?;
            changes(plain, self.cases, &self.path.rungs, WIDER)
        };
        let changes = self.changes.clone().or_else(of_models);
        let (verdict, mut suspicions) = self.verdict_and_suspicions(places, plain);
        let is_followed = changes.is_none() || Self::follows_changes(verdict, places);
        let stands_apart = self.stands_apart(verdict, places);
        let verdict = match is_followed && stands_apart.is_none() {
            true => verdict,
            false => Verdict::Undecided,
        };
        let explained = places.explained.as_ref();
        let leaves_more = || {
            self.is_more_than_noise(explained)
                || leaves_a_motion(&self.path, self.settings, explained)
                || !is_followed
                || stands_apart.is_some()
        };
        let is_more_than_noise = verdict == Verdict::Undecided && leaves_more();
        suspicions.extend(stands_apart.map(Suspicion::StandsApart));
        Judged {
            is_more_than_noise,
            verdict,
            suspicions,
            changes,
        }
    }

    /// The verdict, and what to check where no model fits. A comparison leaves it at that only where there is something to check:
    /// an effect that does most of the work is for `diagnose` to find.
    fn verdict_and_suspicions(
        &self,
        places: &Places,
        plain: Option<&PlainEquation<'_>>,
    ) -> (Verdict, Vec<Suspicion>) {
        let is_white = (places.explained.as_ref()).is_some_and(|all| is_white(all.neighbours));
        let wrong = [
            self.turned_round.clone().map(Suspicion::TurnedRound),
            self.units_that_differ(true).map(Suspicion::Units),
            earned::restarted_too_seldom(self.cases, self.path.last())
                .map(Suspicion::RestartedTooSeldom),
            plain
                .and_then(|plain| self.failed_fit(plain))
                .map(Suspicion::FailedFit),
            earned::is_undriven(self.question.cases).then_some(Suspicion::Undriven),
        ];
        let wrong: Vec<Suspicion> = wrong.into_iter().flatten().collect();
        let is_open = wrong.is_empty() && !self.is_declared_wrong;
        let verdict = match is_open || self.path.is_interrupted() {
            true => self.verdict(
                places.last().repeatable_share,
                places.explained.as_ref(),
                is_white,
            ),
            false => Verdict::NotFitted,
        };
        if let Some(hardly) = self.hardly_tried()
            && matches!(verdict, Verdict::Adequate | Verdict::Undecided)
        {
            return (Verdict::NotFitted, vec![hardly]);
        }
        let (Verdict::NotFitted, Some(explained)) = (verdict, places.explained) else {
            return (verdict, wrong);
        };
        let suspicions =
            earned::suspicions(self.question.cases, explained, places.left_over.clone());
        let suspicions = match wrong.is_empty() {
            true => suspicions,
            false => beside(wrong, suspicions),
        };
        match (&self.question.goal, suspicions.as_slice()) {
            (Goal::Compare, [Suspicion::NoOscillator]) => (Verdict::Undecided, Vec::new()),
            _ => (verdict, suspicions),
        }
    }

    /// Whether this may be the verdict on a rig that changes while it is measured. A law that is in no catalogue only stands for the change
    /// there, and no model is adequate while a motion is left.
    fn follows_changes(verdict: Verdict, places: &Places) -> bool {
        let leaves_a_motion = places
            .explained
            .as_ref()
            .is_some_and(Explained::leaves_a_motion);
        match verdict {
            Verdict::UnlistedEffect => false,
            Verdict::Adequate => !leaves_a_motion,
            _ => true,
        }
    }

    /// Recordings of which a model that would be adequate otherwise, or nearly, leaves far more than of the others.
    fn stands_apart(&self, verdict: Verdict, places: &Places) -> Option<StandsApart> {
        let is_nearly = matches!(verdict, Verdict::Adequate | Verdict::Undecided);
        let was_looked = !self.path.ranking.candidates.is_empty() && !self.path.is_interrupted();
        let apart = places.stands_apart.clone();
        apart.filter(|_| is_nearly && was_looked)
    }

    /// That most candidates could not be tried, if so: then nothing is known of what is missing.
    fn hardly_tried(&self) -> Option<Suspicion> {
        let ranking = &self.path.ranking;
        let (tried, not) = (ranking.candidates.len(), ranking.impossible.len());
        let of = tried + not;
        (not > tried && !self.path.is_interrupted()).then_some(Suspicion::HardlyTried { tried, of })
    }

    /// Recordings that stand apart by a prefix of a unit, or else by another load.
    pub(super) fn units_that_differ(&self, is_prefix: bool) -> Option<OtherUnits> {
        let units = self.units.clone();
        units.filter(|units| units.is_prefix == is_prefix)
    }

    /// How the best model falls short of a plain regression, if it does.
    fn failed_fit(&self, plain: &PlainEquation<'_>) -> Option<FailedFit> {
        let candidates = &self.path.ranking.candidates;
        let best = (self.path.chosen).map_or(self.path.last(), |index| &candidates[index].fitted);
        let were_tried = !candidates.is_empty();
        floor::shortfall(plain, self.cases, best, were_tried)
    }

    /// `is_white` where what is left is as white as noise, whatever candidates promise.
    fn verdict(
        &self,
        repeatable: Option<f64>,
        explained: Option<&Explained>,
        is_white: bool,
    ) -> Verdict {
        let (last, candidates) = (self.path.last(), &self.path.ranking.candidates);
        let added_unlisted = self
            .path
            .additions
            .iter()
            .any(|one| is_unlisted(one.effect));
        if self.path.is_interrupted() {
            return Verdict::Undecided;
        }
        let best = (self.path.chosen).map_or(last, |index| &candidates[index].fitted);
        let share = earned::share(self.question.cases, best);
        if !earned::is_a_model(share) {
            return Verdict::NotFitted;
        }
        if self.path.ranking.candidates.is_empty() {
            return match last.is_at_floor() {
                true => Verdict::Adequate,
                false => Verdict::Undecided,
            };
        }
        if let Some(chosen) = self.path.chosen {
            return match is_unlisted(candidates[chosen].effect) {
                true if describes(&candidates[chosen].fitted, last) => Verdict::UnlistedEffect,
                true => Verdict::Undecided,
                false => Verdict::MissingEffect,
            };
        }
        if added_unlisted {
            return match describes(last, &self.path.rungs[0]) {
                true => Verdict::UnlistedEffect,
                false => Verdict::Undecided,
            };
        }
        // What takes several effects and still leaves more than noise is something else, in pieces.
        if self.path.additions.len() > 1 && last.is_beyond_noise() {
            return Verdict::UnlistedEffect;
        }
        let floor = match self.path.additions.is_empty() {
            true => AT_FLOOR,
            false => BESIDE_EFFECTS,
        };
        if last.is_weighted && last.error() > floor && repeatable.is_some_and(|r| r > REPEATS) {
            return Verdict::UnlistedEffect;
        }
        match self.path.is_promising(self.settings) {
            Some(_) if !is_white => Verdict::Undecided,
            _ if self.is_more_than_noise(explained) && !is_white => Verdict::Undecided,
            _ if earned::keeps_the_promise(share, self.question.cases) => Verdict::Adequate,
            _ => Verdict::NotFitted,
        }
    }

    /// Whether more is left than the noise is uncertain by, or where nobody knows the noise a good part of the output, though no candidate
    /// is chosen or promising: that is no adequate model. A model that is restarted from the measured motion again and again predicts
    /// nearly all, whatever it lacks: one that was given nothing must leave noise. Several effects that leave a motion may be something else,
    /// in pieces. Beside an effect that lets go, the instants at which the grip sets in are never quite right.
    fn is_more_than_noise(&self, explained: Option<&Explained>) -> bool {
        let last = self.path.last();
        let lets_go = last.effects.iter().any(|one| one.has_unilateral_contact());
        let floor = if lets_go { BESIDE_EFFECTS } else { AT_FLOOR };
        let leaves_much = match earned::share(self.question.cases, last) {
            Some(share) => {
                let leaves_a_motion = explained.is_some_and(Explained::leaves_a_motion);
                let was_given = &self.path.additions;
                let may_lack = match was_given.as_slice() {
                    [] => self.cases.are_restarted(),
                    [_] => false,
                    several => {
                        let are_plain = several.iter().all(|one| is_plain(one.effect));
                        share < ALL_BUT_EXPLAINED && !are_plain
                    }
                };
                share < MOSTLY_EXPLAINED || (leaves_a_motion && may_lack)
            }
            None => last.error() > floor,
        };
        leaves_much && self.path.chosen.is_none() && self.path.is_promising(self.settings).is_none()
    }
}

/// Whether a model with a law that is in no catalogue says what the one `before` lacks: where nobody knows the noise, a law that leaves most
/// of the error describes nothing, it only comes closest.
fn describes(with: &Fitted, before: &Fitted) -> bool {
    with.is_weighted || with.squares() <= MOST * before.squares()
}

/// What is `wrong` with the recordings or the fit, and what else is suspected. With the wrong sign or column no fit means anything, and
/// neither do differences between recordings' numbers.
fn beside(wrong: Vec<Suspicion>, suspected: Vec<Suspicion>) -> Vec<Suspicion> {
    let is_of_channels =
        |one: &Suspicion| matches!(one, Suspicion::Sign(_) | Suspicion::Swapped(_));
    let (mut all, others): (Vec<Suspicion>, Vec<Suspicion>) =
        suspected.into_iter().partition(is_of_channels);
    let is_right = |one: &Suspicion| all.is_empty() || !matches!(one, Suspicion::Units(_));
    let wrong: Vec<Suspicion> = wrong.into_iter().filter(is_right).collect();
    all.extend(wrong);
    all.extend(
        others
            .into_iter()
            .filter(|one| *one != Suspicion::NoOscillator),
    );
    all
}
