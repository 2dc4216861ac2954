//! The logged torque as a simulation uses it: between samples, before the first, and a delay ago.

use crate::error::ModelError;
use crate::input::grid::grid;
use crate::input::position::Position;
use crate::input::restart::Restarts;
use crate::input::slope;
use snug_campaign::Intersample;
use snug_signal::first_not_finite;
use std::sync::{Arc, OnceLock};

/// How much finer than the samples a band-limited input is represented.
const BAND_LIMITED_SUBSTEPS: usize = 8;

/// The input (torque) of one simulation, prepared once and used for every trial of the parameters.
///
/// Between its grid points it is constant (zero-order) or straight (linear); these are the samples, or as many to a sample as
/// [`Input::in_steps`] asks for. A band-limited input is carried by straight pieces on a grid eight times as fine, whose in-band spectrum
/// equals the samples' own.
#[derive(Debug, Clone)]
pub struct Input {
    /// The samples it was made from.
    logged: Arc<[f64]>,
    /// The first sample that is no finite number, and what it is.
    not_finite: Option<(usize, f64)>,
    grid: Vec<f64>,
    grid_interval_s: f64,
    substeps: usize,
    samples: usize,
    intersample: Intersample,
    rest_before_s: f64,
    before_nm: Option<f64>,
    onset_s: f64,
    zero_at: Option<usize>,
    pub(super) restarts: Restarts,
    /// Made when an effect first asks for the torque between samples.
    between: OnceLock<Vec<f64>>,
    /// Made when an effect first asks for the torque's slope.
    slopes: OnceLock<Vec<f64>>,
}

impl Input {
    /// From samples \[Nm\] taken every `interval_s`; [`Input::check`] says whether that can be simulated.
    pub fn new(samples: &[f64], interval_s: f64, intersample: Intersample) -> Self {
        let substeps = match intersample {
            Intersample::BandLimited => BAND_LIMITED_SUBSTEPS,
            Intersample::ZeroOrder | Intersample::Linear => 1,
        };
        Self {
            logged: samples.into(),
            not_finite: not_finite(samples),
            grid: grid(samples, intersample, substeps),
            grid_interval_s: interval_s / substeps as f64,
            substeps,
            samples: samples.len(),
            intersample,
            rest_before_s: 0.0,
            before_nm: None,
            onset_s: 0.0,
            zero_at: None,
            restarts: Restarts::default(),
            between: OnceLock::new(),
            slopes: OnceLock::new(),
        }
    }

    /// An input of other samples \[Nm\], of which the same is known beside them.
    pub fn of_others(&self, samples: &[f64], interval_s: f64, intersample: Intersample) -> Self {
        Self {
            rest_before_s: self.rest_before_s,
            before_nm: self.before_nm,
            onset_s: self.onset_s,
            zero_at: self.zero_at,
            ..Self::new(samples, interval_s, intersample)
        }
    }

    /// The same held or straight input as it was logged, simulated in `steps` from sample to sample: where a law turns sooner than the
    /// samples follow. A band-limited one has a grid of its own and stays as it is.
    pub fn in_steps(self, steps: usize) -> Self {
        match self.is_band_limited() || self.substeps == steps {
            true => self,
            false => self.with_substeps(steps),
        }
    }

    /// The same band-limited input as it was logged, on a grid `substeps` times as fine as the samples: coarser, it is simulated sooner and
    /// less exactly. Any other stays as it is.
    pub fn on_grid(&self, substeps: usize) -> Self {
        match self.is_band_limited() {
            true => self.with_substeps(substeps),
            false => self.clone(),
        }
    }

    fn with_substeps(&self, substeps: usize) -> Self {
        let apart = self.restarts.apart() / self.substeps;
        Self {
            grid: grid(&self.logged, self.intersample, substeps),
            grid_interval_s: self.interval_s() / substeps as f64,
            substeps,
            restarts: self.restarts.moved_apart(apart * substeps),
            between: OnceLock::new(),
            slopes: OnceLock::new(),
            ..self.clone()
        }
    }

