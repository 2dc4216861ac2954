//! The base model swept over the samples of tightenings that stand side by side in the lanes of the vector registers.

use crate::base_model::exact::{Constants, Oscillator, Recursion};
use crate::input::torque::Input;
use crate::numeric::lanewise::Task;
use crate::numeric::number::Real;
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
    /// f_0, f_1, …: the weighed signal is Σ f_j s_{t−j} with j in samples; where it whitens, in one over
    /// the measurement's unit.
    pub filter: Vec<f64>,
    /// Number of the first scored sample, at least the filter's order.
    pub first: usize,
    /// Filtered torque at every grid point from there on.
    pub torque_nm: Cow<'a, [f64]>,
    /// Filtered measurement at every sample from there on, in its unit times the filter's.
    pub measured: Cow<'a, [f64]>,
}

/// Tightenings side by side, one in every lane, ready to be swept again and again.
///
/// A lane can be loaded with another tightening between two sweeps; what stands in the others does not change a bit of
/// its results.
#[derive(Debug)]
pub struct Sweep<'r, R> {
    pub(crate) zero: R,
    pub(crate) quantity: Quantity,
    pub(crate) lanes: Vec<Lane>,
    substeps: usize,
    torque_nm: Vec<R>,
    measured: Vec<R>,
    /// Tightenings that have been given a lane, but whose signals do not stand in it yet.
    arriving: Vec<(usize, ScoredRecord<'r>)>,
    /// Samples whose signals this run has put into their lanes.
    placed: usize,
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

impl<'r, R: Real> Sweep<'r, R> {
    /// All lanes empty; inputs must have `substeps` grid points per sample.
    pub fn new(zero: R, quantity: Quantity, substeps: usize) -> Self {
        Self {
            zero,
            quantity,
            substeps,
            torque_nm: Vec::new(),
            measured: Vec::new(),
            lanes: vec![Lane::default(); R::LANES],
            arriving: Vec::new(),
            placed: 0,
        }
    }

    /// Gives a lane to a tightening.
    ///
    /// Its signals are put there by the next run, part by part as it comes to them: every register then enters the cache
    /// once, to be written and to be swept, where a load beforehand would fetch them all for one number each.
    pub fn load(&mut self, lane: usize, record: ScoredRecord<'r>) {
        let lead = record.first * self.substeps + 1;
        let samples = record.measured.len().max(self.measured.len());
        self.measured.resize(samples, self.zero);
        // The recursion looks one sample ahead, also behind the last one, where it changes nothing any more.
        self.torque_nm
            .resize(self.substeps * samples + 1, self.zero);
        self.unload(lane);
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
        self.arriving.push((lane, record));
    }

    /// Takes the tightening out of a lane.
    pub fn unload(&mut self, lane: usize) {
        self.arriving.retain(|(other, _)| *other != lane);
        self.lanes[lane] = Lane::default();
    }

    /// Sample by sample of every lane at its own m, c, k: into `residual` what its record says was measured minus the
    /// simulated acceleration, into `rows` J; zero behind a lane's last sample.
    ///
    /// For records that are not weighed, from their first sample on.
    pub fn course(&mut self, values: &[[f64; 3]], residual: &mut Vec<R>, rows: &mut Vec<[R; 3]>) {
        let longest = self.lanes.iter().map(|lane| lane.samples).max();
        residual.resize(longest.unwrap_or(0), self.zero);
        rows.resize(longest.unwrap_or(0), [self.zero; 3]);
        self.zero.vectorize(Course {
            sweep: self,
            values,
            residual,
            rows,
        });
        self.all_have_arrived();
        for (number, lane) in self.lanes.iter().enumerate() {
            let behind = residual[lane.samples..].iter_mut();
            let entries = behind.chain(rows[lane.samples..].as_flattened_mut());
            entries.for_each(|entry| entry.lanes_mut()[number] = 0.0);
        }
    }

    /// After a run over all samples every signal stands in its lane.
    pub(crate) fn all_have_arrived(&mut self) {
        self.arriving.clear();
    }

    /// The constants, the recursion and the filtered states at the first scored sample.
    #[inline(always)]
    pub(crate) fn begin(&mut self, values: &[[f64; 3]]) -> States<R> {
        self.placed = 0;
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

    /// Goes over some samples, at most [`BLOCK`], and hands of each to `visit` the `MEASURED`th derivative's residual r
    /// and the `DOTS`th's derivatives by m, c, k, the factor b1² l² left out.
    #[inline(always)]
    pub(crate) fn walk<const MEASURED: usize, const DOTS: usize>(
        &mut self,
        states: &mut States<R>,
        samples: Range<usize>,
        mut visit: impl FnMut([R; 4]),
    ) {
        while self.placed < samples.end {
            self.place_part();
        }
        let grid = samples.start * self.substeps..samples.end * self.substeps + 1;
        let States {
            constants,
            recursion,
            mut x,
        } = *states;
        let inverse = constants.inverse();
        let mut torque = self.torque_nm[grid].windows(2);
        for &y in &self.measured[samples] {
            for substep in 0..self.substeps {
                let Some(&[u, next]) = torque.next() else {
                    return;
                };
                if substep == 0 {
                    let all = constants.derivatives(x, u);
                    let r = y - inverse * all.g[MEASURED];
                    visit([r, all.z[DOTS + 2], all.z[DOTS + 1], all.z[DOTS]]);
                }
                x = recursion.step(x, u, next);
            }
        }
        states.x = x;
    }

    /// Puts the next part of what arrives into its lanes.
    #[inline(always)]
    fn place_part(&mut self) {
        let part = self.placed..(self.placed + PART).min(self.measured.len());
        let grid = part.start * self.substeps..part.end * self.substeps + 1;
        for (lane, record) in &self.arriving {
            place(
                self.zero,
                &mut self.measured,
                *lane,
                &record.measured,
                &part,
            );
            place(
                self.zero,
                &mut self.torque_nm,
                *lane,
                &record.torque_nm,
                &grid,
            );
        }
        self.placed = part.end;
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

/// Samples that are looked at together. What is done with them, in a loop of its own, finds them in the nearest cache; in
/// one loop with the recursion, whose constants fill the registers, it would go through memory for every sample.
pub(crate) const BLOCK: usize = 32;

/// Samples of a signal that are put into its lane before other signals have their turn: enough to read a signal in long
/// stretches, few enough for the registers still to be in the nearest cache when the sweep comes to them.
const PART: usize = 64;

/// Puts part of a signal into its lane.
///
/// Whole registers are read, changed and written: what is read streams ahead into the nearest cache, where the store of a
/// single number would have to wait for its line.
#[inline(always)]
fn place<R: Real>(
    zero: R,
    side_by_side: &mut [R],
    lane: usize,
    signal: &[f64],
    part: &Range<usize>,
) {
    let (own, values) = (
        zero.only(lane),
        signal.get(part.start..).unwrap_or_default(),
    );
    for (point, &value) in side_by_side[part.clone()].iter_mut().zip(values) {
        *point = R::choose(own, zero.constant(value), *point);
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

/// One run that keeps every sample.
struct Course<'a, 'r, R> {
    sweep: &'a mut Sweep<'r, R>,
    values: &'a [[f64; 3]],
    residual: &'a mut [R],
    rows: &'a mut [[R; 3]],
}

impl<R: Real> Task for Course<'_, '_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        match self.sweep.quantity {
            Quantity::Displacement => self.keep::<0>(),
            Quantity::Velocity => self.keep::<1>(),
            Quantity::Acceleration => self.keep::<ACCELERATION>(),
        }
    }
}

/// The acceleration is the second derivative.
const ACCELERATION: usize = 2;

impl<R: Real> Course<'_, '_, R> {
    #[inline(always)]
    fn keep<const DOTS: usize>(self) {
        let mut states = self.sweep.begin(self.values);
        let inverse = states.constants.inverse();
        let factor = inverse * inverse * self.sweep.each(|lane| lane.square_m2);
        let kept = (self.residual.chunks_mut(BLOCK)).zip(self.rows.chunks_mut(BLOCK));
        for (block, (residual, rows)) in kept.enumerate() {
            let begin = block * BLOCK;
            let samples = begin..begin + rows.len();
            let mut kept = residual.iter_mut().zip(rows);
            self.sweep.walk::<ACCELERATION, DOTS>(
                &mut states,
                samples,
                #[inline(always)]
                |[r, m, c, k]| {
                    if let Some((residual, row)) = kept.next() {
                        *residual = r;
                        *row = [factor * m, factor * c, factor * k];
                    }
                },
            );
        }
    }
}
