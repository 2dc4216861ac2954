//! What acts along a motion that is given, not simulated: T − l F, which accelerates I_n + m l² (inverse dynamics).
//!
//! Every law is asked through the same hooks as in a simulation, so that an effect's share of the equation of motion comes of its
//! own definition. Its own states follow the motion by Heun's rule, one step per grid point of the input.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::layout::MAXIMUM_OWN_STATES;
use crate::assembly::model::Model;
use crate::error::ModelError;
use crate::input::torque::Input;
use crate::law::Instant;
use crate::simulate::acting_torque::ActingTorque;
use crate::simulate::hook_set::HookSet;
use crate::simulate::plant::{Plant, own_states};
use crate::simulate::run::check_length;

/// Any mass: what acts does not depend on it.
const SOME_MASS_KG: f64 = 1.0;

/// A motion, known at every few samples.
#[derive(Debug, Clone, Copy)]
pub struct GivenMotion<'a> {
    /// Samples from one known instant to the next; between them it goes straight.
    pub stride: usize,
    /// Angle there \[rad\].
    pub angle_rad: &'a [f64],
    /// Angular velocity there \[rad/s\].
    pub velocity_rad_per_s: &'a [f64],
}

impl GivenMotion<'_> {
    /// Angle and velocity so many strides after the first sample.
    fn at(&self, strides: f64) -> [f64; 2] {
        let before = (strides as usize).min(self.angle_rad.len() - 1);
        let after = (before + 1).min(self.angle_rad.len() - 1);
        let share = strides - before as f64;
        [self.angle_rad, self.velocity_rad_per_s]
            .map(|signal| signal[before] + share * (signal[after] - signal[before]))
    }
}

impl Model {
    /// T − l F \[Nm\] at every known instant of `motion` with these `values` of all parameters, of which the mass plays no part.
    ///
    /// What sensors add to the motion, and how it begins, is left out: the motion is what it is.
    ///
    /// # Errors
    /// [`ModelError::Length`] where `values` are not one per parameter or the motion is not known as often as its stride says,
    /// and as [`Input::check`].
    pub fn net_torque_along(
        &self,
        values: &[f64],
        input: &Input,
        motion: &GivenMotion<'_>,
    ) -> Result<Vec<f64>, ModelError> {
        self.check_simulation(values, input)?;
        let known = input.samples().div_ceil(motion.stride.max(1));
        check_length("angle_rad", motion.angle_rad, known)?;
        check_length("velocity_rad_per_s", motion.velocity_rad_per_s, known)?;
        let mut p = values.to_vec();
        p[0] = SOME_MASS_KG;
        let assembly = self.assembly();
        let inputs = SimulationInputs::new(0.0, |_| (assembly, input));
        let torque = ActingTorque::new(assembly.parts(), &p, &inputs);
        let hook_set = HookSet::new(assembly.parts(), &p);
        let mut plant = Plant::new(assembly, &p, &inputs, torque.is_known(), hook_set);
        let lever = inputs.lever_arm_m;
        let per_acceleration = (inputs.known_inertia_kg_m2 + SOME_MASS_KG * lever * lever) / lever;
        let grid_stride = motion.stride.max(1) * input.substeps();
        let mut own = OwnStates::new(assembly.own_state_count);
        let mut at = Instant {
            torque_nm: 0.0,
            x_m: 0.0,
            v_m_per_s: 0.0,
            since_onset_s: 0.0,
            lever_arm_m: lever,
        };
        let mut net_nm = Vec::with_capacity(known);
        for point in 0..inputs.torque_nm().len() {
            let [angle, velocity] = motion.at(point as f64 / grid_stride as f64);
            (at.x_m, at.v_m_per_s) = (lever * angle, lever * velocity);
            plant.note(at.x_m, at.v_m_per_s);
            let is_known = point % grid_stride == 0;
            if point == 0 {
                own.at = own_states(assembly.parts(), &p, &at);
            }
            if is_known || own.count > 0 {
                plant.drive(&mut at, point as f64, torque.at(point));
                let acceleration = own.follow(&plant, point, &at, inputs.interval_s);
                net_nm.extend(is_known.then_some(per_acceleration * acceleration));
            }
        }
        Ok(net_nm)
    }
}

/// The effects' own states on their way along the motion.
struct OwnStates {
    count: usize,
    at: [f64; MAXIMUM_OWN_STATES],
    rates: [f64; MAXIMUM_OWN_STATES],
}

impl OwnStates {
    fn new(count: usize) -> Self {
        Self {
            count: count.min(MAXIMUM_OWN_STATES),
            at: [0.0; MAXIMUM_OWN_STATES],
            rates: [0.0; MAXIMUM_OWN_STATES],
        }
    }

