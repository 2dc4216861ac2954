//! Effects that come in because somebody says so, not because they are the best.

use crate::error::DiagnoseError;
use crate::pooled::fit::fit_named;
use crate::pooled::fitted::Fitted;
use crate::question::Begun;
use crate::ranking::applicability::candidates;
use crate::ranking::rank::{Candidate, Ranking, rank};
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::SelectionPath;
use crate::selection::thresholds::ESCAPED;
use snug_model::Effect;

impl ModelSelection<'_> {
    /// Adds those of `begun` one after the other that can be run and that `comes_in`, asked with the candidate and by how much the squared
    /// error falls.
    pub(super) fn put_in(
        &self,
        begun: &[Begun],
        path: &mut SelectionPath,
        comes_in: impl Fn(&Candidate, f64) -> bool,
    ) -> Result<(), DiagnoseError> {
        for Begun { effect, values } in begun {
            let ranking = self.rank_these(path.last(), *effect)?;
            let index = ranking.candidates.iter().position(|c| c.effect == *effect);
            let Some(index) = index else { continue };
            let (addition, fitted) = self.step(&ranking, index, path.last());
            let settled = self.begun_with(self.settled(&fitted)?, values);
            let falls = path.last().squares() - settled.squares();
            if comes_in(&ranking.candidates[index], falls) {
                path.ranking = ranking;
                path.add(addition, settled);
            }
        }
        Ok(())
    }

    /// The fit from where these parameters have these values, if that is plainly lower than `settled`: a rig that is thrown back and forth
    /// leads one from the usual values astray.
    fn begun_with(&self, settled: Fitted, values: &[(String, f64)]) -> Fitted {
        if values.is_empty() {
            return settled;
        }
        let (cases, clusters) = (self.cases, self.clusters);
        let known = fit_named(cases, &settled.effects, &settled, values, clusters);
        let is_lower = |known: &Fitted| known.squares() < ESCAPED * settled.squares();
        known.ok().filter(is_lower).unwrap_or(settled)
    }

    /// The ranking, with `effect` among the candidates whatever it is.
    fn rank_these(&self, current: &Fitted, effect: Effect) -> Result<Ranking, DiagnoseError> {
        let mut all = candidates(&self.cases, current, self.custom)?;
        if !all.contains(&effect) {
            all.push(effect);
        }
        self.watch.begin(&format!("adding {}", effect.name()))?;
        let (cases, clusters, settings) = (self.cases, self.clusters, self.settings);
        rank(cases, current, &all, clusters, settings, 0, self.watch)
    }
}
