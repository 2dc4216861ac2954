//! The workbench on whole windows, and those on a stretch of every window alone.

use crate::bench::Bench;
use crate::error::WorkbenchError;
use crate::kept::locked;
use axum::extract::{FromRequestParts, RawPathParams};
use axum::http::request::Parts;
use snug_study::Stretch;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

/// Where the pages of a stretch are, by where it begins and ends \[s\].
pub(crate) const OF_A_STRETCH: &str = "/stretch/{from_s}/{to_s}";
/// Stretches that are worked on at a time, each with tightenings of its own in memory; of more, the oldest is forgotten. Chosen.
const MOST: usize = 3;

/// Every workbench of this server.
pub(crate) struct Benches {
    whole: Arc<Bench>,
    parts: Mutex<VecDeque<(Stretch, Arc<Bench>)>>,
}

impl Benches {
    pub fn on(whole: Arc<Bench>) -> Self {
        Self {
            whole,
            parts: Mutex::default(),
        }
    }

    /// The one on a stretch alone, which begins to read where nobody asked for it before.
    fn of(&self, stretch: Stretch) -> Arc<Bench> {
        let mut parts = locked(&self.parts);
        if let Some((_, known)) = parts.iter().find(|(known, _)| *known == stretch) {
            return Arc::clone(known);
        }
        let mut study = self.whole.study().clone();
        study.preprocess.stretch = Some(stretch);
        let file = self.whole.study_file().map(ToOwned::to_owned);
        let bench = Bench::new(study, file);
        let reader = Arc::clone(&bench);
        std::thread::spawn(move || reader.read());
        if parts.len() >= MOST {
            parts.pop_front();
        }
        parts.push_back((stretch, Arc::clone(&bench)));
        bench
    }
}

/// The workbench that an address is of, and what its addresses begin with.
pub(crate) struct At {
    pub bench: Arc<Bench>,
    pub root: String,
}

impl FromRequestParts<Arc<Benches>> for At {
    type Rejection = WorkbenchError;

    async fn from_request_parts(
        parts: &mut Parts,
        benches: &Arc<Benches>,
    ) -> Result<Self, WorkbenchError> {
        let of_whole = || Self {
            bench: Arc::clone(&benches.whole),
            root: String::new(),
        };
        let Ok(told) = RawPathParams::from_request_parts(parts, benches).await else {
            return Ok(of_whole());
        };
        let value = |name: &str| told.iter().find(|(known, _)| *known == name);
        let (Some((_, from)), Some((_, to))) = (value("from_s"), value("to_s")) else {
            return Ok(of_whole());
        };
        let (from_s, to_s) = (from.parse().ok(), to.parse().ok());
        let stretch = from_s
            .zip(to_s)
            .map(|(from_s, to_s)| Stretch { from_s, to_s });
        match stretch.filter(|stretch| stretch.check().is_ok()) {
            Some(stretch) => Ok(Self {
                bench: benches.of(stretch),
                root: format!("/stretch/{from}/{to}"),
            }),
            None => Err(WorkbenchError::NoStretch { from_s, to_s }),
        }
    }
}
