//! Of effects that explain nearly as much of a few long records, the simpler.
//!
//! A friction that comes and goes with the way, or with the speed, is dry friction with a shape: of records that hardly show the shape
//! the richer law explains a little more, as any law of more numbers does, and an engineer says dry friction all the same. Which
//! of the two is right may show only beside another effect, so that the others are looked at again when one has been added.

use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::ranking::applicability::{can_act, can_stand_beside};
use crate::ranking::kin::{are_kin, is_of_all, is_simpler};
use crate::ranking::pairs::Pair;
use crate::ranking::rank::{Candidate, Ranking, rank};
use crate::selection::model_selection::{ModelSelection, Step};
use crate::selection::path::{Addition, SelectionPath};
use crate::selection::thresholds::{MANY_TIMES, MOST_OF_RICHER, NEARLY_AS_MUCH, TRIFLE};
use snug_model::{Effect, Law};

/// Whether the model `simple` does for `rich` where the noise is not known: what it leaves more is a small share of what `before` left, of
/// many recordings a trifle, and less than all that is left otherwise.
pub(super) fn does_for(simple: &Fitted, rich: &Fitted, before: &Fitted) -> bool {
    let little = match rich.are_stretches() {
        true => NEARLY_AS_MUCH,
        false => TRIFLE,
    };
    let more = simple.squares() - rich.squares();
    let is_little = more <= little * before.squares() && more <= rich.squares();
    !rich.is_weighted && is_little
}

/// Whether it is one of the effects of which a plain regression knows: dry friction and an offset are there in most rigs.
pub(crate) fn is_plain(effect: Effect) -> bool {
    (Effect::PLAIN.iter()).any(|plain| plain.name() == effect.name())
}

impl Candidate {
    /// Whether it does for `rich` beside the model `before`. What is known does for a law that nobody knows, and what all recordings
    /// share for what each has of its own, where it explains most of what that does: the other may come in beside it, unless it is this, another
    /// for each. Not where that leaves next to nothing beside what this does.
    pub fn does_for(&self, rich: &Self, before: &Fitted) -> bool {
        let fall = |one: &Self| before.squares() - one.fitted.squares();
        let is_open = before.are_stretches() && !before.is_weighted;
        let may_wait = is_open
            && (rich.is_less_known_than(self) || rich.has_more_own_than(self))
            && !is_of_all(self.effect, rich.effect);
        let explains_most = fall(self) >= MOST_OF_RICHER * fall(rich)
            && self.fitted.squares() <= MANY_TIMES * rich.fitted.squares();
        (may_wait && explains_most) || does_for(&self.fitted, &rich.fitted, before)
    }

    /// Whether it needs more to say than `other`: more numbers for what is easily taken for it, numbers of its own for each recording,
    /// a law that nobody knows, or one that fewer rigs have.
    pub fn is_richer_than(&self, other: &Self) -> bool {
        self.is_less_known_than(other)
            || self.has_more_own_than(other)
            || is_simpler(other.effect, self.effect)
            || self.effect.likelier() == Some(other.effect.name())
    }

    fn is_less_known_than(&self, other: &Self) -> bool {
        is_unlisted(self.effect) && !is_unlisted(other.effect)
    }

    /// A motor that is turned one way in each recording is as far off by dry friction as by a zero that moves between them.
    fn has_more_own_than(&self, other: &Self) -> bool {
        self.fitted.more_for_each_recording() > other.fitted.more_for_each_recording()
    }

    /// How much there is to say: sizes and shapes, and of two that have as many that there is a likelier story comes after.
    pub fn has_to_say(&self) -> (usize, bool) {
        (self.number_count(), self.effect.likelier().is_some())
    }

    /// Sizes and shapes of the effect, those of which a few long recordings have one each counted for each.
    fn number_count(&self) -> usize {
        let beyond_the_first = self.fitted.more_for_each_recording();
        self.effect.description().parameters.len() + beyond_the_first
    }
}

