//! Out of a poor minimum: where an extension ends, the model without it may be begun again.

use crate::error::DiagnoseError;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::{Candidate, Ranking};
use crate::ranking::refit::may_be_astray;
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::{SelectionPath, misfit};
use crate::selection::thresholds::{EQUAL, ESCAPED, MOST, MOST_ESCAPES, SEEDS};

impl ModelSelection<'_> {
    /// Ranks what is missing beside the last model. Where a candidate's end leads that model itself to a better place, the place
    /// is the model's, and all are judged by it: credit belongs to what an effect adds, not to the way out of a poor minimum.
    /// Beside rounding nothing is looked for.
    pub fn rank_last(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        if path.last().is_exact {
            return Ok(());
        }
        path.ranking = self.rank(path)?;
        for _ in 0..MOST_ESCAPES {
            let Some(better) = self.elsewhere(path.last(), &path.ranking)? else {
                break;
            };
            path.replace_last(better);
            path.ranking = self.rank(path)?;
        }
        path.doubt_what_was_taken_out();
        Ok(())
    }

    /// The model of `current` from where extensions ended that may have led it out of a poor minimum, if that is plainly a better place.
    fn elsewhere(
        &self,
        current: &Fitted,
        ranking: &Ranking,
    ) -> Result<Option<Fitted>, DiagnoseError> {
        let mut best: Option<Fitted> = None;
        for candidate in self.ways_out(current, ranking) {
            self.watch.go_on()?;
            let from = Some(&candidate.fitted);
            let Ok(fitted) = fit_effects(self.cases, &current.effects, from, self.clusters) else {
                continue;
            };
            let known = best.as_ref().unwrap_or(current).squares();
            if fitted.squares() < ESCAPED * known {
                best = Some(fitted);
            }
        }
        Ok(best)
    }

    /// The best extensions of a few long records, unless they explain nearly all. Many tightenings lead each other; of theirs those
    /// that take most of the misfit, all of it from a few tightenings: these were led astray.
    fn ways_out<'r>(&self, current: &Fitted, ranking: &'r Ranking) -> Vec<&'r Candidate> {
        let best = ranking.candidates.iter().take(SEEDS);
        let is_astray = may_be_astray(&self.cases, current);
        let is_of_few =
            |one: &&Candidate| one.gain() > MOST * misfit(current) && one.clearness() < EQUAL;
        match self.clusters.are_whole() {
            true => best.filter(is_of_few).collect(),
            false => best.filter(|_| is_astray).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::DiagnoseSettings;
    use crate::tests::made_up::{candidate, ranking, with_selection};
    use snug_model::Effect::{self, Backlash, CubicStiffness, SecondMass, TorqueDelay};

    /// Of the misfit of six tightenings, 300 beyond the noise, all in the last.
    #[test]
    fn what_takes_most_and_all_of_it_from_few_is_a_way_out() {
        let current = Fitted::made_up(&[], &[100.0, 100.0, 100.0, 100.0, 100.0, 400.0], 100);
        let tried = ranking(vec![
            candidate(SecondMass, 1.0, &[0.0, 0.0, 0.0, 0.0, 0.0, 290.0]),
            candidate(CubicStiffness, 1.0, &[45.0, 48.0, 44.0, 46.0, 44.0, 45.0]),
            candidate(TorqueDelay, 1.0, &[0.0, 0.0, 0.0, 0.0, 0.0, 140.0]),
            candidate(Backlash, 1.0, &[0.0, 0.0, 0.0, 0.0, 0.0, 280.0]),
        ]);
        let ways = with_selection(&[], &DiagnoseSettings::default(), |selection| {
            selection.ways_out(&current, &tried)
        });
        let effects: Vec<Effect> = ways.iter().map(|one| one.effect).collect();
        assert_eq!(effects, [SecondMass]);
    }
}
