//! What is worked out once a model is fitted and shown: usable tightenings, what candidates promise, and whether what was added is real.

use super::{Bench, locked};
use crate::campaign::Campaign;
use crate::campaign::focus::Closer;
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use crate::session::Ticket;
use crate::told;
use serde_json::json;
use snug_diagnose::{CloserLook, HeldOut, LiveFit, Watch};
use snug_model::Effect;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Candidates that are scored together: between two such batches a newer click is heard. Chosen.
const SCORED_TOGETHER: usize = 8;

/// Tests that were made: the model without the effect, the effect, and what came of it; `None` where it cannot be run.
#[derive(Default)]
pub(super) struct Tests(Vec<(EffectSet, String, Option<HeldOut>)>);

impl Tests {
    fn get(&self, without: &EffectSet, effect: &str) -> Option<Option<HeldOut>> {
        let found = (self.0.iter()).find(|(set, name, _)| set == without && name == effect);
        found.map(|(_, _, tested)| tested.clone())
    }
}

impl Bench {
    /// Works out and tells one thing after the other, until something else is asked for.
    pub(super) fn look_further(
        &self,
        session: &str,
        campaign: &Campaign,
        ticket: &Ticket,
        effects: &EffectSet,
        fit: &LiveFit,
    ) {
        let closer = self.closer(session);
        let close = match closer.is_all() {
            true => Ok(None),
            false => look_closer(campaign, &closer, fit).map(Some),
        };
        let close = close.unwrap_or_else(|error| {
            self.with_last(session, ticket, |known| {
                known.tell(json!({ "kind": "failed", "sentence": error.to_string() }));
            });
            None
        });
        if let Some(close) = &close {
            let is_base = fit.effects() == campaign.base.effects();
            let told = told::closer(campaign, &closer, close, is_base);
            self.with_last(session, ticket, |known| known.tell(told));
        }
        for candidates in campaign.switches.chunks(SCORED_TOGETHER) {
            if ticket.end.load(Ordering::Relaxed) {
                return;
            }
            let absent = |effect: &&Effect| !fit.effects().contains(effect);
            let absent: Vec<Effect> = candidates.iter().filter(absent).copied().collect();
            let promises = match &close {
                Some(close) => close.promises(&absent),
                None => campaign
                    .prepared
                    .live
                    .promises(fit, &campaign.base, &absent),
            };
            match promises {
                Ok(shares) => self.with_last(session, ticket, |known| {
                    known.tell(told::promises(&absent, &shares));
                }),
                Err(error) => tracing::warn!(%error, "candidates could not be scored"),
            }
        }
        self.with_last(session, ticket, |known| {
            known.tell(json!({ "kind": "ranked" }))
        });
        self.tell_usable(session, campaign, ticket, fit);
        if let Err(error) = self.test(session, campaign, ticket, effects) {
            tracing::debug!(%error, "a test was not ended");
        }
    }

    fn tell_usable(&self, session: &str, campaign: &Campaign, ticket: &Ticket, fit: &LiveFit) {
        if let (Some(before), Some(now)) = (campaign.base_usable(), campaign.usable(fit)) {
            self.with_last(session, ticket, |known| {
                known.tell(told::usable(campaign, before, now));
            });
        }
    }

    /// Whether each effect that was added is real, the last first: on one processor, so that the next click has another.
    fn test(
        &self,
        session: &str,
        campaign: &Campaign,
        ticket: &Ticket,
        effects: &EffectSet,
    ) -> Result<(), WorkbenchError> {
        let base = campaign.base_set();
        let added: Vec<&str> = effects.beyond(&base).collect();
        if added.is_empty() {
            return Ok(());
        }
        let Some(alone) = self.workers.alone() else {
            return Ok(());
        };
        for (place, name) in added.iter().rev().enumerate() {
            let without = effects.without(name);
            let known = locked(&self.tests).get(&without, name);
            let tested = match known {
                Some(tested) => tested,
                None => {
                    let told = told::testing(campaign, name, place == 0);
                    self.with_last(session, ticket, |known| known.tell(told));
                    let tested =
                        alone.install(|| self.held_out(campaign, ticket, &without, name))?;
                    let test = (without, (*name).to_owned(), tested.clone());
                    locked(&self.tests).0.push(test);
                    tested
                }
            };
            let told = told::tested(campaign, name, tested.as_ref(), place == 0);
            self.with_last(session, ticket, |known| known.tell(told));
        }
        Ok(())
    }

    fn held_out(
        &self,
        campaign: &Campaign,
        ticket: &Ticket,
        without: &EffectSet,
        name: &str,
    ) -> Result<Option<HeldOut>, WorkbenchError> {
        let without: Arc<LiveFit> = self.fitted_now(campaign, without, &ticket.end)?;
        let effect = campaign.prepared.named(&[name.to_owned()])?;
        let quiet = |_: &str| ();
        let watch = Watch::new(&quiet).until(&ticket.end);
        Ok((campaign.prepared.live).held_out(&without, effect[0], &watch)?)
    }

    fn closer(&self, session: &str) -> Closer {
        let sessions = locked(&self.sessions);
        (sessions.get(session)).map_or_else(Closer::default, |known| known.closer.clone())
    }
}

fn look_closer(
    campaign: &Campaign,
    closer: &Closer,
    fit: &LiveFit,
) -> Result<CloserLook, WorkbenchError> {
    let (focus, live) = (closer.focus(campaign)?, &campaign.prepared.live);
    Ok(live.closer(&focus, &campaign.base, fit)?)
}
