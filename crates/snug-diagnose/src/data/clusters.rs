//! What counts as one independent piece of evidence: a tightening, or, where there are few, a stretch of one.

use snug_campaign::words::reason::Cluster;
use snug_identify::FitTask;
use std::ops::Range;

/// Fewer tightenings than this are cut into stretches.
const FEWEST_WHOLE: usize = 8;
/// Stretches wanted where tightenings are cut.
const STRETCHES_WANTED: usize = 24;
/// Shortest stretch \[samples\].
const SHORTEST_STRETCH: usize = 40;

/// How tightenings are cut into units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Units {
    /// Units per tightening.
    pub per_case: usize,
}

impl Units {
    pub fn of(cases: &[FitTask<'_>]) -> Self {
        if cases.len() >= FEWEST_WHOLE {
            return Self { per_case: 1 };
        }
        let shortest = cases
            .iter()
            .map(|case| case.measured().len() - case.unscored());
        let room = shortest.min().unwrap_or(0) / SHORTEST_STRETCH;
        Self {
            per_case: STRETCHES_WANTED
                .div_ceil(cases.len().max(1))
                .min(room)
                .max(1),
        }
    }

    /// Whether each unit is a whole tightening, so that its own parameters can follow.
    pub fn are_whole(self) -> bool {
        self.per_case == 1
    }

    /// What each of them is.
    pub fn cluster(self) -> Cluster {
        match self.are_whole() {
            true => Cluster::Tightening,
            false => Cluster::Stretch,
        }
    }

    /// The units of one tightening with `samples` residuals.
    pub fn ranges(self, samples: usize) -> impl Iterator<Item = Range<usize>> {
        let length = samples.div_ceil(self.per_case).max(1);
        (0..self.per_case)
            .map(move |unit| (unit * length).min(samples)..((unit + 1) * length).min(samples))
    }
}
