//! Whether an effect is real: what it takes of tightenings that took no part in finding its size, against what chance does.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::data::cases::Tally;
use crate::data::watch::Watch;
use crate::error::DiagnoseError;
use crate::ranking::applicability::candidates;
use crate::ranking::rank::rank;
use crate::selection::path::{misfits, twins};
use crate::selection::thresholds::EQUAL;
use snug_model::Effect;

/// What tightenings that took no part say of one effect beside a model without it.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// Share \[–\] of what the model without it leaves beyond the noise that it takes, its size found without the tightening at hand.
    pub share: f64,
    /// Standard error of that over the tightenings \[–\].
    pub share_error: f64,
    /// Chance that the best of so many candidates looks as good where nothing is missing.
    pub p_family: f64,
    /// How many candidates that is.
    pub family: usize,
    /// Whether it is supported: beyond chance at the study's level, a clear gain, and a size told from nothing.
    pub is_supported: bool,
    /// Whether the interval of its size excludes nothing.
    pub is_told_from_nothing: bool,
    /// Effects that these data cannot tell from it.
    pub twins: Vec<Effect>,
    /// The effect that takes plainly more, if one does.
    pub better: Option<Effect>,
    /// Campaigns of nothing but noise that were scored likewise, and in how many of them something was called supported.
    pub false_alarms: (usize, usize),
}

impl LiveCases {
    /// Tests `effect` beside the model of `without`, among everything that could be missing there; seconds, which `watch` may end.
    ///
    /// `None` where it cannot be simulated on this rig.
    ///
    /// # Errors
    /// [`DiagnoseError::Interrupted`], otherwise what the model refuses.
    pub fn held_out(
        &self,
        without: &LiveFit,
        effect: Effect,
        watch: &Watch<'_>,
    ) -> Result<Option<HeldOut>, DiagnoseError> {
        let tally = Tally::default();
        let (cases, current) = (self.counted(&tally), &without.fitted);
        let mut all = candidates(&self.cases, current, &self.custom)?;
        if !all.contains(&effect) {
            all.push(effect);
        }
        let settings = &self.settings;
        let campaigns = settings.control_campaigns;
        let ranking = rank(
            cases,
            current,
            &all,
            self.clusters,
            settings,
            campaigns,
            watch,
        )?;
        watch.go_on()?;
        let candidates = &ranking.candidates;
        let Some(place) = candidates.iter().position(|one| one.effect == effect) else {
            return Ok(None);
        };
        let tested = &candidates[place];
        let better = (candidates.iter())
            .filter(|other| other.is_supported(settings) && other.ahead_of(tested) > EQUAL)
            .max_by(|a, b| a.gain().total_cmp(&b.gain()));
        Ok(Some(HeldOut {
            share: tested.share_beside(current),
            share_error: tested.share_error(&misfits(current)),
            p_family: tested.p_family,
            family: all.len(),
            is_supported: tested.is_supported(settings),
            is_told_from_nothing: tested.is_told_from_nothing,
            twins: twins(&ranking, place, &self.clusters),
            better: better.map(|one| one.effect),
            false_alarms: ranking.control,
        }))
    }
}
