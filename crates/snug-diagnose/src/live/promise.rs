//! What candidates promise beside a fit, from the score test alone: no refit, nothing judged.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::data::cases::Tally;
use crate::error::DiagnoseError;
use crate::pooled::model::PooledModel;
use crate::ranking::score_test::{Control, Scorer};
use snug_model::Effect;

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
        let (tally, current) = (Tally::default(), &fit.fitted);
        let cases = self.counted(&tally);
        let pooled = PooledModel::shared_by(cases, &current.effects, &current.sharing)?;
        let scorer = Scorer::new(&pooled, current, self.clusters, Control::default());
        let columns = scorer.score(candidates)?.columns;
        let gains = columns.iter().map(|one| (one.effect, one.predicted_gain()));
        Ok(shares(candidates, gains, base.misfit()))
    }
}

/// The share of `misfit` that each candidate takes away by the direction that gains most.
pub(super) fn shares(
    candidates: &[Effect],
    gains: impl Iterator<Item = (Effect, f64)> + Clone,
    misfit: f64,
) -> Vec<f64> {
    let share = |effect: &Effect| {
        let own = gains.clone().filter(|(of, _)| of == effect);
        let gain = own.map(|(_, gain)| gain).fold(0.0, f64::max);
        match misfit > 0.0 {
            true => (gain / misfit).clamp(0.0, 1.0),
            false => 0.0,
        }
    };
    candidates.iter().map(share).collect()
}
