//! Of effects that explain nearly as much of a few long records, the simpler.
//!
//! A friction that comes and goes with the way, or with the speed, is dry friction with a shape: of records that hardly show the shape
//! the richer law explains a little more, as any law of more numbers does, and an engineer says dry friction all the same. Which
//! of the two is right may show only beside another effect, so that the others are looked at again when one has been added.

use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fit::fit_effects;
use crate::pooled::fitted::Fitted;
use crate::ranking::applicability::can_act;
use crate::ranking::kin::{are_kin, is_simpler};
use crate::ranking::rank::{Candidate, rank};
use crate::selection::model_selection::ModelSelection;
use crate::selection::path::{Addition, SelectionPath};
use crate::selection::thresholds::NEARLY_AS_MUCH;
use snug_model::Effect;

/// Whether the model `simple` does for `rich` where the noise is not known: what it leaves more is a small share of what `before` left,
/// and less than all that is left otherwise.
fn does_for(simple: &Fitted, rich: &Fitted, before: &Fitted) -> bool {
    let more = simple.squares() - rich.squares();
    let is_little = more <= NEARLY_AS_MUCH * before.squares() && more <= rich.squares();
    rich.are_stretches() && !rich.is_weighted && is_little
}

impl Candidate {
    /// Whether it does for `rich` beside the model `before`.
    pub fn does_for(&self, rich: &Self, before: &Fitted) -> bool {
        does_for(&self.fitted, &rich.fitted, before)
    }

    /// Whether it needs more to say than `other`: more numbers for what is easily taken for it, or a law that nobody knows.
    pub fn is_richer_than(&self, other: &Self) -> bool {
        let is_unknown = is_unlisted(self.effect) && !is_unlisted(other.effect);
        is_unknown || is_simpler(other.effect, self.effect)
    }
}

impl ModelSelection<'_> {
    /// Exchanges every added effect for a simpler one that does for it beside the others, or for a richer one for which it does not do.
    /// One that stands alone has been compared with its kin as it was chosen.
    pub fn exchange_kin(&self, path: &mut SelectionPath) -> Result<(), DiagnoseError> {
        if self.clusters.are_whole() || path.additions.len() < 2 {
            return Ok(());
        }
        for place in 0..path.additions.len() {
            let effect = path.additions[place].effect;
            let Some(other) = self.better_kin(path, effect)? else {
                continue;
            };
            let settled = self.settled(&other.fitted)?;
            let known = &mut path.additions[place];
            *known = Addition {
                effect: other.effect,
                p_family: other.p_family,
                twins: vec![effect],
                ..known.clone()
            };
            path.replace_last(settled);
        }
        Ok(())
    }

    /// What does better than `effect` beside the other effects of the last model.
    fn better_kin(
        &self,
        path: &SelectionPath,
        effect: Effect,
    ) -> Result<Option<Candidate>, DiagnoseError> {
        let (last, first) = (path.last(), &path.rungs[0]);
        let (case, model) = (&self.cases[0], &self.cases[0].model);
        let is_there = |other: Effect| last.effects.iter().any(|one| one.name() == other.name());
        let kin: Vec<Effect> = (Effect::ALL.iter())
            .filter(|&&other| are_kin(other, effect) && !is_there(other) && can_act(other, case))
            .map(|&other| model.scale().effect(other, model.rig()))
            .collect::<Result<_, _>>()?;
        if kin.is_empty() {
            return Ok(None);
        }
        self.watch
            .begin(&format!("looking for what does for {}", effect.name()))?;
        let mut others = last.effects.clone();
        others.retain(|known| *known != effect);
        let Ok(without) = fit_effects(self.cases, &others, Some(last), self.clusters) else {
            return Ok(None);
        };
        let (clusters, settings) = (self.clusters, self.settings);
        let ranked = rank(
            self.cases, &without, &kin, clusters, settings, 0, self.watch,
        )?;
        let is_better = |other: &Candidate| {
            other.is_supported(settings)
                && match is_simpler(other.effect, effect) {
                    true => does_for(&other.fitted, last, first),
                    false => !does_for(last, &other.fitted, first),
                }
        };
        Ok(ranked.candidates.into_iter().find(is_better))
    }
}