impl ModelSelection<'_> {
    /// Exchanges every added effect for a simpler one that does for it beside the others, or for a richer one for which it does not do.
    /// One that stands alone has been compared with its kin as it was chosen.
    pub fn exchange_kin(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        if self.clusters.are_whole() || path.additions.len() < 2 {
            return Ok(());
        }
        for place in 0..path.additions.len() {
            let effect = path.additions[place].effect;
            let Some(other) = self.better_kin(path, effect)? else {
                continue;
            };
            let settled = self.settled(&other.fitted)?;
            let known = &mut path.additions[place];
            *known = Addition {
                effect: other.effect,
                p_family: other.p_family,
                twins: vec![effect],
                ..known.clone()
            };
            path.replace_last(settled);
        }
        Ok(())
    }

    /// Dry friction and an offset that all recordings share, where together they do for a load that each has of its own, the `chosen`: a
    /// motor that is turned one way in each recording is held back as by such a load.
    pub(super) fn shared_in_place_of(
        &self,
        current: &Fitted,
        ranking: &Ranking,
        chosen: usize,
    ) -> Result<Option<Vec<Step>>, DiagnoseError> {
        let all = &ranking.candidates;
        if all[chosen].effect.of_all().is_none() {
            return Ok(None);
        }
        let plain: Vec<usize> = (0..all.len())
            .filter(|&one| is_plain(all[one].effect))
            .collect();
        let [first, second] = plain[..] else {
            return Ok(None);
        };
        let own = &all[chosen];
        let pair = Pair {
            effects: [all[first].effect, all[second].effect],
            p_family: own.p_family,
        };
        let found = self.together(current, ranking, pair)?;
        let found = found.filter(|pair| does_for(&pair.both.fitted, &own.fitted, current));
        Ok(found.map(|pair| self.as_steps(current, ranking, pair)))
    }

    /// Effects of the catalogue, as this rig has them, that could stand in place of `effect` in the model `last`, of those that are
    /// `like` it.
    pub(super) fn in_place_of(
        &self,
        effect: Effect,
        last: &Fitted,
        like: impl Fn(Effect, Effect) -> bool,
    ) -> Result<Vec<Effect>, DiagnoseError> {
        let (case, model) = (&self.cases[0], &self.cases[0].model);
        let is_there = |other: Effect| last.effects.iter().any(|one| one.name() == other.name());
        let mut others = last.effects.clone();
        others.retain(|known| *known != effect);
        let mut all: Vec<Effect> = (Effect::ALL.iter())
            .filter(|&&other| like(other, effect) && !is_there(other) && can_act(other, case))
            .map(|&other| model.scale().effect(other, model.rig()))
            .collect::<Result<_, _>>()?;
        all.retain(|&other| can_stand_beside(&others, other, case));
        Ok(all)
    }

    /// What does better than `effect` beside the other effects of the last model.
    fn better_kin(
        &self,
        path: &SelectionPath,
        effect: Effect,
    ) -> Result<Option<Candidate>, DiagnoseError> {
        let (last, first) = (path.last(), &path.rungs[0]);
        let kin = self.in_place_of(effect, last, are_kin)?;
        if kin.is_empty() {
            return Ok(None);
        }
        let mut others = last.effects.clone();
        others.retain(|known| *known != effect);
        self.watch
            .begin(&format!("looking for what does for {}", effect.name()))?;
        let Ok(without) = fit_effects(self.cases, &others, Some(last), self.clusters) else {
            return Ok(None);
        };
        let (clusters, settings) = (self.clusters, self.settings);
        let ranked = rank(
            self.cases, &without, &kin, clusters, settings, 0, self.watch,
        )?;
        let is_better = |other: &Candidate| {
            other.is_supported(settings)
                && match is_simpler(other.effect, effect) {
                    true => does_for(&other.fitted, last, first),
                    false => !does_for(last, &other.fitted, first),
                }
        };
        Ok(ranked.candidates.into_iter().find(is_better))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{candidate, term};
    use snug_model::Effect::{
        BoucWen, CoulombFriction, OutputOffset, TorqueDeadZone, TorqueOffset,
    };

    /// A record of which a model leaves so much in each of eight stretches, the noise not known.
    fn leaves(squares: f64) -> Fitted {
        Fitted::made_up(&[], &[squares; 8], 100)
            .in_stretches()
            .unweighted()
    }

    fn with(effect: Effect, squares: f64) -> Candidate {
        Candidate {
            fitted: leaves(squares),
            ..candidate(effect, 0.001, &[1.0; 8])
        }
    }

    /// Of 100: 3.9 % more is little, and less than the 4 that are left otherwise; 4.1 is more than they are, 5.1 is more than 5 %.
    #[test]
    fn a_simpler_model_does_where_it_leaves_a_little_more() {
        let before = leaves(100.0);
        assert!(does_for(&leaves(7.9), &leaves(4.0), &before));
        assert!(!does_for(&leaves(8.1), &leaves(4.0), &before));
        assert!(!does_for(&leaves(15.1), &leaves(10.0), &before));
        assert!(
            does_for(&leaves(3.0), &leaves(4.0), &before),
            "it leaves less"
        );
    }

    /// Of 100 whole recordings leave a trifle more by 0.09, not by 0.11.
    #[test]
    fn whole_tightenings_and_known_noise_are_judged_otherwise() {
        let whole = |squares: f64| Fitted::made_up(&[], &[squares; 8], 100).unweighted();
        assert!(does_for(&whole(4.09), &whole(4.0), &whole(100.0)));
        assert!(!does_for(&whole(4.11), &whole(4.0), &whole(100.0)));
        let weighted = |squares: f64| Fitted::made_up(&[], &[squares; 8], 100).in_stretches();
        assert!(!does_for(&weighted(7.0), &weighted(4.0), &weighted(100.0)));
    }

    /// Dry friction takes 79 of what a law that nobody knows takes 97 of, and 70.
    #[test]
    fn what_is_known_comes_before_a_law_that_nobody_knows() {
        let (before, law) = (leaves(100.0), with(term("v3_law"), 3.0));
        let friction = |squares: f64| with(CoulombFriction, squares);
        assert!(law.is_richer_than(&friction(21.0)) && !friction(21.0).is_richer_than(&law));
        assert!(friction(21.0).does_for(&law, &before));
        assert!(!friction(30.0).does_for(&law, &before));
        let loops = with(BoucWen, 3.0);
        assert!(loops.is_richer_than(&friction(5.0)));
        assert!(friction(5.0).does_for(&loops, &before));
        assert!(!friction(21.0).does_for(&loops, &before));
    }

    /// Of a motor that is driven the way it goes, a dead zone takes 95 of 100 and dry friction 92, or 88.
    #[test]
    fn of_two_that_explain_as_much_the_likelier_story_comes_first() {
        let (before, zone) = (leaves(100.0), with(TorqueDeadZone, 5.0));
        let friction = |squares: f64| with(CoulombFriction, squares);
        assert!(zone.is_richer_than(&friction(8.0)) && !friction(8.0).is_richer_than(&zone));
        assert!(friction(8.0).does_for(&zone, &before));
        assert!(!friction(12.0).does_for(&zone, &before));
        assert!(friction(8.0).has_to_say() < zone.has_to_say());
    }

    /// Of eight recordings a zero that moves from one to the next takes 92 of the error, one offset of them all 80 or 60.
    #[test]
    fn what_all_recordings_share_comes_before_what_each_has_of_its_own() {
        let before = leaves(100.0);
        let mut zeros = with(OutputOffset, 8.0);
        zeros.fitted = zeros.fitted.with_own(&["y0"], vec![vec![1.0]; 8], 1);
        let offset = |squares: f64| with(TorqueOffset, squares);
        assert!(zeros.is_richer_than(&offset(20.0)) && !offset(20.0).is_richer_than(&zeros));
        assert!(offset(20.0).does_for(&zeros, &before));
        assert!(!offset(40.0).does_for(&zeros, &before));
        zeros.fitted = leaves(0.05).with_own(&["y0"], vec![vec![1.0]; 8], 1);
        assert!(!offset(11.0).does_for(&zeros, &before), "220 times as much");
        assert!(offset(4.0).does_for(&zeros, &before), "80 times");
        assert_eq!((zeros.number_count(), offset(20.0).number_count()), (8, 1));
    }
}
