//! Runs many simulations at once, each in its own lane of a vector register, with as many derivatives as are asked for.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::layout::{Assembly, BASE_PARAMETERS, MAXIMUM_FREE};
use crate::assembly::model::Model;
use crate::base_model::exact;
use crate::error::ModelError;
use crate::input::torque::Input;
use crate::law::Kinematics;
use crate::numeric::dual::Dual;
use crate::numeric::lanewise::Task;
use crate::numeric::number::{Number, Real};
use crate::numeric::simd::{LaneTask, in_lanes};
use crate::simulate::record::Record;
use crate::simulate::run::Run;
use snug_campaign::Quantity;

/// The measured quantity of every run and its sensitivities to the parameters number `free`.
///
/// As many runs as the processor's vector registers have lanes cost little more than one; runs with another quantity, other
/// effects or other behaviour of the input between samples than their neighbours wait for their own turn. A run has the same bits
/// whatever stands beside it.
///
/// # Errors
/// [`ModelError::Length`] where values, output or sensitivity of a run are not as long as its model and its input ask for,
/// [`ModelError::ParameterIndex`] or [`ModelError::TooManyFree`] for `free`, and as [`Input::check`]. Nothing is simulated then.
pub fn simulate_side_by_side(runs: &mut [Run<'_>], free: &[usize]) -> Result<(), ModelError> {
    if free.len() > MAXIMUM_FREE {
        return Err(ModelError::TooManyFree {
            free: free.len(),
            maximum: MAXIMUM_FREE,
        });
    }
    runs.iter().try_for_each(|run| run.check(free))?;
    for group in runs.chunk_by_mut(Run::is_alike) {
        in_lanes(Together { runs: group, free });
    }
    Ok(())
}

/// Runs from which side by side they take less time than one after the other; where there are fewer lanes, as many as those.
const FEWEST: usize = 3;

/// Runs that are all alike.
struct Together<'a, 'r> {
    runs: &'a mut [Run<'r>],
    free: &'a [usize],
}

impl LaneTask for Together<'_, '_> {
    type Output = ();
    fn run<R: Real>(self, zero: R) {
        for runs in self.runs.chunks_mut(R::LANES) {
            if runs.len() < FEWEST.min(R::LANES) {
                let free = self.free;
                Together { runs, free }.run(0.0);
                continue;
            }
            let side: Vec<(&Model, &Input, &[f64])> = (runs.iter())
                .map(|run| (run.model, run.input, run.values))
                .collect();
            // Lanes that are left over do the last run's work again.
            let of = |lane: usize| side[lane.min(side.len() - 1)];
            let inputs = SimulationInputs::new(zero, |lane| (of(lane).0.assembly(), of(lane).1));
            let values: Vec<R> = (0..side[0].2.len())
                .map(|index| zero.lane_by_lane(|lane| of(lane).2[index]))
                .collect();
            Group {
                quantity: runs[0].quantity,
                runs,
                free: self.free,
                assembly: side[0].0.assembly(),
                inputs: &inputs,
                values: &values,
            }
            .simulate();
        }
    }
}

/// As many runs as there are lanes, or fewer.
struct Group<'a, 'r, R: Real> {
    runs: &'a mut [Run<'r>],
    free: &'a [usize],
    quantity: Quantity,
    assembly: &'a Assembly,
    inputs: &'a SimulationInputs<'a, R>,
    values: &'a [R],
}

impl<R: Real> Group<'_, '_, R> {
    fn simulate(self) {
        if self.free.is_empty() {
            return self.plain();
        }
        if self.assembly.is_base() && !self.inputs.is_restarted() {
            return self.inputs.zero.vectorize(self);
        }
        let of_effects = self
            .free
            .iter()
            .filter(|&&index| index >= BASE_PARAMETERS.len());
        match BASE_PARAMETERS.len() + of_effects.count() {
            0..=4 => self.carry::<4>(),
            5 => self.carry::<5>(),
            6 => self.carry::<6>(),
            7 | 8 => self.carry::<8>(),
            _ => self.carry::<MAXIMUM_FREE>(),
        }
    }

    /// Without sensitivities.
    fn plain(self) {
        let (quantity, runs) = (self.quantity, self.runs);
        let mut record = Record::new(runs, 0, self.inputs.zero);
        self.assembly.respond(
            self.values,
            self.inputs,
            #[inline(always)]
            |_, motion| {
                record.next_row()[0] = select(motion, quantity);
                record.keep_row();
            },
        );
        record.write();
    }

    /// Forward differentiation with `P` partial derivatives carried along: those to m, c, k, then those asked for.
    fn carry<const P: usize>(self) {
        let mut p: Vec<Dual<P, R>> = self.values.iter().map(|&value| value.into()).collect();
        let columns = columns(self.free);
        for (&column, &parameter) in columns.iter().zip(self.free) {
            p[parameter] = Dual::parameter(self.values[parameter], column);
        }
        let (quantity, runs) = (self.quantity, self.runs);
        let mut record = Record::new(runs, columns.len(), self.inputs.zero);
        self.assembly.respond(
            &p,
            self.inputs,
            #[inline(always)]
            |_, motion| {
                let number = select(motion, quantity);
                let row = record.next_row();
                row[0] = number.value;
                for (slope, &column) in row[1..].iter_mut().zip(&columns) {
                    *slope = number.partials[column];
                }
                record.keep_row();
            },
        );
        record.write();
    }
}

/// Where the derivative to each free parameter is carried; the first places are those of m, c, k.
fn columns(free: &[usize]) -> Vec<usize> {
    let mut next = BASE_PARAMETERS.len();
    let column = |&parameter: &usize| {
        if parameter < BASE_PARAMETERS.len() {
            return parameter;
        }
        next += 1;
        next - 1
    };
    free.iter().map(column).collect()
}

/// The exact recursion's own sensitivities, without dual numbers.
impl<R: Real> Task for Group<'_, '_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (inputs, row) = (self.inputs, self.quantity as usize);
        let square = inputs.lever_arm_m * inputs.lever_arm_m;
        let mut record = Record::new(self.runs, self.free.len(), inputs.zero);
        exact::respond(
            &Assembly::oscillator(self.values, inputs),
            inputs,
            #[inline(always)]
            |_, response| {
                let kept = record.next_row();
                kept[0] = response.motion[row];
                for (slope, &parameter) in kept[1..].iter_mut().zip(self.free) {
                    *slope = square * response.sensitivity[row][parameter];
                }
                record.keep_row();
            },
        );
        record.write();
    }
}

#[inline(always)]
fn select<N: Number>(motion: &Kinematics<N>, quantity: Quantity) -> N {
    match quantity {
        Quantity::Displacement => motion.displacement_rad,
        Quantity::Velocity => motion.velocity_rad_per_s,
        Quantity::Acceleration => motion.acceleration_rad_per_s2,
    }
}
