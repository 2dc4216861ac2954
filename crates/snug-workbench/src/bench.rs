//! The workbench behind the pages: what was read, what was fitted, and who works on it.

mod after;
pub(crate) mod look;
pub(crate) mod results;
pub(crate) mod save;

use crate::campaign::Campaign;
use crate::campaign::focus::Closer;
use crate::changes::{Changes, EffectSet};
use crate::error::WorkbenchError;
use crate::kept::fits::Fits;
pub(crate) use crate::kept::locked;
use crate::kept::looks::Looks;
use crate::kept::results::Results;
use crate::kept::turns::Turns;
use crate::kept::workers::Workers;
use crate::session::{Session, Ticket};
use crate::told;
use after::Tests;
use serde_json::Value;
use snug_diagnose::{DiagnoseError, FitStep, LiveFit};
use snug_study::{FilesRead, Study};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use std::time::Instant;
use tokio::sync::{broadcast, watch};

/// Pages that are known at a time; of more, one that nobody looks at is forgotten. Chosen.
const MOST_SESSIONS: usize = 64;

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
    tests: Mutex<Tests>,
    /// Single tightenings under fits, and results as files.
    pub(crate) looks: Mutex<Looks>,
    pub(crate) results: Mutex<Results>,
    /// Of which models results are being made.
    pub(crate) making: Turns<EffectSet>,
    sessions: Mutex<BTreeMap<String, Session>>,
    workers: Workers,
    /// What was saved, and where.
    pub(crate) saved: Mutex<Option<(PathBuf, String)>>,
}

/// A fit for a session, under way.
struct Work {
    bench: Arc<Bench>,
    campaign: Arc<Campaign>,
    session: String,
    ticket: Ticket,
    effects: EffectSet,
}

