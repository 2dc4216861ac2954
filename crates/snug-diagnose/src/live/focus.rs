//! A closer look: some of the tightenings, or a stretch of each, under the models that were fitted to all.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use snug_identify::FitTask;
use snug_least_squares::PooledSettings;
use std::ops::Range;

/// Which tightenings, and which of their samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Focus {
    /// Numbers of [`LiveCases::tasks`].
    pub members: Vec<usize>,
    /// Samples of each tightening's window; all where it is `None`.
    pub samples: Option<Range<usize>>,
}

impl LiveCases {
    /// The tightenings of a focus, each as long as that says.
    ///
    /// The motion before the stretch is simulated and counts for nothing.
    ///
    /// # Errors
    /// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::Identify`] for a stretch that is too short to say
    /// anything of a tightening's own parameters.
    ///
    /// # Panics
    /// Where there is no such tightening.
    pub fn focused(&self, focus: &Focus) -> Result<Self, DiagnoseError> {
        let all = focus.members.iter().map(|&member| &self.cases[member]);
        let cases: Vec<FitTask<'static>> = all
            .map(|case| stretch(case, focus.samples.as_ref()))
            .collect();
        Cases::checked(&cases, &Tally::default(), "none is looked at")?;
        Ok(Self {
            clusters: Clusters::of(&cases),
            cases,
            settings: self.settings.clone(),
            sharing: self.sharing.clone(),
            custom: self.custom.clone(),
            each_its_own: self.each_its_own,
        })
    }

    /// `fit`, which was fitted to other tightenings of which these are the numbers `members`, as it is on these: no number of it
    /// changes but what it leaves.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn as_fitted(&self, fit: &LiveFit, members: &[usize]) -> Result<LiveFit, DiagnoseError> {
        let tally = Tally::default();
        let fitted = &fit.fitted;
        let mut pooled =
            PooledModel::shared_by(self.counted(&tally), &fitted.effects, &fitted.sharing)?;
        let there = fitted.start_of(&pooled, members);
        let no_step = PooledSettings {
            max_iterations: 0,
            ..PooledSettings::default()
        };
        let stays = pooled.fit(&there, &no_step)?;
        let fitted = Fitted::new(&pooled, stays, &self.clusters);
        Ok(LiveFit::new(&self.cases, fitted))
    }
}

/// One tightening, of which only these samples count.
fn stretch(case: &FitTask<'static>, samples: Option<&Range<usize>>) -> FitTask<'static> {
    let Some(samples) = samples else {
        return case.clone();
    };
    let mut part = case.beginning(samples.end.min(case.measured().len()));
    let unscored = &mut part.settings.to_mut().unscored_samples;
    *unscored = samples.start.max(*unscored);
    part
}
