//! The base model swept over the samples of tightenings that stand side by side in the lanes of the vector registers.

use crate::linear::{Constants, Oscillator, Recursion};
use crate::normal_equations::Run;
use crate::real::Task;
use crate::{Input, NormalEquations, Real};
use snug_campaign::{Quantity, Rig};
use std::borrow::Cow;
use std::ops::Range;

/// What is scored of one tightening, torque and measurement weighed alike.
///
/// Weights are a filter over the samples (the one that makes the noise white). The model is linear and does not change
/// with time, so instead of filtering its output and every sensitivity in every sweep, the torque is filtered once:
/// from the filtered state at the first scored sample on, the model answers with the filtered output. What was cheap
/// stays cheap, however long the filter.
#[derive(Debug, Clone)]
pub struct ScoredRecord<'a> {
    /// The rig's constants.
    pub rig: Rig,
    /// The torque, as logged.
    pub input: &'a Input,
    /// f_0, f_1, …: the weighed signal is Σ f_j s_{t−j} with j in samples.
    pub filter: Vec<f64>,
    /// Number of the first scored sample, at least the filter's order.
    pub first: usize,
    /// Filtered torque at every grid point from there on.
    pub torque_nm: Cow<'a, [f64]>,
    /// Filtered measurement at every sample from there on.
    pub measured: Cow<'a, [f64]>,
}

/// Tightenings side by side, one in every lane, ready to be swept again and again.
///
/// A lane can be loaded with another tightening between two sweeps; what stands in the others does not change a bit of
/// its results.
#[derive(Debug)]
pub struct Sweep<R> {
    pub(crate) zero: R,
    pub(crate) quantity: Quantity,
    pub(crate) substeps: usize,
    pub(crate) torque_nm: Vec<R>,
    pub(crate) measured: Vec<R>,
    pub(crate) lanes: Vec<Lane>,
}

/// What is known of one lane besides its signals.
#[derive(Debug, Clone, Default)]
pub(crate) struct Lane {
    pub square_m2: f64,
    known_inertia_kg_m2: f64,
    interval_s: f64,
    held: bool,
    /// Samples before the first scored one.
    first: usize,
    /// Scored samples.
    pub samples: usize,
    filter: Vec<f64>,
    /// Logged torque at the grid points up to the first scored sample \[Nm\].
    lead_nm: Vec<f64>,
}

impl<R: Real> Sweep<R> {
    /// All lanes empty; inputs must have `substeps` grid points per sample.
    pub fn new(zero: R, quantity: Quantity, substeps: usize) -> Self {
        Self {
            zero,
            quantity,
            substeps,
            torque_nm: Vec::new(),
            measured: Vec::new(),
            lanes: vec![Lane::default(); R::LANES],
        }
    }

    /// Gives lanes to tightenings, part by part of their signals: writing all lanes of a register while it is at hand
    /// takes a fraction of the time of writing them one after the other.
    pub fn load<'r>(&mut self, records: impl Iterator<Item = (usize, &'r ScoredRecord<'r>)>) {
        let records: Vec<(usize, &ScoredRecord<'_>)> = records.collect();
        for &(lane, record) in &records {
            let lead = record.first * self.substeps + 1;
            self.lanes[lane] = Lane {
                square_m2: record.rig.lever_arm_m * record.rig.lever_arm_m,
                known_inertia_kg_m2: record.rig.known_inertia_kg_m2,
                interval_s: record.input.grid_interval_s(),
                held: record.input.held(),
                first: record.first,
                samples: record.measured.len(),
                filter: record.filter.clone(),
                lead_nm: record.input.grid_nm()[..lead].to_vec(),
            };
        }
        let measured = |record: &'r ScoredRecord<'r>| &record.measured[..];
        place(&mut self.measured, &records, measured, self.zero);
        place(
            &mut self.torque_nm,
            &records,
            |record| &record.torque_nm,
            self.zero,
        );
        // The recursion looks one sample ahead, also behind the last one, where it changes nothing any more.
        let ahead = self.substeps * self.measured.len() + 1;
        if self.torque_nm.len() < ahead {
            self.torque_nm.resize(ahead, self.zero);
        }
    }

    /// Takes the tightening out of a lane.
    pub fn unload(&mut self, lane: usize) {
        self.lanes[lane] = Lane::default();
    }

