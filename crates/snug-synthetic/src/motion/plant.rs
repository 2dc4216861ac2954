//! Tool, hand and arm with the hidden laws, as a system of first-order differential equations for `trajectory.rs`.

use crate::motion::history::History;
use crate::motion::pulse::Pulse;
use crate::motion::pulse::smooth_step;
use crate::plan::effects::HiddenEffect::{
    AccelerationLag, Backlash, BoucWen, CoContraction, CoulombFriction, CubicDamping,
    CubicStiffness, DirectionalDamping, EndStop, ExponentialStiffness, GripSlip, InitialMotion,
    MaxwellBranch, PositionFriction, QuadraticDamping, QuadraticStiffness, QuinticStiffness,
    SecondMass, StretchReflex, StribeckFriction, TorqueDelay, TorqueDependentStiffness, TorqueLag,
    TorqueRipple, VoluntaryPush, X2vDamping, XvDamping,
};
use crate::plan::effects::{HiddenEffect, Law};
use crate::plan::population::HandArm;
use std::f64::consts::TAU;

/// Number of states of a [`Plant`].
pub(crate) const STATES: usize = 8;
/// θ \[rad\].
pub(crate) const THETA: usize = 0;
/// ω \[rad/s\].
pub(crate) const OMEGA: usize = 1;
/// Force of a Maxwell branch \[N\].
pub(crate) const MAXWELL: usize = 2;
/// Hysteretic displacement \[m\].
pub(crate) const HYSTERESIS: usize = 3;
/// Displacement of the second mass \[m\].
pub(crate) const SUPPORT_X: usize = 4;
/// Velocity of the second mass \[m/s\].
pub(crate) const SUPPORT_V: usize = 5;
/// Torque behind the torque sensor's lag \[Nm\].
pub(crate) const LAGGED_TORQUE: usize = 6;
/// Acceleration behind the accelerometer's lag \[rad/s²\].
pub(crate) const LAGGED_ACCELERATION: usize = 7;

/// All states at one instant.
pub(crate) type State = [f64; STATES];

/// An instant and the torque that acts then: worked out once for all that asks for it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Now {
    /// Time since the window's start \[s\].
    pub(crate) time_s: f64,
    /// Acting torque \[Nm\].
    pub(crate) torque_nm: f64,
}

/// Tool, hand and arm of one tightening, with whatever laws it hides.
///
/// ```text
/// x = l θ,  v = l ω
/// F = k x + c v + Σ laws
/// (I_n + m l²) dω/dt = T − l F
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// l, joint axis to grip, as it truly is \[m\].
    pub lever_arm_m: f64,
    /// I_n, the tool's inertia about the joint \[kg m²\].
    pub known_inertia_kg_m2: f64,
    /// m, c, k.
    pub hand_arm: HandArm,
    /// Pulses that follow each other; their sum is the torque in the log's clock. Usually one.
    pub pulses: Vec<Pulse>,
    /// Hidden laws.
    pub laws: Vec<Law>,
}

