//! A selection that was made on records of a lower rate, with its models fitted to every sample.

use crate::error::DiagnoseError;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::selection::may_be_nothing::take_out_what_may_be_nothing;
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::SelectionPath;
use rayon::prelude::*;

impl ModelSelection<'_> {
    /// `path` with every model fitted to all samples from where it ended, the study's own as `compared` where that is better, and what
    /// the candidates gain in proportion to the samples. What every sample says may be nothing goes: in fewer samples an input that is held looks
    /// late.
    pub fn at_full_rate(
        &self,
        mut path: SelectionPath,
        compared: SelectionPath,
    ) -> Result<SelectionPath, DiagnoseError> {
        let watch = self.watch.to_the_end();
        watch.begin("fitting every sample")?;
        let at_full_rate =
            |fitted: &Fitted| fit_effects(self.cases, &fitted.effects, Some(fitted), self.clusters);
        // What stretches that took no part gain has no bounds, what is left has: that is what is said of every sample.
        let slow = path.last().clone();
        for candidate in &mut path.ranking.candidates {
            let (gain, bounded) = (candidate.gain(), candidate.gain_beside(&slow));
            if bounded > 0.0 && bounded < gain {
                candidate
                    .gains
                    .iter_mut()
                    .for_each(|one| *one *= bounded / gain);
            }
        }
        let before = slow.squares();
        let rungs: Result<Vec<Fitted>, _> = path.rungs.par_iter().map(at_full_rate).collect();
        path.rungs = rungs?;
        let known = compared.rungs.into_iter();
        for (rung, known) in path.rungs.iter_mut().zip(known) {
            if known.squares() < rung.squares() {
                *rung = known;
            }
        }
        let grown = path.last().squares() / before;
        for candidate in &mut path.ranking.candidates {
            candidate.gains.iter_mut().for_each(|gain| *gain *= grown);
        }
        if let Some(chosen) = path.chosen {
            let chosen = &mut path.ranking.candidates[chosen];
            chosen.fitted = at_full_rate(&chosen.fitted)?;
        }
        let to_the_end = ModelSelection {
            watch: &watch,
            ..*self
        };
        let ranking = std::mem::take(&mut path.ranking);
        take_out_what_may_be_nothing(&to_the_end, &mut path, 1)?;
        path.ranking = ranking;
        Ok(path)
    }
}