    /// The normal equations of every lane at its own m, c, k.
    pub fn run(&self, values: &[[f64; 3]]) -> Vec<NormalEquations> {
        let mut found = vec![NormalEquations::default(); R::LANES];
        self.sum(values, 1, |lane, so_far| found[lane] = so_far);
        found
    }

    /// The gradient Jᵀr of every lane, stretch by stretch: the samples in about `stretches` parts of equal length.
    pub fn scores(&self, values: &[[f64; 3]], stretches: usize) -> Vec<Vec<[f64; 3]>> {
        let mut before = vec![[0.0; 3]; R::LANES];
        let mut scores = vec![Vec::new(); R::LANES];
        self.sum(values, stretches, |lane, so_far| {
            let (now, before) = (so_far.gradient, &mut before[lane]);
            scores[lane].push(std::array::from_fn(|i| now[i] - before[i]));
            *before = now;
        });
        scores
    }

    /// Hands what has been summed up to the end of each stretch of each lane to `read`.
    fn sum(&self, values: &[[f64; 3]], stretches: usize, read: impl FnMut(usize, NormalEquations)) {
        let stretch = |lane: &Lane| lane.samples.div_ceil(stretches).max(1);
        self.zero.vectorize(Run {
            sweep: self,
            values,
            stretches: self.lanes.iter().map(stretch).collect(),
            read,
        });
    }

    /// J of every lane at its own m, c, k, sample by sample, into `rows`; zero before the first scored sample of a lane
    /// and behind its last.
    pub fn sensitivities(&self, values: &[[f64; 3]], rows: &mut Vec<[R; 3]>) {
        let ends = |lane: &Lane| lane.first + lane.samples;
        let longest = self.lanes.iter().map(ends).max().unwrap_or(0);
        rows.resize(longest, [self.zero; 3]);
        let first = self.lanes.iter().map(|lane| lane.first).max().unwrap_or(0);
        debug_assert!(
            self.lanes
                .iter()
                .all(|lane| lane.samples == 0 || lane.first == first)
        );
        rows[..first].fill([self.zero; 3]);
        self.zero.vectorize(Trace {
            sweep: self,
            values,
            rows: &mut rows[first..],
        });
        for (number, lane) in self.lanes.iter().enumerate() {
            for row in &mut rows[ends(lane)..] {
                row.iter_mut()
                    .for_each(|entry| entry.lanes_mut()[number] = 0.0);
            }
        }
    }

    /// The constants, the recursion and the filtered states at the first scored sample.
    #[inline(always)]
    pub(crate) fn begin(&self, values: &[[f64; 3]]) -> States<R> {
        let square = self.each(|lane| lane.square_m2);
        let known = self.each(|lane| lane.known_inertia_kg_m2);
        let interval_s = self.each(|lane| lane.interval_s);
        let constants = Constants::new(&Oscillator {
            inertia_kg_m2: self.value(values, 0) * square + known,
            damping_nm_s_per_rad: self.value(values, 1) * square,
            stiffness_nm_per_rad: self.value(values, 2) * square,
        });
        let recursion = Recursion::new(&constants, interval_s, |lane| self.lanes[lane].held);
        let mut x = [self.zero; 4];
        for (number, lane) in self.lanes.iter().enumerate() {
            if lane.first == 0 {
                continue;
            }
            let start = lane.start(&recursion.lane(number), self.substeps);
            for (x, start) in x.iter_mut().zip(start) {
                x.lanes_mut()[number] = start;
            }
        }
        States {
            constants,
            recursion,
            x,
        }
    }

    /// Goes over some samples and hands r and its derivatives by m, c, k, the factor b1² l² left out, of each to `visit`.
    #[inline(always)]
    pub(crate) fn walk<const DOTS: usize>(
        &self,
        states: &mut States<R>,
        samples: Range<usize>,
        mut visit: impl FnMut([R; 4]),
    ) {
        let States {
            constants,
            recursion,
            mut x,
        } = *states;
        let inverse = constants.inverse();
        let grid = samples.start * self.substeps..=samples.end * self.substeps;
        let mut torque = self.torque_nm[grid].windows(2);
        for &y in &self.measured[samples] {
            for substep in 0..self.substeps {
                let Some(&[u, next]) = torque.next() else {
                    return;
                };
                if substep == 0 {
                    let all = constants.derivatives(x, u);
                    let r = y - inverse * all.g[DOTS];
                    visit([r, all.z[DOTS + 2], all.z[DOTS + 1], all.z[DOTS]]);
                }
                x = recursion.step(x, u, next);
            }
        }
        states.x = x;
    }