    /// The same input with every value replaced by the mean over it and `reach` samples on either side.
    ///
    /// What is computed from it knows the torque's course, but hardly the noise of any one sample.
    pub fn smoothed(&self, reach: usize) -> Self {
        let reach = reach * self.substeps;
        let sums = slope::sums(&self.grid);
        let last = self.grid.len().saturating_sub(1);
        let mean = |index: usize| {
            let reach = reach.min(index).min(last - index);
            (sums[index + reach + 1] - sums[index - reach]) / (2 * reach + 1) as f64
        };
        Self {
            grid: (0..self.grid.len()).map(mean).collect(),
            between: OnceLock::new(),
            slopes: OnceLock::new(),
            ..self.clone()
        }
    }

    /// The same input with `noise` \[Nm\], one value per sample, on top; what was logged stays what it is.
    pub fn with_added(&self, noise: &[f64]) -> Self {
        let not_finite = self.not_finite.or(not_finite(noise));
        let noise = grid(noise, self.intersample, self.substeps);
        let sum = self
            .grid
            .iter()
            .zip(noise)
            .map(|(torque, more)| torque + more);
        Self {
            not_finite,
            grid: sum.collect(),
            between: OnceLock::new(),
            slopes: OnceLock::new(),
            ..self.clone()
        }
    }

