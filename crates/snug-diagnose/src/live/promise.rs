//! What candidates promise beside a fit, from the score test alone: no refit, nothing judged.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::data::cases::Tally;
use crate::error::DiagnoseError;
use crate::pooled::model::PooledModel;
use crate::ranking::score_test::{Control, Scorer};
use crate::ranking::sensitivity::Column;
use snug_model::Effect;
use std::ops::Range;

impl LiveCases {
    /// The share \[–\] of what `base` leaves beyond the noise that each candidate is predicted to take away beside `fit`: 1 where
    /// that is all, hardly anything once what is missing is in `fit`.
    ///
    /// It is a first-order prediction with every tightening's m, c, k free to follow; it sorts, and proves nothing.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn promises(
        &self,
        fit: &LiveFit,
        base: &LiveFit,
        candidates: &[Effect],
    ) -> Result<Vec<f64>, DiagnoseError> {
        self.scored(fit, base, candidates, None)
    }

    /// The same of a stretch, the samples `within` every window, of which `base` leaves so much there as [`Self::as_fitted`] says. Every
    /// tightening's m, c, k follow over its whole window and not there alone.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn promises_within(
        &self,
        fit: &LiveFit,
        base: &LiveFit,
        candidates: &[Effect],
        within: &Range<usize>,
    ) -> Result<Vec<f64>, DiagnoseError> {
        self.scored(fit, base, candidates, Some(within))
    }

    fn scored(
        &self,
        fit: &LiveFit,
        base: &LiveFit,
        candidates: &[Effect],
        within: Option<&Range<usize>>,
    ) -> Result<Vec<f64>, DiagnoseError> {
        let tally = Tally::default();
        let cases = self.counted(&tally);
        let current = &fit.fitted;
        let pooled = PooledModel::shared_by(cases, &current.effects, &current.sharing)?;
        let scorer = Scorer::new(&pooled, current, self.clusters, Control::default());
        let scorer = match within {
            Some(samples) => scorer.within(samples.clone()),
            None => scorer,
        };
        let columns = scorer.score(candidates)?.columns;
        let misfit = base.misfit();
        let share = |effect: &Effect| {
            let own = columns.iter().filter(|column| column.effect == *effect);
            let gain = own.map(Column::predicted_gain).fold(0.0, f64::max);
            match misfit > 0.0 {
                true => (gain / misfit).clamp(0.0, 1.0),
                false => 0.0,
            }
        };
        Ok(candidates.iter().map(share).collect())
    }
}
