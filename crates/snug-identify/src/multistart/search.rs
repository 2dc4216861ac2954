//! One tightening's fit where its cost has minimum beside minimum: an effect with several starts, or one with unilateral contact.

use crate::batch::BatchSimulator;
use crate::multistart::decimated::{DecimatedRecord, Tried, apart, coarse_solver};
use crate::multistart::early_stopping::{STOP_FREE, STOP_SMOOTHED, fit_starts};
use crate::multistart::multiple_shooting::try_multiple_shooting;
use crate::multistart::thresholds::{CLOSE, FAR_OFF, NEAR, SMOOTHED_TOLERANCE, SURE};
use crate::residual::smoothing::HALF_WIDTHS;
use crate::residual::tightening::TighteningResidual;
use crate::settings::IdentifySettings;
use crate::task::FitTask;
use snug_least_squares::{
    Constraints, Fit, ResidualNoise, Settings, SolveError, Status, Work, best,
};
use snug_model::BASE_PARAMETERS;
use std::iter::once;

/// What is searched, and from where.
pub(crate) struct MultistartSearch<'s, 'a> {
    pub residual: &'s TighteningResidual<'a>,
    pub set: &'s Constraints,
    /// In the order of preference.
    pub starts: &'s [Vec<f64>],
    /// The first so many differ in the effects' parameters; what follows are the same again with other m, c, k.
    pub distinct_starts: usize,
    /// On which starts are tried, where there is one.
    pub decimated: Option<&'a DecimatedRecord>,
    pub task: &'a FitTask<'a>,
    pub settings: &'s IdentifySettings,
    pub simulator: &'s BatchSimulator<'a>,
}

