use crate::band_limited;
use snug_campaign::Intersample;

/// How much finer than the samples a band-limited input is represented.
const BAND_LIMITED_SUBSTEPS: usize = 8;

/// The input (torque) of one simulation, prepared once and used for every trial of the parameters.
///
/// Between its grid points it is constant (zero-order) or straight (linear). A band-limited input is carried by straight
/// pieces on a grid eight times as fine, whose in-band spectrum equals the samples' own.
#[derive(Debug, Clone)]
pub struct Input {
    grid: Vec<f64>,
    grid_interval_s: f64,
    substeps: usize,
    samples: usize,
    held: bool,
    rest_before_s: f64,
    onset_s: f64,
    zero_at: Option<usize>,
}

impl Input {
    /// From samples \[Nm\] taken every `interval_s`.
    pub fn new(samples: &[f64], interval_s: f64, intersample: Intersample) -> Self {
        let (grid, substeps) = match intersample {
            Intersample::BandLimited => (
                band_limited::straight_pieces(samples, BAND_LIMITED_SUBSTEPS),
                BAND_LIMITED_SUBSTEPS,
            ),
            Intersample::ZeroOrder | Intersample::Linear => (samples.to_vec(), 1),
        };
        Self {
            grid,
            grid_interval_s: interval_s / substeps as f64,
            substeps,
            samples: samples.len(),
            held: intersample == Intersample::ZeroOrder,
            rest_before_s: 0.0,
            onset_s: 0.0,
            zero_at: None,
        }
    }

    /// States for how long \[s\] before the first sample the sensor's signal was already being integrated.
    pub fn with_rest_before(mut self, rest_before_s: f64) -> Self {
        self.rest_before_s = rest_before_s;
        self
    }

    /// For how long before the first sample the sensor's signal was already being integrated \[s\].
    pub fn rest_before_s(&self) -> f64 {
        self.rest_before_s
    }

    /// States when the pulse begins \[s after the first sample\]; without it, at the first sample.
    pub fn with_onset(mut self, onset_s: f64) -> Self {
        self.onset_s = onset_s;
        self
    }

    /// When the pulse begins \[s after the first sample\].
    pub fn onset_s(&self) -> f64 {
        self.onset_s
    }

    /// States that the measured displacement was zeroed by taking its value at this sample off the whole signal.
    ///
    /// The simulated displacement of a model with sensor effects is zeroed there, too. A sample beyond the last counts as
    /// the last.
    pub fn with_zero_at(mut self, sample: Option<usize>) -> Self {
        self.zero_at = sample;
        self
    }

    /// The sample at which the measured displacement was zeroed.
    pub fn zero_at(&self) -> Option<usize> {
        let last = self.samples.saturating_sub(1);
        self.zero_at.map(|sample| sample.min(last))
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Torque \[Nm\] and its slope \[Nm/s\] at `time_s` after the first sample; the ends are held.
    ///
    /// Straight between grid points for a held input too: shifted by part of an interval, a held input has the straight
    /// line's values as its means over the intervals.
    pub fn at(&self, time_s: f64) -> (f64, f64) {
        self.straight(time_s, |index| self.grid[index])
    }

    /// Slope of the torque \[Nm/s\] and how fast it changes \[Nm/s²\] at `time_s` after the first sample.
    ///
    /// Straight between the grid points' own slopes, which are those from one neighbour to the other.
    pub fn slope_at(&self, time_s: f64) -> (f64, f64) {
        self.straight(time_s, |index| {
            let (before, after) = (
                index.saturating_sub(1),
                (index + 1).min(self.grid.len() - 1),
            );
            let span = (after - before).max(1) as f64 * self.grid_interval_s;
            (self.grid[after] - self.grid[before]) / span
        })
    }

    /// Value and slope at `time_s` of the line through `of(index)` at the grid points; the ends are held.
    #[inline(always)]
    fn straight(&self, time_s: f64, of: impl Fn(usize) -> f64) -> (f64, f64) {
        let Some(last) = self.grid.len().checked_sub(1) else {
            return (0.0, 0.0);
        };
        let position = time_s / self.grid_interval_s;
        if position < 0.0 {
            return (of(0), 0.0);
        }
        let index = position as usize;
        if index >= last {
            return (of(last), 0.0);
        }
        let (here, step) = (of(index), of(index + 1) - of(index));
        (
            here + step * (position - index as f64),
            step / self.grid_interval_s,
        )
    }

    /// Torque at the grid points \[Nm\].
    pub(crate) fn grid(&self) -> &[f64] {
        &self.grid
    }

    /// Time between grid points \[s\].
    pub(crate) fn grid_interval_s(&self) -> f64 {
        self.grid_interval_s
    }

    /// Grid points per sample.
    pub(crate) fn substeps(&self) -> usize {
        self.substeps
    }

    /// Whether the input keeps each grid value until the next.
    pub(crate) fn held(&self) -> bool {
        self.held
    }

    /// Time since the integration of the sensor's signal began, at sample `index` \[s\].
    pub(crate) fn since_rest_s(&self, index: usize) -> f64 {
        self.rest_before_s + index as f64 * self.grid_interval_s * self.substeps as f64
    }
}
