//! Any assembly's response by the classical Runge–Kutta method, one step per grid point of the input.
//!
//! At 10 kHz the error of a step is (h ω)⁵/120 ≈ 1e−15 of the amplitude for an arm at 30 rad/s; a band-limited input
//! brings its own finer grid.

use crate::effect::{Instant, Kinematics, Law};
use crate::model::{Assembly, MAXIMUM_STATES};
use crate::{Input, Number};

/// Simulates from rest (or the effects' initial motion) and hands every sample's measured motion to `sample`.
///
/// `p` are all parameters of the assembly in its order.
pub fn respond<N: Number>(
    assembly: &Assembly,
    p: &[N],
    input: &Input,
    mut sample: impl FnMut(usize, &Kinematics<N>),
) {
    let h = input.grid_interval_s();
    let mut state = assembly.initial_state(p);
    let points = input.grid().len();
    let mut torque = assembly.acting_torque(p, input, 0);
    let mut index = 0;
    for point in 0..points {
        if point == index * input.substeps() {
            let motion = assembly.motion(p, torque, &state);
            sample(
                index,
                &assembly.measured(p, input.since_rest_s(index), motion),
            );
            index += 1;
        }
        if point + 1 < points {
            let next = assembly.acting_torque(p, input, point + 1);
            let (middle, end) = if input.held() {
                (torque, torque)
            } else {
                ((torque + next) * 0.5, next)
            };
            step(assembly, p, [torque, middle, end], h, &mut state);
            torque = next;
        }
    }
}

/// One step of length `h` under the torques at its start, middle and end.
#[inline(always)]
fn step<N: Number>(
    assembly: &Assembly,
    p: &[N],
    [start, middle, end]: [N; 3],
    h: f64,
    state: &mut [N; MAXIMUM_STATES],
) {
    let active = assembly.state_count();
    let along = |rates: &[N; MAXIMUM_STATES], length: f64| {
        let mut moved = *state;
        for (value, rate) in moved.iter_mut().zip(rates).take(active) {
            *value += *rate * length;
        }
        moved
    };
    let k1 = assembly.rates(p, start, state);
    let k2 = assembly.rates(p, middle, &along(&k1, 0.5 * h));
    let k3 = assembly.rates(p, middle, &along(&k2, 0.5 * h));
    let k4 = assembly.rates(p, end, &along(&k3, h));
    for i in 0..active {
        state[i] += (k1[i] + (k2[i] + k3[i]) * 2.0 + k4[i]) * (h / 6.0);
    }
}

impl Assembly {
    fn initial_state<N: Number>(&self, p: &[N]) -> [N; MAXIMUM_STATES] {
        let mut state = [N::from(0.0); MAXIMUM_STATES];
        for part in self.parts() {
            let (angle, velocity) = part.effect.initial(&p[part.parameters.clone()]);
            state[0] += angle;
            state[1] += velocity;
        }
        state
    }

    fn acting_torque<N: Number>(&self, p: &[N], input: &Input, point: usize) -> N {
        let mut torque = N::from(input.grid()[point]);
        let time_s = point as f64 * input.grid_interval_s();
        for part in self.parts() {
            torque += part
                .effect
                .torque(&p[part.parameters.clone()], input, time_s);
        }
        torque
    }

    fn instant<N: Number>(&self, torque: N, state: &[N; MAXIMUM_STATES]) -> Instant<N> {
        let lever = self.rig().lever_arm_m;
        Instant {
            torque_nm: torque,
            x_m: state[0] * lever,
            v_m_per_s: state[1] * lever,
        }
    }

    /// dω/dt = (T − l F) / (I_n + m l²).
    fn acceleration<N: Number>(&self, p: &[N], at: &Instant<N>, state: &[N; MAXIMUM_STATES]) -> N {
        let rig = self.rig();
        let mut force = p[2] * at.x_m + p[1] * at.v_m_per_s;
        for part in self.parts() {
            force +=
                part.effect
                    .force(&p[part.parameters.clone()], at, &state[part.states.clone()]);
        }
        let inertia = p[0] * (rig.lever_arm_m * rig.lever_arm_m) + rig.known_inertia_kg_m2;
        (at.torque_nm - force * rig.lever_arm_m) / inertia
    }

    fn rates<N: Number>(
        &self,
        p: &[N],
        torque: N,
        state: &[N; MAXIMUM_STATES],
    ) -> [N; MAXIMUM_STATES] {
        let at = self.instant(torque, state);
        let mut rates = [N::from(0.0); MAXIMUM_STATES];
        rates[0] = state[1];
        rates[1] = self.acceleration(p, &at, state);
        for part in self.parts() {
            part.effect.rates(
                &p[part.parameters.clone()],
                &at,
                &state[part.states.clone()],
                &mut rates[part.states.clone()],
            );
        }
        rates
    }

    fn motion<N: Number>(&self, p: &[N], torque: N, state: &[N; MAXIMUM_STATES]) -> Kinematics<N> {
        let at = self.instant(torque, state);
        Kinematics {
            displacement_rad: state[0],
            velocity_rad_per_s: state[1],
            acceleration_rad_per_s2: self.acceleration(p, &at, state),
        }
    }
}