    /// One parameter of every lane.
    #[inline(always)]
    fn value(&self, values: &[[f64; 3]], index: usize) -> R {
        self.zero.lane_by_lane(
            #[inline(always)]
            |lane| values[lane][index],
        )
    }

    /// One constant of every lane.
    #[inline(always)]
    fn each(&self, of: impl Fn(&Lane) -> f64) -> R {
        self.zero.lane_by_lane(
            #[inline(always)]
            |lane| of(&self.lanes[lane]),
        )
    }
}

/// Samples of every signal that are placed before those that follow.
const PART: usize = 64;

/// Puts signals into their lanes.
fn place<'r, R: Real>(
    side_by_side: &mut Vec<R>,
    records: &[(usize, &'r ScoredRecord<'r>)],
    signal: impl Fn(&'r ScoredRecord<'r>) -> &'r [f64],
    zero: R,
) {
    let longest = records.iter().map(|(_, record)| signal(record).len()).max();
    let longest = longest.unwrap_or(0).max(side_by_side.len());
    side_by_side.resize(longest, zero);
    for (part, points) in side_by_side.chunks_mut(PART).enumerate() {
        for &(lane, record) in records {
            let values = signal(record).get(part * PART..).unwrap_or_default();
            for (point, &value) in points.iter_mut().zip(values) {
                point.lanes_mut()[lane] = value;
            }
        }
    }
}

impl Lane {
    /// The filtered state at the first scored sample.
    fn start(&self, recursion: &Recursion<f64>, substeps: usize) -> [f64; 4] {
        let (mut x, mut sum) = ([0.0; 4], [0.0; 4]);
        for (point, pair) in self.lead_nm.windows(2).enumerate() {
            if point.is_multiple_of(substeps) {
                self.add(self.first - point / substeps, &x, &mut sum);
            }
            x = recursion.step(x, pair[0], pair[1]);
        }
        self.add(0, &x, &mut sum);
        sum
    }

    fn add(&self, lag: usize, x: &[f64; 4], sum: &mut [f64; 4]) {
        if let Some(weight) = self.filter.get(lag) {
            sum.iter_mut()
                .zip(x)
                .for_each(|(sum, x)| *sum += weight * x);
        }
    }
}

/// Where a run over the samples stands.
#[derive(Clone, Copy)]
pub(crate) struct States<R> {
    constants: Constants<R>,
    recursion: Recursion<R>,
    /// g, g′, z, z′.
    x: [R; 4],
}

impl<R: Real> States<R> {
    /// b1 of one lane.
    pub fn inverse_inertia(&self, lane: usize) -> f64 {
        self.constants.inverse().lanes()[lane]
    }
}

/// One run that keeps every sensitivity.
struct Trace<'a, R> {
    sweep: &'a Sweep<R>,
    values: &'a [[f64; 3]],
    rows: &'a mut [[R; 3]],
}

impl<R: Real> Task for Trace<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        match self.sweep.quantity {
            Quantity::Displacement => self.keep::<0>(),
            Quantity::Velocity => self.keep::<1>(),
            Quantity::Acceleration => self.keep::<2>(),
        }
    }
}

impl<R: Real> Trace<'_, R> {
    #[inline(always)]
    fn keep<const DOTS: usize>(self) {
        let mut states = self.sweep.begin(self.values);
        let inverse = states.constants.inverse();
        let factor = inverse * inverse * self.sweep.each(|lane| lane.square_m2);
        let samples = 0..self.rows.len();
        let mut rows = self.rows.iter_mut();
        self.sweep.walk::<DOTS>(
            &mut states,
            samples,
            #[inline(always)]
            |[_, m, c, k]| {
                if let Some([by_m, by_c, by_k]) = rows.next() {
                    (*by_m, *by_c, *by_k) = (factor * m, factor * c, factor * k);
                }
            },
        );
    }
}
