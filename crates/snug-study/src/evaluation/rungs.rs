//! The rungs of a diagnosis' ladder, each evaluated on every file while the file is at hand.

use crate::evaluation::tightening::Evaluated;
use crate::study::Study;
use snug_campaign::words::explained::is_white;
use snug_campaign::words::headline::Headline;
use snug_campaign::{Diagnosis, Motion, Rejection, Rung, TighteningId, Verdict};
use snug_statistics::descriptive::median;

/// What a diagnosis found out, with the models whose evaluation completes it.
pub(crate) struct Ladder {
    pub diagnosis: Diagnosis,
    /// The study with the model of every rung but the last, which is that of the run itself.
    pub before: Vec<Study>,
}

impl Ladder {
    /// The tightening whose signals are shown whichever others are.
    pub fn shown(&self) -> Option<&TighteningId> {
        (self.diagnosis.comparison.tightenings.first()).map(|worst| &worst.id)
    }

    /// The diagnosis with what the evaluation of all files says of every rung.
    pub fn completed(self, shares: Vec<RungShare>) -> Diagnosis {
        let mut diagnosis = self.diagnosis;
        let last = shares.len().saturating_sub(1);
        for (number, (rung, share)) in diagnosis.ladder.iter_mut().zip(shares).enumerate() {
            share.complete(rung);
            if number == last && share.count > 0 && share.selected == 0 {
                (diagnosis.verdict, diagnosis.headline) =
                    with_nothing_usable(diagnosis.verdict, diagnosis.headline);
            }
        }
        diagnosis
    }
}

/// A model with which not a single recording can be used is not adequate, whatever candidates promise beside it.
fn with_nothing_usable(verdict: Verdict, headline: Headline) -> (Verdict, Headline) {
    match headline {
        Headline::Adequate {
            added,
            further,
            fall,
            explained,
        } => {
            let added = [added, further].concat();
            let white = explained.filter(|all| is_white(all.neighbours));
            let headline = match white {
                Some(explained) => Headline::TooNoisy {
                    added,
                    fall,
                    explained,
                },
                None => Headline::MoreThanNoise {
                    added,
                    fall,
                    explained,
                    changes: None,
                },
            };
            (Verdict::Undecided, headline)
        }
        headline => (verdict, headline),
    }
}

/// The motions that a model simulates of some tightenings.
pub(crate) struct Simulated(Vec<(TighteningId, Motion)>);

impl Simulated {
    /// Of evaluated tightenings.
    pub fn of(evaluated: Vec<Evaluated>) -> Self {
        let motions = evaluated.into_iter().filter_map(|one| {
            let traces = one.traces?;
            Some((one.result.id, traces.simulated))
        });
        Self(motions.collect())
    }

    /// Puts them beside what the last model simulates, as what was before.
    pub fn stand_beside(self, evaluated: &mut [Evaluated]) {
        for (id, motion) in self.0 {
            let mut all = evaluated.iter_mut();
            let same = all.find(|one| one.result.id == id);
            if let Some(traces) = same.and_then(|one| one.traces.as_mut()) {
                traces.before = motion;
            }
        }
    }
}

/// What evaluated tightenings say of a rung.
#[derive(Default)]
pub(crate) struct RungShare {
    /// Mean squares of the displacement's residual \[rad²\].
    squares_rad2: Vec<f64>,
    fits_percent: Vec<f64>,
    selected: usize,
    count: usize,
}

impl RungShare {
    /// Of tightenings of one file; those kept for validation say nothing.
    pub fn of(evaluated: &[Evaluated]) -> Self {
        let mut share = Self::default();
        for Evaluated { result, .. } in evaluated {
            if result.selection.rejections.contains(&Rejection::Validation) {
                continue;
            }
            share.count += 1;
            share.selected += usize::from(result.selection.selected());
            let rms = result.measures.rms_displacement_rad;
            share.squares_rad2.extend(rms.map(|rms| rms * rms));
            share.fits_percent.extend(result.measures.fit_percent);
        }
        share
    }

    /// Adds what the next file says.
    pub fn add(&mut self, next: Self) {
        self.squares_rad2.extend(next.squares_rad2);
        self.fits_percent.extend(next.fits_percent);
        self.selected += next.selected;
        self.count += next.count;
    }

    fn complete(&self, rung: &mut Rung) {
        let squares = &self.squares_rad2;
        rung.selected_fraction = self.selected as f64 / self.count.max(1) as f64;
        rung.fit_percent_median = median(&self.fits_percent).ok();
        rung.rms_displacement_rad = (!squares.is_empty())
            .then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt());
    }
}