impl Plant {
    /// I_n + m l² \[kg m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        self.known_inertia_kg_m2 + self.hand_arm.mass_kg * self.lever_arm_m * self.lever_arm_m
    }

    /// Torque in the log's clock, `time_s` after the window's start \[Nm\].
    pub fn log_torque_nm(&self, time_s: f64) -> f64 {
        self.pulses.iter().map(|pulse| pulse.at(time_s)).sum()
    }

    /// Torque that acts on the joint \[Nm\].
    pub fn acting_torque_nm(&self, time_s: f64) -> f64 {
        self.log_torque_nm(time_s - self.torque_delay_s())
    }

    /// Time since the first pulse's torque began \[s\]: what muscles count from.
    fn since_onset_s(&self, now: Now) -> f64 {
        now.time_s - self.onset_s()
    }

    fn onset_s(&self) -> f64 {
        self.pulses.first().map_or(0.0, |pulse| pulse.start_s)
    }

    pub(crate) fn now(&self, time_s: f64) -> Now {
        Now {
            time_s,
            torque_nm: self.acting_torque_nm(time_s),
        }
    }

    /// d: how much earlier torque is logged than it acts \[s\].
    pub(crate) fn torque_delay_s(&self) -> f64 {
        self.numbers_of(TorqueDelay).map_or(0.0, |delay| delay[0])
    }

    /// θ0, ω0 that are there when the window starts.
    pub(crate) fn initial_motion(&self) -> Option<(f64, f64)> {
        let motion = self.numbers_of(InitialMotion)?;
        Some((motion[0], motion[1]))
    }

    /// The numbers of a hidden effect; `None` where it is not hidden here.
    pub(crate) fn numbers_of(&self, effect: HiddenEffect) -> Option<&[f64]> {
        let law = self.laws.iter().find(|law| law.effect == effect)?;
        Some(&law.numbers)
    }

    /// Instants at which a derivative of the right-hand side jumps, in order \[s\].
    pub(crate) fn knots_s(&self) -> Vec<f64> {
        let delay_s = self.torque_delay_s();
        let mut knots = vec![0.0];
        for pulse in &self.pulses {
            knots.extend(pulse.knots_s());
            knots.extend(pulse.knots_s().map(|knot| knot + delay_s));
        }
        for law in &self.laws {
            if let (VoluntaryPush | CoContraction, [_, onset_s, rise_s]) = law.parts() {
                knots.extend([*onset_s, onset_s + rise_s].map(|knot| knot + self.onset_s()));
            }
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        knots
    }

    /// Force between tool and hand \[N\].
    fn hand_force_n(&self, now: Now, state: &State, past: &History) -> f64 {
        let mut force = self.base_force_n(now, state);
        for law in &self.laws {
            force += self.added_force_n(law, now, state, past);
        }
        for law in &self.laws {
            if let (GripSlip, [f_max]) = law.parts() {
                force = f_max * (force / f_max).tanh();
            }
        }
        force
    }

    /// What a law adds to the force of spring and damper \[N\].
    fn added_force_n(&self, law: &Law, now: Now, state: &State, past: &History) -> f64 {
        let x = self.lever_arm_m * state[THETA];
        let v = self.lever_arm_m * state[OMEGA];
        match law.parts() {
            (CubicStiffness, [k3]) => k3 * x * x * x,
            (QuadraticStiffness, [k2]) => k2 * x * x,
            (CoulombFriction, [fc, v_s]) => fc * (v / v_s).tanh(),
            (QuadraticDamping, [c2]) => c2 * v * v.abs(),
            (DirectionalDamping, [c_r]) => c_r * v.min(0.0),
            (MaxwellBranch, _) => state[MAXWELL],
            (BoucWen, [k_h, _]) => k_h * state[HYSTERESIS],
            (StretchReflex, [k_r, tau_s]) => {
                k_r * (self.lever_arm_m * past.theta_rad(now.time_s - tau_s))
            }
            (VoluntaryPush, [f_v, onset_s, rise_s]) => {
                f_v * smooth_step((self.since_onset_s(now) - onset_s) / rise_s)
            }
            (X2vDamping, [d]) => d * x * x * v,
            (XvDamping, [d]) => d * x * v,
            (PositionFriction, [mu, v_s]) => mu * x.abs() * (v / v_s).tanh(),
            (CubicDamping, [d]) => d * v * v * v,
            (QuinticStiffness, [k5]) => k5 * x.powi(5),
            (ExponentialStiffness, [f0, x0]) => f0 * (x.abs() / x0).exp_m1() * x.signum(),
            (StribeckFriction, [fc, fs, v_1, v_s]) => {
                (fc + (fs - fc) * (-(v / v_1).powi(2)).exp()) * (v / v_s).tanh()
            }
            (TorqueRipple, [a_s, a_c, wavelength]) => {
                let phase = TAU * x / wavelength;
                a_s * phase.sin() + a_c * (phase.cos() - 1.0)
            }
            (EndStop, [k_s, x_s]) => k_s * (x - x_s).max(0.0),
            _ => 0.0,
        }
    }

    /// Rates of all states.
    pub(crate) fn rates(&self, now: Now, state: &State, past: &History) -> State {
        let acceleration = self.acceleration_rad_per_s2(now, state, past);
        let v = self.lever_arm_m * state[OMEGA];
        let mut rates = [0.0; STATES];
        rates[THETA] = state[OMEGA];
        rates[OMEGA] = acceleration;
        for law in &self.laws {
            match law.parts() {
                (MaxwellBranch, [k_m, tau_s]) => {
                    rates[MAXWELL] = k_m * v - state[MAXWELL] / tau_s;
                }
                (BoucWen, [_, z_max]) => {
                    let z = state[HYSTERESIS];
                    let loading = if v * z > 0.0 { 1.0 } else { 0.0 };
                    rates[HYSTERESIS] = v * (1.0 - loading * z.abs() / z_max);
                }
                (SecondMass, [m2, k2, c2]) => {
                    rates[SUPPORT_X] = state[SUPPORT_V];
                    rates[SUPPORT_V] = (self.base_force_n(now, state)
                        - k2 * state[SUPPORT_X]
                        - c2 * state[SUPPORT_V])
                        / m2;
                }
                (TorqueLag, [tau_s]) => {
                    rates[LAGGED_TORQUE] =
                        (self.log_torque_nm(now.time_s) - state[LAGGED_TORQUE]) / tau_s;
                }
                (AccelerationLag, [tau_s]) => {
                    rates[LAGGED_ACCELERATION] =
                        (acceleration - state[LAGGED_ACCELERATION]) / tau_s;
                }
                _ => {}
            }
        }
        rates
    }

    /// α = (T − l F) / (I_n + m l²) \[rad/s²\].
    pub(crate) fn acceleration_rad_per_s2(&self, now: Now, state: &State, past: &History) -> f64 {
        let force = self.hand_force_n(now, state, past);
        (now.torque_nm - self.lever_arm_m * force) / self.inertia_kg_m2()
    }

    /// What spring and damper give, with everything that changes *them* rather than adding to them.
    fn base_force_n(&self, now: Now, state: &State) -> f64 {
        let mut x = self.lever_arm_m * state[THETA] - state[SUPPORT_X];
        let v = self.lever_arm_m * state[OMEGA] - state[SUPPORT_V];
        let mut growth = 0.0;
        let mut touching = 1.0;
        for law in &self.laws {
            match law.parts() {
                (CoContraction, [ratio, onset_s, rise_s]) => {
                    growth += ratio * smooth_step((self.since_onset_s(now) - onset_s) / rise_s);
                }
                (TorqueDependentStiffness, [kappa]) => growth += kappa * now.torque_nm.abs(),
                (Backlash, [gap]) => {
                    touching = if x.abs() > *gap { 1.0 } else { 0.0 };
                    x -= x.clamp(-gap, *gap);
                }
                _ => {}
            }
        }
        let spring = self.hand_arm.stiffness_n_per_m * (1.0 + growth) * x;
        spring + touching * self.hand_arm.damping_kg_per_s * v
    }
}
