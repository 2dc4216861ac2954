//! The workbench behind the pages: what was read, what was fitted, and who works on it.

use crate::campaign::Campaign;
use crate::changes::{Changes, EffectSet};
use crate::error::WorkbenchError;
use crate::fits::Fits;
use crate::session::{Session, Ticket};
use crate::told;
use serde_json::{Value, json};
use snug_diagnose::{DiagnoseError, LiveFit};
use snug_model::Effect;
use snug_study::Study;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;
use tokio::sync::{broadcast, watch};

/// Pages that are known at a time; of more, one that nobody looks at is forgotten. Chosen.
const MOST_SESSIONS: usize = 64;

/// Candidates that are scored together: between two such batches a newer click is heard. Chosen.
const SCORED_TOGETHER: usize = 8;

/// How far reading has come.
#[derive(Clone)]
pub(crate) enum Reading {
    /// Under way, in a sentence.
    UnderWay(String),
    Done(Arc<Campaign>),
    /// Not possible, in a sentence.
    Failed(String),
}

/// The workbench on one study.
pub struct Bench {
    study: Study,
    study_file: Option<PathBuf>,
    reading: watch::Sender<Reading>,
    fits: Mutex<Fits>,
    sessions: Mutex<BTreeMap<String, Session>>,
    /// What was saved, and where.
    pub(crate) saved: Mutex<Option<(PathBuf, String)>>,
}

