//! Where a simulation takes up the measured motion again: prediction over stretches instead of one free run.

/// Motions from which a simulation goes on, at equal distances from the first sample on.
#[derive(Debug, Clone, Default)]
pub(crate) struct Restarts {
    /// Grid points from one to the next; 0 where there are none.
    apart: usize,
    /// Angle \[rad\] and velocity \[rad/s\].
    motions: Vec<[f64; 2]>,
    /// Of each motion, variance of the angle and of the velocity times the time of a sample, over that of one sample's noise \[–\]; none
    /// where nobody knows.
    variances: Vec<[f64; 2]>,
}

impl Restarts {
    pub(crate) fn new(apart: usize, motions: Vec<[f64; 2]>) -> Self {
        Self {
            apart,
            motions,
            variances: Vec::new(),
        }
    }

    pub(crate) fn set_variances(&mut self, variances: Vec<[f64; 2]>) {
        self.variances = variances;
    }

    /// That of one motion, from the first on.
    pub(crate) fn variance(&self, motion: usize) -> Option<[f64; 2]> {
        self.variances.get(motion).copied()
    }

    pub(crate) fn apart(&self) -> usize {
        self.apart
    }

    /// The same motions, `apart` grid points from one to the next.
    pub(crate) fn moved_apart(&self, apart: usize) -> Self {
        Self {
            apart,
            ..self.clone()
        }
    }

    /// The motions that are `by` so much beside these.
    pub(crate) fn beside(&self, by: [f64; 2]) -> Self {
        let motions = self.motions.iter();
        Self {
            motions: motions.map(|[x, v]| [x + by[0], v + by[1]]).collect(),
            ..self.clone()
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
