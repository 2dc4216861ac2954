//! The tightenings on which models are tried, and the fit of one set of effects after the other.

use super::fit::LiveFit;
use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::data::follower::{FitStep, Follower};
use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fit::{fit_effects, fit_sharing};
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use crate::pooled::one_machine::one_machine_or_several;
use crate::pooled::sharing::Sharing;
use crate::question::Question;
use crate::ranking::applicability::candidates;
use crate::ranking::first_ranking::first_ranking;
use crate::ranking::refit::{Way, refit};
use crate::ranking::score_test::{Control, Scorer};
use crate::ranking::sensitivity::Column;
use crate::settings::DiagnoseSettings;
use snug_identify::FitTask;
use snug_least_squares::{PooledSettings, SolveError};
use snug_model::Effect;
use std::sync::atomic::AtomicBool;

/// Tightenings on which models are tried by hand.
///
/// Nothing is judged: a fit says what it leaves in the tightenings it was made from, and nothing of others.
pub struct LiveCases {
    pub(super) cases: Vec<FitTask<'static>>,
    pub(super) clusters: Clusters,
    pub(super) settings: DiagnoseSettings,
    pub(super) sharing: Sharing,
    pub(super) custom: Vec<Effect>,
    pub(super) each_its_own: bool,
}

impl LiveCases {
    /// The tightenings of a question; its effects are those of the model to begin with, its goal is nobody's.
    ///
    /// # Errors
    /// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::Identify`] where one was not measured, otherwise
    /// what the model or the fit refuses.
    pub fn new(
        question: &Question<'_>,
        cases: Vec<FitTask<'static>>,
        settings: DiagnoseSettings,
    ) -> Result<Self, DiagnoseError> {
        let tally = Tally::default();
        let clusters = Clusters::of(&cases);
        let counted = Cases::checked(&cases, &tally, "every one was left out")?;
        let (one, _) = one_machine_or_several(counted, &question.effects, clusters)?;
        let each_its_own = counted.are_of_one_machine() && !one.are_of_one_machine();
        let question = Question {
            cases: &cases,
            ..question.clone()
        };
        let sharing = question.sharing()?;
        Ok(Self {
            clusters,
            settings,
            sharing,
            custom: question.custom,
            each_its_own,
            cases,
        })
    }

    /// The tightenings.
    pub fn tasks(&self) -> &[FitTask<'static>] {
        &self.cases
    }

    pub(super) fn counted<'a>(&'a self, tally: &'a Tally) -> Cases<'a> {
        let cases = Cases::new(&self.cases, tally);
        match self.each_its_own {
            true => cases.each_its_own(),
            false => cases,
        }
    }