impl<'a> MultistartSearch<'_, 'a> {
    /// The lowest end that was found. Where an effect lets go of the hand's spring, many optima lie close together: what
    /// leaves more than noise is begun again from where it ended, and from where it began, seen from ever nearer.
    pub async fn lowest(&self) -> Result<Fit, SolveError> {
        let fit = self.searched().await?;
        if !self.is_rugged() || self.is_beyond_doubt(&fit) {
            return Ok(fit);
        }
        let mut work = fit.work;
        let mut ends = vec![fit];
        for start in once(&ends[0].values.clone()).chain(self.starts) {
            let end = self.ever_nearer(start, &mut work).await?;
            let is_beyond_doubt = self.is_beyond_doubt(&end);
            ends.push(end);
            if is_beyond_doubt {
                break;
            }
        }
        best(ends, work)
    }

    /// Whether spikes in the residual hide the way: the measured acceleration jumps where an effect lets go.
    fn is_rugged(&self) -> bool {
        self.residual.is_whitened() && self.residual.has_unilateral_contact()
    }

    /// Where the residual leads to that is averaged over ever fewer samples.
    async fn ever_nearer(&self, start: &[f64], work: &mut Work) -> Result<Fit, SolveError> {
        let decimated = coarse_solver(self.settings, SMOOTHED_TOLERANCE);
        let mut values = start.to_vec();
        for half_width in HALF_WIDTHS {
            let smoothed = self.residual.smoothed(half_width);
            let end = self.followed(&smoothed, values, &decimated, work).await?;
            values = end.values;
        }
        self.followed(self.residual, values, &self.settings.solver, work)
            .await
    }

    /// Where a fit from one start ends.
    async fn followed(
        &self,
        residual: &TighteningResidual<'a>,
        start: Vec<f64>,
        solver: &Settings,
        work: &mut Work,
    ) -> Result<Fit, SolveError> {
        let (ends, more) = fit_starts(
            residual,
            &[start],
            self.set,
            solver,
            STOP_FREE,
            self.simulator,
        )
        .await?;
        work.add(&more);
        best(ends, more)
    }

    /// The best of the ends that the starts lead to. Of several starts, what they lead to along the measured motion is tried
    /// first; that is the answer where it leaves no doubt. Otherwise those that lead on in a decimated fit are followed to the
    /// end as well; all of them where that comes to nothing, or leaves so much that a lower minimum may have been missed.
    async fn searched(&self) -> Result<Fit, SolveError> {
        let (mut ends, mut work): (Vec<Fit>, Work) = Default::default();
        let mut follow = async |starts: &[Vec<f64>], before: &Work| {
            let (more, on_all) = self.fitted_from_starts(starts).await?;
            ends.extend(more);
            work.add(before);
            work.add(&on_all);
            best(ends.clone(), work)
        };
        if let Some(decimated) = self.decimated {
            if let Some(restarted) = self.restarted(decimated).await? {
                let fit = follow(&restarted.starts, &restarted.work).await?;
                if self.is_beyond_doubt(&fit) {
                    return Ok(fit);
                }
            }
            let (task, set, settings) = (self.task, self.set, self.settings);
            let tried = decimated.try_from(self.starts, task, set, settings, self.simulator);
            if let Some(tried) = tried.await? {
                let fit = follow(&tried.starts, &tried.work).await?;
                if fit.status.is_converged() && !self.is_far_off(&fit) {
                    return Ok(fit);
                }
            }
        }
        follow(self.starts, &Work::default()).await
    }

    /// The ends that these starts lead to; where spikes hide the way, by way of where the averaged residual leads.
    pub async fn fitted_from_starts(
        &self,
        starts: &[Vec<f64>],
    ) -> Result<(Vec<Fit>, Work), SolveError> {
        let (set, simulator, solver) = (self.set, self.simulator, &self.settings.solver);
        if !self.is_rugged() {
            return fit_starts(self.residual, starts, set, solver, STOP_FREE, simulator).await;
        }
        let smoothed = self.residual.smoothed(NEAR);
        let decimated = coarse_solver(self.settings, SMOOTHED_TOLERANCE);
        let (ends, before) =
            fit_starts(&smoothed, starts, set, &decimated, STOP_SMOOTHED, simulator).await?;
        let led = apart(ends, starts.len());
        let starts = if led.is_empty() { starts } else { &led };
        let fitted_from_starts =
            fit_starts(self.residual, starts, set, solver, STOP_FREE, simulator);
        let (ends, mut work) = fitted_from_starts.await?;
        work.add(&before);
        Ok((ends, work))
    }

    /// What the starts lead to along the measured motion, which needs no m, c, k from elsewhere; only where the noise is
    /// known, since nothing else says when a fit is good enough.
    pub async fn restarted(
        &self,
        decimated: &'a DecimatedRecord,
    ) -> Result<Option<Tried>, SolveError> {
        if !self.residual.is_whitened() {
            return Ok(None);
        }
        let distinct = &self.starts[..self.distinct_starts];
        let (task, set, settings) = (self.task, self.set, self.settings);
        try_multiple_shooting(decimated, task, distinct, set, settings, self.simulator).await
    }

    /// Whether a fit leaves hardly more than noise, inside the constraints, and the effects are surely there: another
    /// minimum may then be as low by chance, but not lower by much.
    pub fn is_beyond_doubt(&self, fit: &Fit) -> bool {
        let is_close = fit.sum_of_squares() < CLOSE * fit.residual_count as f64;
        let errors = fit.covariance(ResidualNoise::Unit).standard_errors;
        let of_effects = (self.residual.free().iter().zip(&fit.values).zip(&errors))
            .filter(|((index, _), _)| **index >= BASE_PARAMETERS.len());
        let mut of_effects =
            of_effects.map(|((_, value), error)| error.is_some_and(|e| value.abs() > SURE * e));
        fit.status == Status::Converged && is_close && of_effects.all(|is_sure| is_sure)
    }

    /// Whether a fit whose noise is known leaves far more than that.
    fn is_far_off(&self, fit: &Fit) -> bool {
        let noise = fit.residual_count as f64;
        self.residual.is_whitened() && fit.sum_of_squares() > FAR_OFF * noise
    }
}
