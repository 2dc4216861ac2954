//! Where a simulation takes up the measured motion again: prediction over stretches instead of one free run.

use crate::input::torque::Input;

/// Motions from which a simulation goes on, at equal distances from the first sample on.
#[derive(Debug, Clone, Default)]
pub(crate) struct Restarts {
    /// Grid points from one to the next; 0 where there are none.
    apart: usize,
    /// Angle \[rad\] and velocity \[rad/s\].
    motions: Vec<[f64; 2]>,
}

impl Restarts {
    pub(crate) fn new(apart: usize, motions: Vec<[f64; 2]>) -> Self {
        Self { apart, motions }
    }

    pub(crate) fn apart(&self) -> usize {
        self.apart
    }

    /// The same motions, `apart` grid points from one to the next.
    pub(crate) fn moved_apart(&self, apart: usize) -> Self {
        Self {
            apart,
            motions: self.motions.clone(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.apart == 0
    }

    /// What is taken up at a grid point.
    #[inline(always)]
    pub(crate) fn at(&self, point: usize) -> Option<[f64; 2]> {
        match self.apart {
            0 => None,
            apart if point.is_multiple_of(apart) => self.motions.get(point / apart).copied(),
            _ => None,
        }
    }
}

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
        for motion in &mut self.restarts.motions {
            *motion = [motion[0] + by[0], motion[1] + by[1]];
        }
        self
    }
}
