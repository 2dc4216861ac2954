//! Fits that were made, by their set of effects.

use crate::changes::EffectSet;
use snug_diagnose::LiveFit;
use std::sync::Arc;

/// Fits that were made; the first, of the model to begin with, stays.
#[derive(Default)]
pub(crate) struct Fits(Vec<(EffectSet, Arc<LiveFit>)>);

/// Fits that are kept; one of 240 tightenings takes half a megabyte. Chosen.
const MOST: usize = 200;

/// Share of the error that counts as lower: the fit's own tolerance is a tenth of it. Chosen.
const LOWER: f64 = 1e-6;

impl Fits {
    pub fn get(&self, effects: &EffectSet) -> Option<Arc<LiveFit>> {
        let found = self.0.iter().find(|(known, _)| known == effects);
        found.map(|(_, fit)| Arc::clone(fit))
    }

    /// The fit with the fewest effects to put in or take out, of equals the one with most of them in place.
    pub fn nearest(&self, effects: &EffectSet) -> Option<Arc<LiveFit>> {
        let cost = |known: &EffectSet| (known.distance(effects), known.beyond(effects).count());
        let nearest = self.0.iter().min_by_key(|(known, _)| cost(known));
        nearest.map(|(_, fit)| Arc::clone(fit))
    }

    /// Puts a fit in the place of the one of the same effects, if it leaves less; whether it did.
    pub fn improve(&mut self, effects: &EffectSet, fit: &Arc<LiveFit>) -> bool {
        let known = self.0.iter_mut().find(|(known, _)| known == effects);
        match known {
            Some((_, known)) if fit.error() < (1.0 - LOWER) * known.error() => {
                *known = Arc::clone(fit);
                true
            }
            _ => false,
        }
    }

    /// Keeps a fit, unless one of the same effects is there.
    pub fn keep(&mut self, effects: EffectSet, fit: Arc<LiveFit>) {
        if self.get(&effects).is_some() {
            return;
        }
        if self.0.len() >= MOST {
            self.0.remove(1);
        }
        self.0.push((effects, fit));
    }
}
