//! The workbench on whole windows, and those on a stretch of every window alone.

use crate::bench::Bench;
use crate::error::WorkbenchError;
use crate::kept::locked;
use axum::extract::{FromRequestParts, RawPathParams};
use axum::http::request::Parts;
use snug_study::Stretch;
use std::sync::{Arc, Mutex};

/// Where the pages of a stretch are, by where it begins and ends \[s\].
pub(crate) const OF_A_STRETCH: &str = "/stretch/{from_s}/{to_s}";
/// Stretches that are worked on at a time, each with tightenings of its own in memory. Of more, one that no page shows is forgotten, the
/// one that was asked for longest ago; where pages show all, one more is refused. Chosen.
const MOST: usize = 6;

/// Every workbench of this server.
pub(crate) struct Benches {
    whole: Arc<Bench>,
    /// The one that was asked for last at the end.
    parts: Mutex<Vec<(Stretch, Arc<Bench>)>>,
}

impl Benches {
    pub fn on(whole: Arc<Bench>) -> Self {
        Self {
            whole,
            parts: Mutex::default(),
        }
    }

    /// The one on a stretch alone, which begins to read where nobody asked for it before.
    fn of(&self, stretch: Stretch) -> Result<Arc<Bench>, WorkbenchError> {
        let mut parts = locked(&self.parts);
        if let Some(place) = parts.iter().position(|(known, _)| *known == stretch) {
            parts[place..].rotate_left(1);
            return Ok(Arc::clone(&parts[parts.len() - 1].1));
        }
        if parts.len() >= MOST {
            let idle = parts.iter().position(|(_, bench)| !bench.has_listeners());
            parts.remove(idle.ok_or(WorkbenchError::ManyStretches { most: MOST })?);
        }
        let mut study = self.whole.study().clone();
        study.preprocess.stretch = Some(stretch);
        let file = self.whole.study_file().map(ToOwned::to_owned);
        let bench = Bench::new(study, file);
        let reader = Arc::clone(&bench);
        std::thread::spawn(move || reader.read());
        parts.push((stretch, Arc::clone(&bench)));
        Ok(bench)
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
                bench: benches.of(stretch)?,
                root: format!("/stretch/{from}/{to}"),
            }),
            None => Err(WorkbenchError::NoStretch { from_s, to_s }),
        }
    }
}
