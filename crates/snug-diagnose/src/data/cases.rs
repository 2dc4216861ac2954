//! The tightenings of a question together with the count of what is done with them.

use crate::data::clusters::Clusters;
use crate::data::follower::Follower;
use crate::data::machine::is_machine;
use crate::error::DiagnoseError;
use snug_campaign::{Estimate, WorkDone};
use snug_identify::{FitTask, IdentifyError};
use snug_least_squares::Work;
use std::ops::Deref;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Tightenings, and where the work done with them is counted.
#[derive(Clone, Copy)]
pub(crate) struct Cases<'a> {
    all: &'a [FitTask<'a>],
    tally: &'a Tally,
    is_one_machine: bool,
    follower: Option<&'a Follower<'a>>,
}

impl<'a> Cases<'a> {
    pub fn new(all: &'a [FitTask<'a>], tally: &'a Tally) -> Self {
        let is_one_machine =
            all.len() > 1 && all.iter().all(is_machine) && !Clusters::of(all).are_whole();
        Self {
            all,
            tally,
            is_one_machine,
            follower: None,
        }
    }

    /// The same, whose fits are followed.
    pub fn followed_by(self, follower: &'a Follower<'a>) -> Self {
        Self {
            follower: Some(follower),
            ..self
        }
    }

    /// Who follows their fits.
    pub fn follower(self) -> Option<&'a Follower<'a>> {
        self.follower
    }

    /// The same, of which each has its own mass, damping and stiffness.
    pub fn each_its_own(self) -> Self {
        Self {
            is_one_machine: false,
            ..self
        }
    }

    /// Whether these are a few recordings of one machine, whose mass, damping and stiffness are the same in all of them. A hand's
    /// are not.
    pub fn are_of_one_machine(self) -> bool {
        self.is_one_machine
    }

    /// Whether the model is restarted from the measured motion of any of them.
    pub fn are_restarted(self) -> bool {
        self.iter().any(|case| case.input.is_restarted())
    }

    /// The same, where there are any (else for this `reason` none) and each was measured.
    pub fn checked(
        all: &'a [FitTask<'a>],
        tally: &'a Tally,
        reason: &'static str,
    ) -> Result<Self, DiagnoseError> {
        if all.is_empty() {
            return Err(DiagnoseError::NothingToCompare {
                reason: reason.to_owned(),
            });
        }
        for case in all {
            let parameters = case.model.free().len();
            let (samples, quantity) = (case.measured().len(), case.quantity());
            match samples.saturating_sub(case.unscored()) {
                _ if samples == 0 => return Err(IdentifyError::MissingOutput { quantity }.into()),
                residuals if residuals < parameters => {
                    return Err(IdentifyError::TooShort {
                        residuals,
                        parameters,
                    }
                    .into());
                }
                _ => {}
            }
        }
        Ok(Self::new(all, tally))
    }

    /// Other tightenings, the work counted with that of these.
    pub fn others<'b>(self, all: &'b [FitTask<'b>]) -> Cases<'b>
    where
        'a: 'b,
    {
        let Self {
            tally,
            is_one_machine,
            follower,
            ..
        } = self;
        Cases {
            all,
            tally,
            is_one_machine,
            follower,
        }
    }

    /// Some of them.
    pub fn some(self, members: &[usize]) -> Vec<FitTask<'a>> {
        members
            .iter()
            .map(|&member| self.all[member].lent())
            .collect()
    }

    pub fn tally(self) -> &'a Tally {
        self.tally
    }
}

impl<'a> Deref for Cases<'a> {
    type Target = [FitTask<'a>];

    fn deref(&self) -> &[FitTask<'a>] {
        self.all
    }
}

/// Counts that grow from any thread. Sums do not depend on who adds first, so the totals are the same for any number of
/// threads as long as what is done is.
#[derive(Default)]
pub(crate) struct Tally {
    rankings: AtomicUsize,
    signatures: AtomicUsize,
    pooled_fits: AtomicUsize,
    steps: AtomicUsize,
    linearizations: AtomicUsize,
    conic_solves: AtomicUsize,
}

impl Tally {
    pub fn ranking(&self) {
        add(&self.rankings, 1);
    }

    pub fn signatures(&self, count: usize) {
        add(&self.signatures, count);
    }

    pub fn pooled_fit(&self, work: &Work) {
        add(&self.pooled_fits, 1);
        add(&self.steps, work.iterations);
        add(&self.linearizations, work.linearizations);
        add(&self.conic_solves, work.conic_solves);
    }

    pub fn fit_alone(&self, estimate: &Estimate) {
        add(&self.steps, estimate.iterations);
        add(&self.linearizations, estimate.evaluations);
        add(&self.conic_solves, estimate.conic_solves);
    }

    /// What has been counted so far.
    pub fn done(&self) -> WorkDone {
        let of = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        WorkDone {
            rankings: of(&self.rankings),
            signatures: of(&self.signatures),
            pooled_fits: of(&self.pooled_fits),
            steps: of(&self.steps),
            linearizations: of(&self.linearizations),
            conic_solves: of(&self.conic_solves),
        }
    }
}

fn add(count: &AtomicUsize, more: usize) {
    count.fetch_add(more, Ordering::Relaxed);
}
