//! Tool, hand and arm with the hidden laws, as a system of first-order differential equations for `trajectory.rs`.

use crate::effects::{Law, MeasurementLaw, MechanicalLaw};
use crate::history::History;
use crate::{HandArm, Pulse};

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
        self.measurement_laws()
            .find_map(|law| match law {
                MeasurementLaw::TorqueDelay { delay_s } => Some(delay_s),
                _ => None,
            })
            .unwrap_or(0.0)
    }

    /// θ0, ω0 that are there when the window starts.
    pub(crate) fn initial_motion(&self) -> Option<(f64, f64)> {
        self.measurement_laws().find_map(|law| match law {
            MeasurementLaw::InitialMotion {
                theta0_rad,
                omega0_rad_per_s,
            } => Some((theta0_rad, omega0_rad_per_s)),
            _ => None,
        })
    }

    pub(crate) fn measurement_laws(&self) -> impl Iterator<Item = MeasurementLaw> + '_ {
        self.laws.iter().filter_map(|law| match law {
            Law::Measurement(law) => Some(*law),
            _ => None,
        })
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
            if let Law::Muscular(law) = law {
                let knots_s = law.knots_s().into_iter().flatten();
                knots.extend(knots_s.map(|knot| knot + self.onset_s()));
            }
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        knots
    }

    /// Force between tool and hand \[N\].
    fn hand_force_n(&self, now: Now, state: &State, past: &History) -> f64 {
        let x = self.lever_arm_m * state[THETA];
        let v = self.lever_arm_m * state[OMEGA];
        let mut force = self.base_force_n(now, state);
        for law in &self.laws {
            force += match law {
                Law::Mechanical(law) => {
                    let branch = match law {
                        MechanicalLaw::MaxwellBranch { .. } => state[MAXWELL],
                        MechanicalLaw::BoucWen { .. } => state[HYSTERESIS],
                        _ => 0.0,
                    };
                    law.added_force_n(x, v, branch)
                }
                Law::Muscular(law) => law.added_force_n(self.since_onset_s(now), |delay_s| {
                    self.lever_arm_m * past.theta_rad(now.time_s - delay_s)
                }),
                Law::Unlisted(law) => law.added_force_n(x, v),
                Law::Measurement(_) | Law::Trend(_) => 0.0,
            };
        }
        for law in &self.laws {
            if let Law::Mechanical(MechanicalLaw::GripSlip { f_max_n }) = law {
                force = f_max_n * (force / f_max_n).tanh();
            }
        }
        force
    }

    /// Rates of all states.
    pub(crate) fn rates(&self, now: Now, state: &State, past: &History) -> State {
        let acceleration = self.acceleration_rad_per_s2(now, state, past);
        let v = self.lever_arm_m * state[OMEGA];
        let mut rates = [0.0; STATES];
        rates[THETA] = state[OMEGA];
        rates[OMEGA] = acceleration;
        for law in &self.laws {
            match *law {
                Law::Mechanical(law @ MechanicalLaw::MaxwellBranch { .. }) => {
                    rates[MAXWELL] = law.branch_rate(v, state[MAXWELL]);
                }
                Law::Mechanical(law @ MechanicalLaw::BoucWen { .. }) => {
                    rates[HYSTERESIS] = law.branch_rate(v, state[HYSTERESIS]);
                }
                Law::Mechanical(MechanicalLaw::SecondMass {
                    m2_kg,
                    k2_n_per_m,
                    c2_kg_per_s,
                }) => {
                    rates[SUPPORT_X] = state[SUPPORT_V];
                    rates[SUPPORT_V] = (self.base_force_n(now, state)
                        - k2_n_per_m * state[SUPPORT_X]
                        - c2_kg_per_s * state[SUPPORT_V])
                        / m2_kg;
                }
                Law::Measurement(MeasurementLaw::TorqueLag { tau_s }) => {
                    rates[LAGGED_TORQUE] =
                        (self.log_torque_nm(now.time_s) - state[LAGGED_TORQUE]) / tau_s;
                }
                Law::Measurement(MeasurementLaw::AccelerationLag { tau_s }) => {
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
            match law {
                Law::Muscular(law) => {
                    growth += law.stiffness_growth_ratio(self.since_onset_s(now), now.torque_nm);
                }
                Law::Mechanical(MechanicalLaw::Backlash { gap_m }) => {
                    touching = if x.abs() > *gap_m { 1.0 } else { 0.0 };
                    x -= x.clamp(-gap_m, *gap_m);
                }
                _ => {}
            }
        }
        let spring = self.hand_arm.stiffness_n_per_m * (1.0 + growth) * x;
        spring + touching * self.hand_arm.damping_kg_per_s * v
    }
}