    /// The same input up to its `samples`-th sample.
    pub fn beginning(&self, samples: usize) -> Self {
        let samples = samples.min(self.samples);
        let points = samples.saturating_sub(1) * self.substeps + 1;
        Self {
            logged: self.logged[..samples].into(),
            not_finite: self.not_finite.filter(|&(sample, _)| sample < samples),
            grid: self.grid[..points.min(self.grid.len())].to_vec(),
            samples,
            between: OnceLock::new(),
            slopes: OnceLock::new(),
            ..self.clone()
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

    /// States the torque \[Nm\] before the first sample; `None`, as without it, where that is the first sample's.
    pub fn with_torque_before(mut self, before_nm: Option<f64>) -> Self {
        self.before_nm = before_nm;
        self
    }

    /// The torque before the first sample \[Nm\]; `None` where that is the first sample's.
    pub fn torque_before_nm(&self) -> Option<f64> {
        self.before_nm
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

    /// Time between samples \[s\].
    pub fn interval_s(&self) -> f64 {
        self.grid_interval_s * self.substeps as f64
    }

    /// The samples it was made from, one by one \[Nm\]: what was logged, without what was added or averaged since.
    pub fn logged_nm(&self) -> &[f64] {
        &self.logged
    }

    /// Checks that a simulation can make something of it.
    ///
    /// # Errors
    /// [`ModelError::NoSamples`], [`ModelError::InputTime`], [`ModelError::InputValue`].
    pub fn check(&self) -> Result<(), ModelError> {
        if self.grid.is_empty() {
            return Err(ModelError::NoSamples);
        }
        check_interval(self.interval_s())?;
        for (what, value_s) in [
            ("onset_s", self.onset_s),
            ("rest_before_s", self.rest_before_s),
        ] {
            if !value_s.is_finite() {
                return Err(ModelError::InputTime {
                    what,
                    value_s,
                    allowed: "a finite number",
                });
            }
        }
        match self.not_finite {
            Some((sample, value_nm)) => Err(ModelError::InputValue { sample, value_nm }),
            None => Ok(()),
        }
    }

    /// The torque as it was `delay_s` before every grid point; the ends are held, the first unless
    /// [`Input::with_torque_before`] says what was there: from that it then rises within the interval before the first sample.
    ///
    /// Between samples it is what a torque without anything above half the sampling rate has there: that keeps the
    /// power of the torque's noise, where a straight line between samples takes half of it away and a shift by half a
    /// sample would always fit better than none. The slope of a torque that is straight between samples is its rate, which
    /// hardly knows the noise: noise that moves along with a delay says nothing about it, and a slope that counted it would
    /// make the delay's interval far too narrow. A held input is straight: shifted by part of an interval, it has the
    /// straight line's values as its means over the intervals.
    pub fn before(&self, delay_s: f64) -> Vec<Earlier> {
        let slopes = (self.slopes)
            .get_or_init(|| slope::slopes(&self.grid, self.grid_interval_s, self.substeps));
        let is_straight = self.intersample == Intersample::Linear;
        let (fine, step) = match is_straight {
            true => (self.between(), self.between_grid_points()),
            false => (self.grid.as_slice(), 1),
        };
        let fine_interval_s = self.grid_interval_s / step as f64;
        // A delay is the same part of an interval before every grid point.
        let then = Position::new(-delay_s / self.grid_interval_s);
        let then_in_fine = Position::new(-delay_s / fine_interval_s);
        let earlier = |point: usize| {
            let then = then.moved(point);
            let (rate_nm_per_s, change_nm_per_s2) = then.straight(slopes, self.grid_interval_s);
            let risen = then.rising(self.before_nm, &self.grid, self.grid_interval_s);
            let (torque_nm, slope_nm_per_s) = match (risen, self.held()) {
                (Some(risen), _) => risen,
                (None, true) => then.straight(&self.grid, self.grid_interval_s),
                (None, false) => then_in_fine
                    .moved(step * point)
                    .curved(fine, fine_interval_s),
            };
            let is_still = slope_nm_per_s == 0.0;
            Earlier {
                torque_nm,
                slope_nm_per_s: match is_straight && !is_still && risen.is_none() {
                    true => rate_nm_per_s,
                    false => slope_nm_per_s,
                },
                rate_nm_per_s,
                change_nm_per_s2,
            }
        };
        (0..self.grid.len()).map(earlier).collect()
    }

    /// The samples and what lies between them, so many from one [grid point](Self::between_grid_points) to the next.
    fn between(&self) -> &[f64] {
        self.between.get_or_init(|| {
            let samples: Vec<f64> = self.grid.iter().copied().step_by(self.substeps).collect();
            snug_signal::between_samples(&samples, self.substeps * self.between_grid_points())
        })
    }

    /// As many as make at least [`BAND_LIMITED_SUBSTEPS`] from sample to sample.
    fn between_grid_points(&self) -> usize {
        BAND_LIMITED_SUBSTEPS.div_ceil(self.substeps)
    }

    /// Torque at the grid points \[Nm\].
    pub fn grid_nm(&self) -> &[f64] {
        &self.grid
    }

    /// Time between grid points \[s\].
    pub fn grid_interval_s(&self) -> f64 {
        self.grid_interval_s
    }

    /// Grid points per sample.
    pub fn substeps(&self) -> usize {
        self.substeps
    }

    /// Whether the input keeps each grid value until the next.
    pub fn held(&self) -> bool {
        self.intersample == Intersample::ZeroOrder
    }

    /// Whether it is carried by a grid of its own.
    pub fn is_band_limited(&self) -> bool {
        self.intersample == Intersample::BandLimited
    }
}

/// Checks the time between samples.
///
/// # Errors
/// [`ModelError::InputTime`].
pub(crate) fn check_interval(interval_s: f64) -> Result<(), ModelError> {
    match interval_s > 0.0 && interval_s.is_finite() {
        true => Ok(()),
        false => Err(ModelError::InputTime {
            what: "interval_s",
            value_s: interval_s,
            allowed: "a positive, finite number",
        }),
    }
}

/// The first sample that is no finite number, and what it is.
fn not_finite(samples: &[f64]) -> Option<(usize, f64)> {
    first_not_finite(samples).map(|sample| (sample, samples[sample]))
}

/// A torque some time ago.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Earlier {
    /// The torque \[Nm\].
    pub torque_nm: f64,
    /// How it changes with time \[Nm/s\].
    pub slope_nm_per_s: f64,
    /// The same over as many milliseconds as its course allows \[Nm/s\]: a slope from one neighbour to the other would be
    /// mostly noise, which a lag of several milliseconds multiplies.
    pub rate_nm_per_s: f64,
    /// How fast that changes \[Nm/s²\].
    pub change_nm_per_s2: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::even_noise::even_noise;
    use std::f64::consts::TAU;

    fn power(values: impl Iterator<Item = f64>) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for value in values {
            sum += value * value;
            count += 1;
        }
        sum / f64::from(count)
    }

    /// A straight line between two independent samples has half their power in its middle.
    #[test]
    fn a_shift_by_half_a_sample_keeps_the_power_of_noise() {
        let samples = even_noise(20_000);
        let input = Input::new(&samples, 1e-4, Intersample::Linear);
        let power_before = |delay_s| {
            let earlier = input.before(delay_s);
            power(earlier[100..19_900].iter().map(|then| then.torque_nm))
        };
        let (shifted, there) = (power_before(0.5e-4), power_before(0.0));
        assert!(
            (there - 1.0).abs() < 0.03 && (shifted / there - 1.0).abs() < 0.02,
            "{there} {shifted}"
        );
    }

    /// A sine of 20 samples, now and 2.3 samples ago.
    #[test]
    fn a_band_limited_input_is_the_same_on_a_coarser_grid() {
        let sine = |sample: f64| (TAU * sample / 20.0).sin();
        let samples: Vec<f64> = (0..400).map(|k| sine(f64::from(k))).collect();
        let input = Input::new(&samples, 0.01, Intersample::BandLimited)
            .with_restarts(50, vec![[1.0, 2.0]; 8]);
        for substeps in [2, 4, 8] {
            let coarser = input.on_grid(substeps);
            assert_eq!(coarser.substeps(), substeps);
            assert!((coarser.interval_s() - 0.01).abs() < 1e-15);
            assert_eq!(coarser.grid_nm().len(), 399 * substeps + 1);
            assert_eq!(coarser.samples_between_restarts(), Some(50));
            assert_eq!(coarser.restart_at(50 * substeps), Some([1.0, 2.0]));
            for (late, delay_s) in [(0.0, 0.0), (2.3, 0.023)] {
                let earlier = coarser.before(delay_s);
                for sample in 100..300 {
                    let found = earlier[sample * substeps].torque_nm;
                    let expected = sine(sample as f64 - late);
                    assert!((found - expected).abs() < 0.01, "{found} {expected}");
                }
            }
        }
        let straight = Input::new(&samples, 0.01, Intersample::Linear);
        assert_eq!(straight.on_grid(4).substeps(), 1);
    }

    #[test]
    fn before_the_first_sample_there_was_what_is_said_or_the_same() {
        let samples = [4.0, 2.0, 2.0, 2.0];
        for intersample in [Intersample::Linear, Intersample::ZeroOrder] {
            let input = Input::new(&samples, 0.1, intersample);
            let at = |input: &Input, delay_s| -> Vec<[f64; 2]> {
                let earlier = input.before(delay_s);
                let pairs = earlier
                    .iter()
                    .map(|then| [then.torque_nm, then.slope_nm_per_s]);
                pairs.take(2).collect()
            };
            assert_eq!(at(&input, 0.25), [[4.0, 0.0], [4.0, 0.0]]);
            let input = input.with_torque_before(Some(1.0));
            let [first, second] = at(&input, 0.125)[..] else {
                panic!("there are four samples")
            };
            assert_eq!(first, [1.0, 0.0]);
            let off = (second[0] - 3.25).abs() + (second[1] - 30.0).abs();
            assert!(off < 1e-9, "{second:?}");
        }
    }

    #[test]
    fn a_beginning_ends_on_its_last_sample() {
        let samples = even_noise(400);
        for intersample in [Intersample::Linear, Intersample::BandLimited] {
            let whole = Input::new(&samples, 0.01, intersample);
            let beginning = whole.beginning(100);
            assert_eq!(beginning.samples(), 100);
            let points = beginning.grid_nm();
            assert_eq!(points.len(), 99 * whole.substeps() + 1);
            assert_eq!(points, &whole.grid_nm()[..points.len()]);
        }
    }

    /// The slope at a sample says nothing about that sample's noise, so that a small delay cannot take it away.
    #[test]
    fn the_slope_at_a_sample_does_not_know_its_noise() {
        let samples = even_noise(20_000);
        let input = Input::new(&samples, 1.0, Intersample::Linear);
        let now = input.before(0.0);
        let product: f64 = (100..19_900)
            .map(|i| now[i].slope_nm_per_s * samples[i])
            .sum();
        // Σ of 19 800 products of spread 0.7 and mean 0; a line to the next sample would give −19 800.
        assert!(product.abs() < 4.0 * 0.8 * 19_800_f64.sqrt(), "{product}");
    }
}
