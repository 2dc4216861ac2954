use crate::acting_torque::{ActingTorque, with_added_torque};
use crate::assembly::{Assembly, Part};
use crate::effect::{Deflection, Delayed, Instant, Kinematics, Law};
use crate::history::History;
use crate::{Input, Number};

/// Tool, hand and arm of one simulation: the equations of motion with everything that stays the same worked out once.
pub struct Plant<'a, N> {
    parts: &'a [Part],
    p: &'a [N],
    input: &'a Input,
    lever_arm_m: f64,
    damping_kg_per_s: N,
    stiffness_n_per_m: N,
    /// 1 / (I_n + m l²).
    mobility: N,
    /// −l / (I_n + m l²).
    lever_mobility: N,
    acting_torque: ActingTorque<'a, N>,
    /// Whether an effect adds to the torque.
    adds_torque: bool,
    delayed: Vec<Delayed<N>>,
    /// Kept only where a delayed law looks back.
    history: History<N>,
}

/// What drives the motion from outside at one instant, whatever the state then.
pub struct Drive<N> {
    torque_nm: N,
    since_onset_s: f64,
    /// Force of the springs that act on the past \[N\].
    delayed_n: Option<N>,
}

impl<'a, N: Number> Plant<'a, N> {
    /// The assembly with parameters `p` under `input`.
    pub fn new(assembly: &'a Assembly, p: &'a [N], input: &'a Input) -> Self {
        let (rig, parts) = (assembly.rig(), assembly.parts());
        let lever = rig.lever_arm_m;
        let mobility = N::from(1.0) / (p[0] * (lever * lever) + rig.known_inertia_kg_m2);
        let own = |part: &Part| &p[part.parameters.clone()];
        Self {
            parts,
            p,
            input,
            lever_arm_m: lever,
            damping_kg_per_s: p[1],
            stiffness_n_per_m: p[2],
            mobility,
            lever_mobility: mobility * -lever,
            acting_torque: ActingTorque::new(parts, p, input),
            adds_torque: parts.iter().any(|part| part.effect.adds_torque()),
            delayed: parts
                .iter()
                .filter_map(|part| part.effect.delayed(own(part)))
                .collect(),
            history: History::new(input.grid_interval_s()),
        }
    }

    /// The effects' initial motion; all else at rest.
    pub fn initial_state<const S: usize>(&self) -> [N; S] {
        let mut state = [N::from(0.0); S];
        for part in self.parts {
            let (angle, velocity) = part.effect.initial(self.own(part));
            state[0] += angle;
            state[1] += velocity;
        }
        state
    }

    /// Torque that acts at a grid point \[Nm\].
    #[inline(always)]
    pub fn acting_torque(&self, point: usize) -> N {
        self.acting_torque.at(point)
    }

    /// Notes the motion at the next grid point, for laws that look back.
    #[inline(always)]
    pub fn note<const S: usize>(&mut self, state: &[N; S]) {
        if !self.delayed.is_empty() {
            self.history
                .note(state[0] * self.lever_arm_m, state[1] * self.lever_arm_m);
        }
    }

    /// What drives the motion `position` grid intervals after the first sample, under torque `torque_nm`.
    #[inline(always)]
    pub fn drive(&self, position: f64, torque_nm: N) -> Drive<N> {
        let time_s = position * self.input.grid_interval_s();
        let delayed_n = self
            .delayed
            .iter()
            .map(|spring| spring.stiffness_n_per_m * self.history.x_m(time_s, spring.delay_s))
            .reduce(|sum, more| sum + more);
        Drive {
            torque_nm,
            since_onset_s: time_s - self.input.onset_s(),
            delayed_n,
        }
    }

    /// Rates of all states.
    #[inline(always)]
    pub fn rates<const S: usize>(&self, drive: &Drive<N>, state: &[N; S]) -> [N; S] {
        let at = self.instant(drive, state);
        let hand_n = self.hand_force(&at, state);
        let mut rates = [N::from(0.0); S];
        rates[0] = state[1];
        rates[1] = self.acceleration(drive, &at, hand_n, state);
        if S > 2 {
            for part in self.parts {
                let (own, own_rates) =
                    (&state[part.states.clone()], &mut rates[part.states.clone()]);
                part.effect
                    .rates(self.own(part), &at, own, hand_n, own_rates);
            }
        }
        rates
    }

    /// The true motion.
    pub fn motion<const S: usize>(&self, drive: &Drive<N>, state: &[N; S]) -> Kinematics<N> {
        let at = self.instant(drive, state);
        let hand_n = self.hand_force(&at, state);
        Kinematics {
            displacement_rad: state[0],
            velocity_rad_per_s: state[1],
            acceleration_rad_per_s2: self.acceleration(drive, &at, hand_n, state),
        }
    }

    #[inline(always)]
    fn own(&self, part: &Part) -> &[N] {
        &self.p[part.parameters.clone()]
    }

    #[inline(always)]
    fn instant(&self, drive: &Drive<N>, state: &[N]) -> Instant<N> {
        let at = Instant {
            torque_nm: drive.torque_nm,
            x_m: state[0] * self.lever_arm_m,
            v_m_per_s: state[1] * self.lever_arm_m,
            since_onset_s: drive.since_onset_s,
            lever_arm_m: self.lever_arm_m,
        };
        if self.adds_torque {
            with_added_torque(self.parts, self.p, at)
        } else {
            at
        }
    }

    /// What the hand's spring and damper exert \[N\]: k (1 + Σ stiffening) d + c dd/dt.
    #[inline(always)]
    fn hand_force(&self, at: &Instant<N>, state: &[N]) -> N {
        let mut seen = Deflection {
            x_m: at.x_m,
            v_m_per_s: at.v_m_per_s,
        };
        for part in self.parts {
            if let Some(support) = part
                .effect
                .support(self.own(part), &state[part.states.clone()])
            {
                seen.x_m = seen.x_m - support.x_m;
                seen.v_m_per_s = seen.v_m_per_s - support.v_m_per_s;
            }
        }
        let mut stiffness = self.stiffness_n_per_m;
        for part in self.parts {
            seen = part.effect.deflection(self.own(part), seen);
            if let Some(growth) = part.effect.stiffening(self.own(part), at) {
                stiffness += self.stiffness_n_per_m * growth;
            }
        }
        stiffness * seen.x_m + self.damping_kg_per_s * seen.v_m_per_s
    }

    /// dω/dt = (T − l F) / (I_n + m l²).
    #[inline(always)]
    fn acceleration(&self, drive: &Drive<N>, at: &Instant<N>, hand_n: N, state: &[N]) -> N {
        let mut force = hand_n;
        for part in self.parts {
            force += part
                .effect
                .force(self.own(part), at, &state[part.states.clone()]);
        }
        if let Some(delayed) = drive.delayed_n {
            force += delayed;
        }
        for part in self.parts {
            force = part.effect.limit(self.own(part), force);
        }
        at.torque_nm * self.mobility + force * self.lever_mobility
    }
}
