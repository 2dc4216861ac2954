//! An effect that the model has, and whose size is not the same for all: what is missing then is no other effect.

use crate::error::DiagnoseError;
use crate::pooled::sharing::Groups;
use crate::pooled::sizes::is_told_from_nothing;
use crate::ranking::paired_gain::{chance, gains};
use crate::ranking::rank::Candidate;
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::SelectionPath;

impl ModelSelection<'_> {
    /// Puts the last model with sizes that differ between groups before all candidates, where that explains as much of what is left
    /// as `next`; whether it did.
    pub(super) fn puts_differing_first(
        &self,
        path: &mut SelectionPath,
        next: Option<usize>,
    ) -> Result<bool, DiagnoseError> {
        let Some(fitted) = self.last_by_group(path, next)? else {
            return Ok(false);
        };
        let last = path.last();
        let mut effects = last.effects.iter();
        let differs =
            |effect: &&_| fitted.sharing.factor(**effect) != last.sharing.factor(**effect);
        let Some(&effect) = effects.find(differs) else {
            return Ok(false);
        };
        let gains = gains(&last.heldout_beyond_torque_noise(), &fitted);
        let forms = last.effects.len() * (1 + Groups::worth_trying(&self.cases).len());
        let first = Candidate {
            effect,
            score: 0.0,
            p_family: (chance(&gains, fitted.scale()) * forms as f64).min(1.0),
            is_told_from_nothing: is_told_from_nothing(&self.cases, &fitted, effect),
            shows_beside_restarts: true,
            fitted,
            gains,
        };
        if !first.is_supported(self.settings) {
            return Ok(false);
        }
        path.ranking.candidates.insert(0, first);
        path.chosen = Some(0);
        Ok(true)
    }
}
