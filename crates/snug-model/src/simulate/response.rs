//! An assembly's answer to the torque: exact where the motion is the base model's, by Runge–Kutta where it is not, as its
//! sensors show it.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::layout::Assembly;
use crate::base_model::exact;
use crate::base_model::exact::{Oscillator, Response};
use crate::law::Kinematics;
use crate::numeric::lanewise::{Lanewise, Task};
use crate::numeric::number::{Number, Real};
use crate::simulate::acting_torque::ActingTorque;
use crate::simulate::runge_kutta;
use crate::simulate::sensors::{Moment, Sensors};
use crate::simulate::zeroed::Zeroed;

impl Assembly {
    /// The base model's constants of motion, for parameters that begin with m, c, k.
    #[inline(always)]
    pub(crate) fn oscillator<R: Real>(
        values: &[R],
        inputs: &SimulationInputs<'_, R>,
    ) -> Oscillator<R> {
        let square = inputs.lever_arm_m * inputs.lever_arm_m;
        Oscillator {
            inertia_kg_m2: values[0] * square + inputs.known_inertia_kg_m2,
            damping_nm_s_per_rad: values[1] * square,
            stiffness_nm_per_rad: values[2] * square,
        }
    }

    /// Simulates and hands every sample's measured motion to `sample`.
    pub(crate) fn respond<N: Number>(
        &self,
        p: &[N],
        inputs: &SimulationInputs<'_, N::Real>,
        sample: impl FnMut(usize, &Kinematics<N>),
    ) {
        debug_assert_eq!(p.len(), self.parameter_count);
        let acting_torque = &ActingTorque::new(&self.parts, p, inputs);
        let prepared = Prepared {
            assembly: self,
            p,
            inputs,
            acting_torque,
            sample,
        };
        let zero = inputs.zero;
        if self.moves_as_base() && !inputs.is_restarted() {
            return zero.vectorize(Exact(prepared));
        }
        zero.vectorize(Stepped(prepared))
    }
}

/// One simulation, ready to run.
struct Prepared<'a, N: Number, F> {
    assembly: &'a Assembly,
    p: &'a [N],
    inputs: &'a SimulationInputs<'a, N::Real>,
    acting_torque: &'a ActingTorque<'a, N>,
    sample: F,
}

impl<'a, N: Number, F: FnMut(usize, &Kinematics<N>)> Prepared<'a, N, F> {
    /// What is done with the true motion of every sample: the sensors see it, and `sample` gets what they show.
    #[inline(always)]
    fn seen(self) -> impl FnMut(usize, &Moment<'_, N>) + use<'a, N, F> {
        let Self {
            assembly,
            p,
            inputs,
            acting_torque,
            mut sample,
        } = self;
        let mut sensors = Sensors::new(assembly, p, inputs, acting_torque);
        let mut zeroed = sensors.are_heard().then(|| Zeroed::new(inputs)).flatten();
        #[inline(always)]
        move |index, moment: &Moment<'_, N>| {
            let seen = sensors.sample(index, moment);
            match &mut zeroed {
                Some(zeroed) => zeroed.sample(index, seen, &mut sample),
                None => sample(index, &seen),
            }
        }
    }
}

/// The true motion by the exact recursion: it is the base model's.
struct Exact<'a, N: Number, F>(Prepared<'a, N, F>);

impl<N: Number, F: FnMut(usize, &Kinematics<N>)> Task for Exact<'_, N, F> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (p, inputs) = (self.0.p, self.0.inputs);
        let values = [p[0].value(), p[1].value(), p[2].value()];
        let square = inputs.lever_arm_m * inputs.lever_arm_m;
        // m, c, k enter through I, C, K, each times l².
        let base = [p[0].times(square), p[1].times(square), p[2].times(square)];
        let mut seen = self.0.seen();
        exact::respond(
            &Assembly::oscillator(&values, inputs),
            inputs,
            #[inline(always)]
            |index, response| {
                let motion = with_slopes(response, &base);
                let (own, own_rates) = (&[][..], &[][..]);
                seen(
                    index,
                    &Moment {
                        motion,
                        own,
                        own_rates,
                    },
                );
            },
        );
    }
}

/// The true motion by Runge–Kutta.
struct Stepped<'a, N: Number, F>(Prepared<'a, N, F>);

impl<N: Number, F: FnMut(usize, &Kinematics<N>)> Task for Stepped<'_, N, F> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (assembly, p) = (self.0.assembly, self.0.p);
        let (inputs, acting_torque) = (self.0.inputs, self.0.acting_torque);
        let seen = self.0.seen();
        runge_kutta::respond::<N>(assembly, p, inputs, acting_torque, seen);
    }
}

/// The exact recursion's response, which depends on I, C, K.
#[inline(always)]
fn with_slopes<N: Number>(response: &Response<N::Real>, base: &[N; 3]) -> Kinematics<N> {
    let (motion, slopes) = (&response.motion, &response.sensitivity);
    Kinematics {
        displacement_rad: N::chain_of(base, motion[0], &slopes[0]),
        velocity_rad_per_s: N::chain_of(base, motion[1], &slopes[1]),
        acceleration_rad_per_s2: N::chain_of(base, motion[2], &slopes[2]),
    }
}