    /// Effects of the catalogue, and the study's own, that could be missing beside those of `fit`.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn candidates(&self, fit: &LiveFit) -> Result<Vec<Effect>, DiagnoseError> {
        let mut all = candidates(&self.cases, &fit.fitted, &self.custom)?;
        all.retain(|effect| !is_unlisted(*effect));
        Ok(all)
    }

    /// Fits exactly these effects, from where `from` ended where it is given; `tell` hears of every step that
    /// leads lower than any before, and the fit ends soon after
    /// `end` becomes true.
    ///
    /// # Errors
    /// [`DiagnoseError::Interrupted`] where it was ended, [`DiagnoseError::Solve`] where nothing finite came of it, otherwise what
    /// the model or the fit refuses.
    pub fn fit(
        &self,
        effects: &[Effect],
        from: Option<&LiveFit>,
        tell: &(dyn Fn(FitStep) + Sync),
        end: &AtomicBool,
    ) -> Result<LiveFit, DiagnoseError> {
        let tally = Tally::default();
        let follower = Follower::new(self.cases.len(), tell, end);
        let cases = self.counted(&tally).followed_by(&follower);
        let fitted = match from {
            None => fit_sharing(cases, effects, &self.sharing, None, self.clusters),
            Some(from) => self.changed(cases, effects, &from.fitted),
        };
        // Where a fit was ended, what was tried in its place says so too.
        follower.go_on()?;
        self.ended(fitted?)
    }

    /// A fit that ended, without the noise of the torque as the commands tell it, if anything finite came of it.
    pub(super) fn ended(&self, fitted: Fitted) -> Result<LiveFit, DiagnoseError> {
        if !fitted.squares().is_finite() {
            return Err(SolveError::NoStart.into());
        }
        let fitted = fitted.without_torque_noise(self.counted(&Tally::default()))?;
        Ok(LiveFit::new(&self.cases, fitted))
    }

    /// The model of `from` with what goes taken out and what is fresh put in, one after the other.
    fn changed(
        &self,
        cases: Cases<'_>,
        effects: &[Effect],
        from: &Fitted,
    ) -> Result<Fitted, DiagnoseError> {
        let stays = |effect: &&Effect| effects.contains(effect);
        let kept: Vec<Effect> = from.effects.iter().filter(stays).copied().collect();
        let is_fresh = |effect: &&Effect| !kept.contains(effect);
        let fresh: Vec<Effect> = effects.iter().filter(is_fresh).copied().collect();
        let mut current = match kept.len() == from.effects.len() && !fresh.is_empty() {
            true => from.clone(),
            false => fit_effects(cases, &kept, Some(from), self.clusters)?,
        };
        for effect in fresh {
            current = self.with_fresh(cases, &current, effect)?;
        }
        Ok(current)
    }

    /// The model of `current` with one effect more: from the start that promises most, and where that leaves more than the noise,
    /// from where a candidate's refit leads, if that is lower.
    fn with_fresh(
        &self,
        cases: Cases<'_>,
        current: &Fitted,
        effect: Effect,
    ) -> Result<Fitted, DiagnoseError> {
        let pooled = PooledModel::shared_by(cases, &current.effects, &current.sharing)?;
        let scorer = Scorer::new(&pooled, current, self.clusters, Control::default());
        let columns = scorer.score(&[effect])?.columns;
        let at_once = match self.clusters.are_whole() {
            true => self.at_once(cases, current, effect, &columns).ok(),
            false => None,
        };
        if let Some(fitted) = at_once.as_ref().filter(|fitted| fitted.is_at_floor()) {
            return Ok(fitted.clone());
        }
        cases.follower().map_or(Ok(()), Follower::go_on)?;
        let promises = match self.clusters.are_whole() {
            true => Vec::new(),
            false => first_ranking(cases, current, &[effect]),
        };
        let refitted = refit(
            cases,
            current,
            effect,
            &columns,
            Way::Far(promises.first()),
            self.clusters,
            &self.settings,
        )
        .and_then(|fitted| fit_effects(cases, &fitted.effects, Some(&fitted), self.clusters));
        match (at_once, refitted) {
            (Some(at_once), Ok(refitted)) if at_once.squares() <= refitted.squares() => Ok(at_once),
            (Some(at_once), Err(_)) => Ok(at_once),
            (_, refitted) => refitted,
        }
    }

    /// From the one start that promises most, to the end.
    fn at_once(
        &self,
        cases: Cases<'_>,
        current: &Fitted,
        effect: Effect,
        columns: &[Column],
    ) -> Result<Fitted, DiagnoseError> {
        let gain = |column: &&Column| column.predicted_gain();
        let best = (columns.iter()).max_by(|a, b| gain(a).total_cmp(&gain(b)));
        let effects = [current.effects.as_slice(), &[effect]].concat();
        let mut pooled = PooledModel::shared_by(cases, &effects, &current.sharing)?;
        let start = match best {
            Some(column) => pooled.with_effect(current.start(&pooled), effect, &column.start),
            None => current.start(&pooled),
        };
        let end = pooled.fit(&start, &PooledSettings::default())?;
        Ok(Fitted::new(&pooled, end, &self.clusters))
    }
}