impl Work {
    /// Tells the session's pages of a step, unless something else was asked for since.
    fn tell(&self, step: FitStep) {
        let told = told::step(&self.campaign, self.ticket.number, step);
        (self.bench).with_last(&self.session, &self.ticket, |known| known.tell(told));
    }
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
            tests: Mutex::default(),
            looks: Mutex::default(),
            results: Mutex::default(),
            making: Turns::default(),
            sessions: Mutex::default(),
            workers: Workers::default(),
            saved: Mutex::default(),
        })
    }

    /// Reads and prepares the tightenings, and fits the model to begin with. Pages are told how far it is.
    pub fn read(&self) {
        let tell = |FilesRead { read, files }| {
            let told = match read == files {
                false => format!("Reading and preparing: {read} of {files} files."),
                true => format!("{files} files are read. Fitting the model to begin with."),
            };
            self.reading.send_replace(Reading::UnderWay(told));
        };
        match Campaign::read(&self.study, &tell) {
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

    /// Whether a page waits for the tightenings or shows them.
    pub(crate) fn has_listeners(&self) -> bool {
        self.reading.receiver_count() > 0
            || locked(&self.sessions).values().any(Session::has_listeners)
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

    /// The fit of `effects`, made now where nobody made it before.
    pub(crate) fn fitted_now(
        &self,
        campaign: &Campaign,
        effects: &EffectSet,
        end: &AtomicBool,
    ) -> Result<Arc<LiveFit>, WorkbenchError> {
        self.fit(campaign, effects, &|_| (), end)
    }

    /// A page listens: it begins with `effects` and a closer look, or goes to them where its session knows others, and hears of
    /// everything from there on.
    pub(crate) fn attend(
        self: &Arc<Self>,
        session: &str,
        effects: EffectSet,
        closer: Closer,
    ) -> Result<broadcast::Receiver<Arc<Value>>, WorkbenchError> {
        let campaign = self.campaign()?;
        campaign.prepared.named(effects.names())?;
        closer.focus(&campaign)?;
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
            known.closer = closer;
            known.listen()
        };
        self.work_on(session, &campaign);
        Ok(listener)
    }

    /// Changes what a session shows, of which a page may not know that it is gone, and fits it.
    pub(crate) fn change(
        self: &Arc<Self>,
        session: &str,
        change: impl FnOnce(&mut Session),
    ) -> Result<(), WorkbenchError> {
        let campaign = self.campaign()?;
        if let Some(known) = locked(&self.sessions).get_mut(session) {
            change(known);
        }
        self.work_on(session, &campaign);
        Ok(())
    }

    /// Fits a session's present model, unless it was fitted before; what is under way for this session is ended.
    fn work_on(self: &Arc<Self>, session: &str, campaign: &Arc<Campaign>) {
        self.start(session, campaign, |work| {
            let (bench, ticket) = (&work.bench, &work.ticket);
            bench.fit(
                &work.campaign,
                &work.effects,
                &|step| work.tell(step),
                &ticket.end,
            )
        });
    }

    /// Fits a session's present model anew, from where it ended but for one tightening, which begins with `values`, as what all share
    /// does. Where that ends lower, it is the fit from then on.
    pub(crate) fn fit_from(
        self: &Arc<Self>,
        session: &str,
        member: usize,
        values: Vec<f64>,
    ) -> Result<(), WorkbenchError> {
        let campaign = self.campaign()?;
        let present = self.present(session).ok_or(WorkbenchError::NotFitted)?;
        self.start(session, &campaign, move |work| {
            let (bench, live) = (&work.bench, &work.campaign.prepared.live);
            let tell = |step| work.tell(step);
            let fit = live.fit_from(&present, member, &values, &tell, &work.ticket.end)?;
            let fit = Arc::new(fit);
            let is_lower = locked(&bench.fits).improve(&work.effects, &fit);
            if is_lower {
                locked(&bench.looks).forget();
            }
            let sentence = told::from_here(&work.campaign, &present, &fit, is_lower);
            bench.with_last(&work.session, &work.ticket, |known| known.tell(sentence));
            Ok(if is_lower { fit } else { present })
        });
        Ok(())
    }

    /// Makes a fit for a session and tells what it came to; what was under way for it is ended.
    fn start(
        self: &Arc<Self>,
        session: &str,
        campaign: &Arc<Campaign>,
        fit: impl FnOnce(&Work) -> Result<Arc<LiveFit>, WorkbenchError> + Send + 'static,
    ) {
        let Some((ticket, effects)) = self.begin(session, campaign) else {
            return;
        };
        let work = Work {
            bench: Arc::clone(self),
            campaign: Arc::clone(campaign),
            session: session.to_owned(),
            ticket,
            effects,
        };
        // Wherever it is asked for: a fit takes a processor for itself.
        self.workers.run(move || {
            let begun = Instant::now();
            let was_known = work.bench.fitted(&work.effects);
            let fit = fit(&work);
            let is_known =
                |fit: &Arc<LiveFit>| was_known.as_ref().is_some_and(|was| Arc::ptr_eq(was, fit));
            let begun = (!fit.as_ref().is_ok_and(is_known)).then_some(begun);
            let Work {
                bench,
                campaign,
                session,
                ticket,
                effects,
            } = &work;
            bench.went(session, campaign, ticket, effects, fit, begun);
        });
    }

    /// Ends what is under way for a session and says that something is; what is to be fitted.
    fn begin(&self, session: &str, campaign: &Campaign) -> Option<(Ticket, EffectSet)> {
        let mut sessions = locked(&self.sessions);
        let known = sessions.get_mut(session)?;
        let ticket = known.begin();
        let effects = known.changes.present().clone();
        known.tell(told::fitting(campaign, ticket.number, &effects));
        Some((ticket, effects))
    }

    /// Tells what a fit came to, and what follows from it.
    fn went(
        &self,
        session: &str,
        campaign: &Campaign,
        ticket: &Ticket,
        effects: &EffectSet,
        fit: Result<Arc<LiveFit>, WorkbenchError>,
        begun: Option<Instant>,
    ) {
        let fit = match fit {
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
        self.look_further(session, campaign, ticket, effects, &fit);
    }

    fn fit(
        &self,
        campaign: &Campaign,
        effects: &EffectSet,
        tell: &(dyn Fn(FitStep) + Sync),
        end: &AtomicBool,
    ) -> Result<Arc<LiveFit>, WorkbenchError> {
        if let Some(fit) = self.fitted(effects) {
            return Ok(fit);
        }
        let named = campaign.prepared.named(effects.names())?;
        let from = locked(&self.fits).nearest(effects);
        let live = &campaign.prepared.live;
        let fit = Arc::new(live.fit(&named, from.as_deref(), tell, end)?);
        locked(&self.fits).keep(effects.clone(), Arc::clone(&fit));
        Ok(fit)
    }

    /// The model of a session.
    pub(crate) fn present_set(&self, session: &str) -> Option<EffectSet> {
        let sessions = locked(&self.sessions);
        Some(sessions.get(session)?.changes.present().clone())
    }

    fn present(&self, session: &str) -> Option<Arc<LiveFit>> {
        self.fitted(&self.present_set(session)?)
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
