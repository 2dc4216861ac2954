//! One law in no catalogue in place of what was taken for it.
//!
//! Of few long records what is known comes in first, also where it leaves more: what the law does beyond it may be another effect. Where in
//! the end only others that stand in for the rest leave as little, or nothing does, the law that was passed over is the likelier story; so is
//! one that beside all that came in since leaves plainly less than what was taken for it.

use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::{Candidate, Ranking};
use crate::selection::model_selection::{ModelSelection, Step};
use crate::selection::path::{Ranked, SelectionPath};
use crate::selection::thresholds::{CAME_AS_NEAR, FEW_LAWS, MUCH_MORE, ONE_LAW, PLAINLY_ONE_LAW};
use snug_model::Effect;

impl ModelSelection<'_> {
    /// The rung to go back to, and what to add there; `None` where no law passed over does for what was added instead.
    pub fn one_law(&self, path: &SelectionPath) -> Result<Option<(usize, Step)>, DiagnoseError> {
        self.law_passed_over(path, &ONE_LAW, |place, ranking| {
            self.law_beside_the_others(path, place, ranking)
        })
    }

    /// The same before the end, of a law that plainly does for two that came in since: what else comes in beside those stands in for the rest
    /// of it.
    pub fn plainly_one_law(
        &self,
        path: &SelectionPath,
    ) -> Result<Option<(usize, Step)>, DiagnoseError> {
        self.law_passed_over(path, &PLAINLY_ONE_LAW, |_, _| Ok(None))
    }

    /// The first law that is `plainly` the likelier story, or that leaves at `most` so many times as much as all that came in since.
    fn law_passed_over(
        &self,
        path: &SelectionPath,
        most: &[f64; 3],
        plainly: impl Fn(usize, &Ranking) -> Result<Option<usize>, DiagnoseError>,
    ) -> Result<Option<(usize, Step)>, DiagnoseError> {
        let last = path.last();
        for (place, ranked) in path.ranked.iter().enumerate() {
            let Some(Ranked { beside, ranking }) = ranked else {
                continue;
            };
            let taken = &path.rungs[place + 1];
            let plain = plainly(place, ranking)?;
            let alone = || self.law_for_all(ranking, taken, last, most);
            let Some(index) = plain.or_else(alone) else {
                continue;
            };
            let index = self.special_case(beside, ranking, index);
            let (addition, fitted) = self.step(ranking, index, beside);
            let settled = self.settled(&fitted)?;
            if plain == Some(index) || does_for_all(&settled, taken, last, most) {
                return Ok(Some((place, (addition, settled))));
            }
        }
        Ok(None)
    }

    /// The first law of a ranking that does for all that came in since.
    fn law_for_all(
        &self,
        ranking: &Ranking,
        taken: &Fitted,
        last: &Fitted,
        most: &[f64; 3],
    ) -> Option<usize> {
        ranking.candidates.iter().position(|law| {
            is_unlisted(law.effect)
                && law.is_supported(self.settings)
                && does_for_all(&law.fitted, taken, last, most)
        })
    }

    /// Which of the laws that came nearest beside rung number `place` leaves plainly less than the last model does, in the place of what
    /// was added there and beside all that came in since.
    fn law_beside_the_others(
        &self,
        path: &SelectionPath,
        place: usize,
        ranking: &Ranking,
    ) -> Result<Option<usize>, DiagnoseError> {
        let (last, taken) = (path.last(), &path.rungs[place + 1]);
        let is_new = |effect: &&Effect| !path.rungs[place].effects.contains(effect);
        let Some(&known) = taken.effects.iter().find(is_new) else {
            return Ok(None);
        };
        if last.is_weighted || !last.effects.contains(&known) || is_unlisted(known) {
            return Ok(None);
        }
        let came_as_near = |law: &Candidate| {
            is_unlisted(law.effect)
                && law.is_supported(self.settings)
                && law.fitted.squares() <= CAME_AS_NEAR * taken.squares()
        };
        let all = ranking.candidates.iter().enumerate();
        let laws = all.filter(|(_, law)| came_as_near(law)).take(FEW_LAWS);
        let mut least = ONE_LAW[0] * last.squares();
        let mut best = None;
        for (index, law) in laws {
            if let Some(swapped) = self.with_other(last, known, law.effect)?
                && swapped.squares() <= least
            {
                least = swapped.squares();
                best = Some(index);
            }
        }
        Ok(best)
    }
}

/// Whether a model with one `law` is a likelier story than the `last`, which began with what was `taken` in the law's place: it leaves at `most`
/// so many times as much, where it needs as many effects, one fewer, or more fewer.
fn does_for_all(law: &Fitted, taken: &Fitted, last: &Fitted, most: &[f64; 3]) -> bool {
    let fewer = last.effects.len().checked_sub(law.effects.len());
    let most = fewer.map_or(0.0, |fewer| most[fewer.min(most.len() - 1)]);
    !last.is_weighted
        && law.squares() <= most * last.squares()
        && taken.squares() >= MUCH_MORE * law.squares()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{SAMPLES, term};
    use snug_model::Effect::{Backlash, CubicStiffness, MaxwellBranch};

    /// A model of a few long records whose noise nobody knows.
    fn left(effects: &[Effect], squares: f64) -> Fitted {
        Fitted::made_up(effects, &[squares], SAMPLES).unweighted()
    }

    /// A law that leaves 1 where a cubic spring left this, beside which the others then leave that.
    fn does(taken: f64, others: &[Effect], last: f64, most: &[f64; 3]) -> bool {
        let law = left(&[term("abs_x_x_law")], 1.0);
        let added = [&[CubicStiffness], others].concat();
        let taken = left(&[CubicStiffness], taken);
        does_for_all(&law, &taken, &left(&added, last), most)
    }

    #[test]
    fn the_more_were_added_in_its_place_the_less_a_law_must_leave() {
        for (others, most) in [
            (&[][..], 2.0),
            (&[Backlash], 1.0 / 0.98),
            (&[Backlash, MaxwellBranch], 1.0 / 1.05),
        ] {
            assert!(does(10.0, others, 1.01 * most, &ONE_LAW), "{others:?}");
            assert!(!does(10.0, others, 0.99 * most, &ONE_LAW), "{others:?}");
        }
    }

    /// Before the end a law takes no place of one effect, and of two where it leaves plainly less.
    #[test]
    fn on_the_way_a_law_must_plainly_do_for_two() {
        assert!(!does(10.0, &[], 10.0, &PLAINLY_ONE_LAW));
        assert!(does(10.0, &[Backlash], 1.34, &PLAINLY_ONE_LAW));
        assert!(!does(10.0, &[Backlash], 1.32, &PLAINLY_ONE_LAW));
    }

    #[test]
    fn what_was_as_near_as_the_law_keeps_its_place() {
        assert!(does(3.1, &[Backlash], 1.5, &ONE_LAW));
        assert!(!does(2.9, &[Backlash], 1.5, &ONE_LAW));
    }

    #[test]
    fn known_noise_says_itself_which_is_nearer() {
        let law = Fitted::made_up(&[term("abs_x_x_law")], &[1.0], SAMPLES);
        let last = Fitted::made_up(&[CubicStiffness], &[10.0], SAMPLES);
        assert!(!does_for_all(&law, &last, &last, &ONE_LAW));
    }
}
