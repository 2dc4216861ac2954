//! Single tightenings under fits.

use crate::changes::EffectSet;
use snug_diagnose::LiveTightening;
use std::sync::Arc;

/// Tightenings that were looked at, under their models: dragging a number asks for the same again and again.
#[derive(Default)]
pub(crate) struct Looks(Vec<(EffectSet, usize, Arc<LiveTightening>)>);

/// Looks that are kept; one takes 48 kB per 3000 samples. Chosen.
const MOST: usize = 60;

impl Looks {
    /// Forgets all: a model ended elsewhere.
    pub fn forget(&mut self) {
        self.0.clear();
    }

    /// A tightening under a model, if it was looked at.
    pub fn get(&self, effects: &EffectSet, member: usize) -> Option<Arc<LiveTightening>> {
        let found = (self.0.iter()).find(|(set, of, _)| *of == member && set == effects);
        found.map(|(_, _, seen)| Arc::clone(seen))
    }

    /// Keeps one, and forgets the oldest where there are too many.
    pub fn keep(&mut self, effects: EffectSet, member: usize, seen: Arc<LiveTightening>) {
        if self.0.len() >= MOST {
            self.0.remove(0);
        }
        self.0.push((effects, member, seen));
    }
}
