//! An input whose simulation takes up the measured motion again and again.

use crate::input::restart::Restarts;
use crate::input::torque::Input;
use std::ops::Range;

impl Input {
    /// States that the simulation does not run freely: every `apart` samples, from the first on, it takes up the next of
    /// `motions`, angle \[rad\] and velocity \[rad/s\]. What effects carry along (a second mass, a hysteresis) runs on.
    pub fn with_restarts(mut self, apart: usize, motions: Vec<[f64; 2]>) -> Self {
        self.restarts = Restarts::new(apart * self.substeps(), motions);
        self
    }

    /// The same whose motions were measured with these variances of the angle and of the velocity times the time of a sample, over that of one
    /// sample's noise \[–\].
    pub fn with_variances_at_restarts(mut self, variances: Vec<[f64; 2]>) -> Self {
        self.restarts.set_variances(variances);
        self
    }

    /// Those of the motion that was taken up last before a sample; `None` where nobody knows.
    pub fn variance_at_restart(&self, sample: usize) -> Option<[f64; 2]> {
        let apart = self.samples_between_restarts()?;
        self.restarts.variance(sample / apart)
    }

    /// Whether the simulation takes up the measured motion anywhere.
    pub fn is_restarted(&self) -> bool {
        !self.restarts.is_empty()
    }

    /// Samples from one restart to the next; `None` where the simulation runs freely.
    pub fn samples_between_restarts(&self) -> Option<usize> {
        self.is_restarted()
            .then(|| self.restarts.apart() / self.substeps())
    }

    /// The samples from `first` on, from each restart to the next; all in one where the simulation runs freely.
    pub fn stretches(&self, first: usize) -> impl Iterator<Item = Range<usize>> + use<> {
        let end = self.samples();
        let apart = self.samples_between_restarts().unwrap_or(end).max(1);
        let restart_after = move |sample: usize| (sample / apart + 1) * apart;
        let starts = std::iter::successors(Some(first), move |&at| Some(restart_after(at)));
        (starts.take_while(move |&at| at < end)).map(move |at| at..restart_after(at).min(end))
    }

    /// Angle \[rad\] and velocity \[rad/s\] from which the simulation goes on at a grid point.
    #[inline(always)]
    pub(crate) fn restart_at(&self, point: usize) -> Option<[f64; 2]> {
        self.restarts.at(point)
    }

    /// The same input that takes up motions which are `by` so much, angle \[rad\] and velocity \[rad/s\], beside those measured.
    pub fn with_restarts_moved(mut self, by: [f64; 2]) -> Self {
        self.restarts = self.restarts.beside(by);
        self
    }
}
