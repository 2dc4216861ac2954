//! An input whose simulation takes up the measured motion again and again.

use crate::input::restart::Restarts;
use crate::input::torque::Input;

impl Input {
    /// States that the simulation does not run freely: every `apart` samples, from the first on, it takes up the next of
    /// `motions`, angle \[rad\] and velocity \[rad/s\]. What effects carry along (a second mass, a hysteresis) runs on.
    pub fn with_restarts(mut self, apart: usize, motions: Vec<[f64; 2]>) -> Self {
        self.restarts = Restarts::new(apart * self.substeps(), motions);
        self
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