    /// dv/dt \[m/s²\] at the next grid point, up to which the states were stepped ahead with the rates before; that is mended by
    /// the rates found there (Heun), and they are stepped ahead to the next.
    fn follow(
        &mut self,
        plant: &Plant<'_, f64>,
        point: usize,
        at: &Instant<f64>,
        interval_s: f64,
    ) -> f64 {
        let (count, position) = (self.count, point as f64);
        let before = self.rates;
        let rates = |own: &[f64], into: &mut [f64]| plant.rates(position, at, &own[..count], into);
        let mut acceleration = rates(&self.at, &mut self.rates[..count]);
        if count > 0 && point > 0 {
            for ((own, rate), before) in self.at.iter_mut().zip(self.rates).zip(before) {
                *own += 0.5 * interval_s * (rate - before);
            }
            acceleration = rates(&self.at, &mut self.rates[..count]);
        }
        for (own, rate) in self.at.iter_mut().zip(self.rates) {
            *own += interval_s * rate;
        }
        acceleration
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::effects::Effect;
    use snug_campaign::{Intersample, Rig};

    const RIG: Rig = Rig {
        lever_arm_m: 0.5,
        known_inertia_kg_m2: 0.3,
    };
    const INTERVAL_S: f64 = 1e-3;

    /// sin(3 t) rad, known at every `stride`-th of so many samples, and what acts along it.
    fn along(model: &Model, values: &[f64], torque_nm: &[f64], stride: usize) -> Vec<f64> {
        let input = Input::new(torque_nm, INTERVAL_S, Intersample::Linear);
        let times = (0..torque_nm.len()).step_by(stride);
        let times: Vec<f64> = times.map(|index| index as f64 * INTERVAL_S).collect();
        let angle_rad: Vec<f64> = times.iter().map(|t| (3.0 * t).sin()).collect();
        let velocity: Vec<f64> = times.iter().map(|t| 3.0 * (3.0 * t).cos()).collect();
        let motion = GivenMotion {
            stride,
            angle_rad: &angle_rad,
            velocity_rad_per_s: &velocity,
        };
        model.net_torque_along(values, &input, &motion).unwrap()
    }

    /// T − l (k x + c v + k3 x³) with x = l θ, by hand.
    #[test]
    fn a_law_of_the_motion_acts_as_it_is_written() {
        let model = Model::new(RIG, &[Effect::CubicStiffness]).unwrap();
        let torque_nm: Vec<f64> = (0..101).map(|index| 0.1 * f64::from(index)).collect();
        let found = along(&model, &[7.0, 4.0, 50.0, 900.0], &torque_nm, 20);
        assert_eq!(found.len(), 6);
        for (index, net_nm) in found.iter().enumerate() {
            let t = index as f64 * 0.02;
            let (x, v) = (0.5 * (3.0 * t).sin(), 1.5 * (3.0 * t).cos());
            let expected = torque_nm[20 * index] - 0.5 * (50.0 * x + 4.0 * v + 900.0 * x.powi(3));
            assert!((net_nm - expected).abs() < 1e-9, "{net_nm} for {expected}");
        }
    }

    /// A Maxwell branch of k, τ along x = X sin ω t that began at rest: its force is that of F' + F/τ = k v, by hand
    /// F = k X ω τ/(1 + ω²τ²) (cos ω t + ω τ sin ω t − e^(−t/τ)).
    #[test]
    fn states_of_a_law_follow_the_motion() {
        let model = Model::new(RIG, &[Effect::MaxwellBranch]).unwrap();
        let torque_nm = vec![0.0; 1001];
        let (k, tau) = (200.0, 0.05);
        for stride in [1, 10] {
            let found = along(&model, &[1.0, 0.0, 0.0, k, tau], &torque_nm, stride);
            for (index, net_nm) in found.iter().enumerate() {
                let t = (index * stride) as f64 * INTERVAL_S;
                let (wt, w_tau) = (3.0 * t, 3.0 * tau);
                let force = k * 0.5 * w_tau / (1.0 + w_tau * w_tau)
                    * (wt.cos() + w_tau * wt.sin() - (-t / tau).exp());
                assert!((net_nm + 0.5 * force).abs() < 2e-3, "{net_nm} at {t} s");
            }
        }
    }

    #[test]
    fn a_motion_that_is_not_as_long_as_the_input_is_refused() {
        let model = Model::new(RIG, &[]).unwrap();
        let input = Input::new(&[0.0; 10], INTERVAL_S, Intersample::Linear);
        let motion = GivenMotion {
            stride: 3,
            angle_rad: &[0.0; 3],
            velocity_rad_per_s: &[0.0; 3],
        };
        let refused = model.net_torque_along(&[1.0, 0.0, 0.0], &input, &motion);
        assert!(matches!(
            refused,
            Err(ModelError::Length {
                expected: 4,
                found: 3,
                ..
            })
        ));
    }
}
