//! What is worked out once a model is fitted and shown: usable tightenings, what candidates promise, and whether what was added is real.

use super::{Bench, locked};
use crate::campaign::Campaign;
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use crate::focus::Closer;
use crate::session::Ticket;
use crate::told;
use serde_json::json;
use snug_diagnose::{DiagnoseError, Focus, HeldOut, LiveCases, LiveFit, Watch};
use snug_model::Effect;
use std::ops::Range;
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

/// What is looked at more closely, with the models as they are there.
struct Close {
    /// The tightenings with their whole windows, and the present model as it is on these.
    whole: LiveCases,
    whole_now: LiveFit,
    base: LiveFit,
    now: LiveFit,
    /// Samples of every window that count, where not all do.
    samples: Option<Range<usize>>,
}

impl Close {
    fn promises(&self, candidates: &[Effect]) -> Result<Vec<f64>, DiagnoseError> {
        let (whole, now, base) = (&self.whole, &self.whole_now, &self.base);
        match &self.samples {
            Some(samples) => whole.promises_within(now, base, candidates, samples),
            None => whole.promises(now, base, candidates),
        }
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
            false => close(campaign, &closer, fit).map(Some),
        };
        let close = close.unwrap_or_else(|error| {
            self.with_last(session, ticket, |known| {
                known.tell(json!({ "kind": "failed", "sentence": error.to_string() }));
            });
            None
        });
        if let Some(close) = &close {
            let told = told::closer(campaign, &closer, &close.base, &close.now);
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
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let Ok(alone) = alone else { return Ok(()) };
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

fn close(campaign: &Campaign, closer: &Closer, fit: &LiveFit) -> Result<Close, WorkbenchError> {
    let focus: Focus = closer.focus(campaign)?;
    let live = &campaign.prepared.live;
    let there = live.focused(&focus)?;
    let base = there.as_fitted(&campaign.base, &focus.members)?;
    let now = there.as_fitted(fit, &focus.members)?;
    let Focus { members, samples } = focus;
    let whole = live.focused(&Focus {
        members: members.clone(),
        samples: None,
    })?;
    Ok(Close {
        whole_now: whole.as_fitted(fit, &members)?,
        whole,
        base,
        now,
        samples,
    })
}
