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
        for one in begun {
            self.watch.begin(&format!("adding {}", one.effect.name()))?;
            let current = path.last();
            let does = |index: usize, ranking: &Ranking, settled: &Fitted| {
                let falls = current.squares() - settled.squares();
                comes_in(&ranking.candidates[index], falls)
            };
            // Where it is known where it begins, what does not come in by itself does not among all the others.
            if !one.values.is_empty() {
                match self.begun_among(&[one.effect], current, one)? {
                    Some((index, ranking, settled)) if does(index, &ranking, &settled) => {
                        self.must_be_resolved(&settled)?;
                    }
                    _ => continue,
                }
            }
            let mut all = candidates(&self.cases, current, self.custom)?;
            if !all.contains(&one.effect) {
                all.push(one.effect);
            }
            if let Some((index, ranking, settled)) = self.begun_among(&all, current, one)?
                && does(index, &ranking, &settled)
            {
                let (addition, _) = self.step(&ranking, index, current);
                path.ranking = ranking;
                path.add(addition, settled);
            }
        }
        Ok(())
    }

    /// The ranking of `all` beside `current`, where among them the one that is `begun` stands, and the fit with that: from where it is begun,
    /// if that leads plainly lower than the usual values. A rig that is thrown back and forth leads one from there astray.
    fn begun_among(
        &self,
        all: &[Effect],
        current: &Fitted,
        begun: &Begun,
    ) -> Result<Option<(usize, Ranking, Fitted)>, DiagnoseError> {
        let (cases, clusters, settings) = (self.cases, self.clusters, self.settings);
        let mut ranking = rank(cases, current, all, clusters, settings, 0, self.watch)?;
        let is_it = |one: &Candidate| one.effect == begun.effect;
        let Some(index) = ranking.candidates.iter().position(is_it) else {
            return Ok(None);
        };
        let candidate = &mut ranking.candidates[index];
        let settled = self.settled(&candidate.fitted)?;
        if begun.values.is_empty() {
            return Ok(Some((index, ranking, settled)));
        }
        let known = fit_named(cases, &settled.effects, &settled, &begun.values, clusters);
        let is_lower = |known: &Fitted| known.squares() < ESCAPED * settled.squares();
        let settled = match known.ok().filter(is_lower) {
            Some(known) => {
                candidate.ends_elsewhere(known.clone(), &cases, current, all.len());
                known
            }
            None => settled,
        };
        Ok(Some((index, ranking, settled)))
    }
}
