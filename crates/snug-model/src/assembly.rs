use crate::dual::Dual;
use crate::effect::{Kinematics, Law};
use crate::linear::{self, Oscillator, Response};
use crate::sensors::Sensors;
use crate::zeroed::Zeroed;
use crate::{Effect, Input, Number, runge_kutta};
use snug_campaign::{Quantity, Rig};
use std::ops::Range;

/// θ, ω and up to four states of effects.
pub(crate) const MAXIMUM_STATES: usize = 6;

/// One effect's place in an assembly.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub effect: Effect,
    pub parameters: Range<usize>,
    pub states: Range<usize>,
}

/// The base model with its effects, laid out.
#[derive(Debug, Clone)]
pub struct Assembly {
    pub(crate) rig: Rig,
    pub(crate) parts: Vec<Part>,
    pub(crate) parameter_count: usize,
    pub(crate) state_count: usize,
}

impl Assembly {
    pub(crate) fn rig(&self) -> &Rig {
        &self.rig
    }

    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// No effect at all: the fast exact path without dual numbers applies.
    pub(crate) fn is_base(&self) -> bool {
        self.parts.is_empty()
    }

    /// The motion itself is the base model's, whatever the sensors add.
    fn moves_as_base(&self) -> bool {
        self.parts.iter().all(|part| part.effect.measurement_only())
    }

    fn oscillator(&self, values: &[f64]) -> Oscillator {
        let square = self.rig.lever_arm_m * self.rig.lever_arm_m;
        Oscillator {
            inertia_kg_m2: self.rig.known_inertia_kg_m2 + values[0] * square,
            damping_nm_s_per_rad: values[1] * square,
            stiffness_nm_per_rad: values[2] * square,
        }
    }

    /// Simulates and hands every sample's measured motion to `sample`.
    pub(crate) fn respond<N: Number + FromResponse>(
        &self,
        p: &[N],
        input: &Input,
        mut sample: impl FnMut(usize, &Kinematics<N>),
    ) {
        let mut sensors = Sensors::new(self, p, input);
        match input.zero_at() {
            Some(zero_at) if sensors.are_heard() => {
                let mut zeroed = Zeroed::new(zero_at);
                self.move_tool(p, input, |index, motion| {
                    let seen = sensors.sample(index, motion);
                    zeroed.sample(index, seen, &mut sample);
                });
            }
            _ => self.move_tool(p, input, |index, motion| {
                sample(index, &sensors.sample(index, motion));
            }),
        }
    }

    /// The true motion: by the exact recursion where it is the base model's, else by Runge–Kutta.
    fn move_tool<N: Number + FromResponse>(
        &self,
        p: &[N],
        input: &Input,
        mut sample: impl FnMut(usize, Kinematics<N>),
    ) {
        if !self.moves_as_base() || input.is_restarted() {
            return match self.state_count {
                2 => runge_kutta::respond::<N, 2>(self, p, input, sample),
                3 => runge_kutta::respond::<N, 3>(self, p, input, sample),
                4 => runge_kutta::respond::<N, 4>(self, p, input, sample),
                _ => runge_kutta::respond::<N, MAXIMUM_STATES>(self, p, input, sample),
            };
        }
        let values: Vec<f64> = p.iter().map(|number| number.value()).collect();
        let square = self.rig.lever_arm_m * self.rig.lever_arm_m;
        // m, c, k enter through I, C, K, each times l².
        let base = [p[0] * square, p[1] * square, p[2] * square];
        linear::respond(&self.oscillator(&values), input, |index, response| {
            sample(index, N::from_response(response, &base));
        });
    }

    /// The exact recursion's own sensitivities, without dual numbers.
    pub(crate) fn base_sensitivities(
        &self,
        values: &[f64],
        free: &[usize],
        input: &Input,
        quantity: Quantity,
        output: &mut [f64],
        sensitivity: &mut [f64],
    ) {
        let (row, samples) = (quantity as usize, input.samples());
        let square = self.rig.lever_arm_m * self.rig.lever_arm_m;
        linear::respond(&self.oscillator(values), input, |index, response| {
            output[index] = response.motion[row];
            for (column, &parameter) in free.iter().enumerate() {
                sensitivity[column * samples + index] =
                    square * response.sensitivity[row][parameter];
            }
        });
    }

    /// Forward differentiation with `P` partial derivatives carried along.
    pub(crate) fn carry<const P: usize>(
        &self,
        values: &[f64],
        free: &[usize],
        input: &Input,
        quantity: Quantity,
        output: &mut [f64],
        sensitivity: &mut [f64],
    ) {
        let mut p: Vec<Dual<P>> = values.iter().map(|&value| Dual::from(value)).collect();
        for (column, &parameter) in free.iter().enumerate() {
            p[parameter] = Dual::parameter(values[parameter], column);
        }
        let samples = input.samples();
        debug_assert_eq!(p.len(), self.parameter_count);
        self.respond(&p, input, |index, motion| {
            let number = select(motion, quantity);
            output[index] = number.value;
            for column in 0..free.len() {
                sensitivity[column * samples + index] = number.partials[column];
            }
        });
    }
}

/// A number that can be made from the exact recursion's response and its dependence on I, C, K.
pub(crate) trait FromResponse: Sized {
    fn from_response(response: &Response, base: &[Self; 3]) -> Kinematics<Self>;
}

impl FromResponse for f64 {
    #[inline(always)]
    fn from_response(response: &Response, _base: &[Self; 3]) -> Kinematics<Self> {
        let [
            displacement_rad,
            velocity_rad_per_s,
            acceleration_rad_per_s2,
        ] = response.motion;
        Kinematics {
            displacement_rad,
            velocity_rad_per_s,
            acceleration_rad_per_s2,
        }
    }
}

impl<const P: usize> FromResponse for Dual<P> {
    #[inline(always)]
    fn from_response(response: &Response, base: &[Self; 3]) -> Kinematics<Self> {
        let quantity = |row: usize| {
            let slopes = &response.sensitivity[row];
            Self {
                value: response.motion[row],
                partials: std::array::from_fn(|j| {
                    (0..3).map(|i| slopes[i] * base[i].partials[j]).sum()
                }),
            }
        };
        Kinematics {
            displacement_rad: quantity(0),
            velocity_rad_per_s: quantity(1),
            acceleration_rad_per_s2: quantity(2),
        }
    }
}

pub(crate) fn select<N: Number>(motion: &Kinematics<N>, quantity: Quantity) -> N {
    match quantity {
        Quantity::Displacement => motion.displacement_rad,
        Quantity::Velocity => motion.velocity_rad_per_s,
        Quantity::Acceleration => motion.acceleration_rad_per_s2,
    }
}