/// What nobody can leave in disorder: every change of it is one assignment.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Bench {
    /// The workbench on `study`, of which nothing is read yet; `study_file` is where that came from.
    pub fn new(study: Study, study_file: Option<PathBuf>) -> Arc<Self> {
        let (reading, _) =
            watch::channel(Reading::UnderWay("Looking for measurement files.".into()));
        Arc::new(Self {
            study,
            study_file,
            reading,
            fits: Mutex::default(),
            sessions: Mutex::default(),
            saved: Mutex::default(),
        })
    }

    /// Reads and prepares the tightenings, and fits the model to begin with. Pages are told how far it is.
    pub fn read(&self) {
        let listed = |files: usize| {
            let told = format!("Reading and preparing tightenings from {files} files.");
            self.reading.send_replace(Reading::UnderWay(told));
        };
        match Campaign::read(&self.study, &listed) {
            Ok(campaign) => {
                let (set, fit) = (campaign.base_set(), Arc::clone(&campaign.base));
                locked(&self.fits).keep(set, fit);
                self.reading.send_replace(Reading::Done(Arc::new(campaign)));
            }
            Err(error) => {
                tracing::error!(%error, "nothing can be worked on");
                self.reading
                    .send_replace(Reading::Failed(error.to_string()));
            }
        }
    }

    pub(crate) fn study(&self) -> &Study {
        &self.study
    }

    pub(crate) fn study_file(&self) -> Option<&Path> {
        self.study_file.as_deref()
    }

    pub(crate) fn reading(&self) -> watch::Receiver<Reading> {
        self.reading.subscribe()
    }

    /// What is worked on.
    pub(crate) fn campaign(&self) -> Result<Arc<Campaign>, WorkbenchError> {
        match &*self.reading.borrow() {
            Reading::UnderWay(_) => Err(WorkbenchError::StillReading),
            Reading::Done(campaign) => Ok(Arc::clone(campaign)),
            Reading::Failed(message) => Err(WorkbenchError::Unreadable {
                message: message.clone(),
            }),
        }
    }

    pub(crate) fn fitted(&self, effects: &EffectSet) -> Option<Arc<LiveFit>> {
        locked(&self.fits).get(effects)
    }

    /// A page listens: it begins with `effects`, or goes to them where its session knows another model, and hears of everything from
    /// there on.
    pub(crate) fn attend(
        self: &Arc<Self>,
        session: &str,
        effects: EffectSet,
    ) -> Result<broadcast::Receiver<Arc<Value>>, WorkbenchError> {
        let campaign = self.campaign()?;
        campaign.prepared.named(effects.names())?;
        let listener = {
            let mut sessions = locked(&self.sessions);
            forget_some(&mut sessions);
            let begun = || {
                let mut changes = Changes::begin(campaign.base_set());
                changes.choose(effects.clone());
                Session::new(changes)
            };
            let known = sessions.entry(session.to_owned()).or_insert_with(begun);
            known.changes.choose(effects);
            known.listen()
        };
        self.work_on(session, &campaign);
        Ok(listener)
    }

    /// Changes the model of a session, of which a page may not know that it is gone, and fits it.
    pub(crate) fn change(
        self: &Arc<Self>,
        session: &str,
        change: impl FnOnce(&mut Changes),
    ) -> Result<(), WorkbenchError> {
        let campaign = self.campaign()?;
        if let Some(known) = locked(&self.sessions).get_mut(session) {
            change(&mut known.changes);
        }
        self.work_on(session, &campaign);
        Ok(())
    }

    /// Fits a session's present model, unless it was fitted before; what is under way for this session is ended.
    fn work_on(self: &Arc<Self>, session: &str, campaign: &Arc<Campaign>) {
        let (ticket, effects) = {
            let mut sessions = locked(&self.sessions);
            let Some(known) = sessions.get_mut(session) else {
                return;
            };
            let ticket = known.begin();
            let effects = known.changes.present().clone();
            known.tell(told::fitting(campaign, ticket.number, &effects));
            (ticket, effects)
        };
        let (bench, campaign) = (Arc::clone(self), Arc::clone(campaign));
        let session = session.to_owned();
        // Wherever it is asked for: a fit takes a processor for itself.
        std::thread::spawn(move || bench.work(&session, &campaign, &ticket, &effects));
    }

    fn work(&self, session: &str, campaign: &Campaign, ticket: &Ticket, effects: &EffectSet) {
        let begun = match self.fitted(effects) {
            Some(_) => None,
            None => Some(Instant::now()),
        };
        let fit = match self.fit(session, campaign, ticket, effects) {
            Ok(fit) => fit,
            Err(WorkbenchError::Diagnose(DiagnoseError::Interrupted)) => return,
            Err(error) => {
                self.with_last(session, ticket, |known| {
                    known.changes.take_back();
                    known.tell(told::failed(campaign, effects, &error));
                });
                // What was there before is told again.
                if let Some(fit) = self.present(session) {
                    self.tell_fitted(session, campaign, ticket, &fit, begun);
                }
                return;
            }
        };
        self.tell_fitted(session, campaign, ticket, &fit, begun);
        for candidates in campaign.switches.chunks(SCORED_TOGETHER) {
            if ticket.end.load(Ordering::Relaxed) {
                return;
            }
            self.tell_promises(session, campaign, ticket, &fit, candidates);
        }
        self.with_last(session, ticket, |known| {
            known.tell(json!({ "kind": "ranked" }))
        });
    }

    fn fit(
        &self,
        session: &str,
        campaign: &Campaign,
        ticket: &Ticket,
        effects: &EffectSet,
    ) -> Result<Arc<LiveFit>, WorkbenchError> {
        if let Some(fit) = self.fitted(effects) {
            return Ok(fit);
        }
        let named = campaign.prepared.named(effects.names())?;
        let from = locked(&self.fits).nearest(effects);
        let tell = |step| {
            self.with_last(session, ticket, |known| {
                known.tell(told::step(campaign, ticket.number, step))
            });
        };
        let live = &campaign.prepared.live;
        let fit = Arc::new(live.fit(&named, from.as_deref(), &tell, &ticket.end)?);
        locked(&self.fits).keep(effects.clone(), Arc::clone(&fit));
        Ok(fit)
    }

    fn present(&self, session: &str) -> Option<Arc<LiveFit>> {
        let present = locked(&self.sessions)
            .get(session)?
            .changes
            .present()
            .clone();
        self.fitted(&present)
    }

    fn tell_fitted(
        &self,
        session: &str,
        campaign: &Campaign,
        ticket: &Ticket,
        fit: &LiveFit,
        begun: Option<Instant>,
    ) {
        let seconds = begun.map(|begun| begun.elapsed().as_secs_f64());
        self.with_last(session, ticket, |known| {
            let error = |effects: &EffectSet| self.fitted(effects).map(|fit| fit.error());
            known.tell(told::fitted(campaign, &known.changes, fit, &error, seconds));
        });
    }

    fn tell_promises(
        &self,
        session: &str,
        campaign: &Campaign,
        ticket: &Ticket,
        fit: &LiveFit,
        candidates: &[Effect],
    ) {
        let absent = |effect: &&Effect| !fit.effects().contains(effect);
        let absent: Vec<Effect> = candidates.iter().filter(absent).copied().collect();
        match campaign
            .prepared
            .live
            .promises(fit, &campaign.base, &absent)
        {
            Ok(shares) => self.with_last(session, ticket, |known| {
                known.tell(told::promises(&absent, &shares));
            }),
            Err(error) => tracing::warn!(%error, "candidates could not be scored"),
        }
    }

    /// Does something with a session, unless something else was asked of it since.
    fn with_last(&self, session: &str, ticket: &Ticket, work: impl FnOnce(&mut Session)) {
        let mut sessions = locked(&self.sessions);
        if let Some(known) = sessions
            .get_mut(session)
            .filter(|known| known.is_last(ticket))
        {
            work(known);
        }
    }
}

/// Makes room for one session more.
fn forget_some(sessions: &mut BTreeMap<String, Session>) {
    if sessions.len() >= MOST_SESSIONS {
        let idle = sessions.iter().find(|(_, known)| !known.has_listeners());
        let idle = idle.or_else(|| sessions.iter().next());
        if let Some(idle) = idle.map(|(name, _)| name.clone()) {
            sessions.remove(&idle);
        }
    }
}
