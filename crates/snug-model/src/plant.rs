use crate::acting::{Acting, Hook};
use crate::acting_torque::ActingTorque;
use crate::assembly::{Assembly, Part};
use crate::effect::{Deflection, Delayed, Instant, Law};
use crate::history::History;
use crate::{Input, Number};

/// Tool, hand and arm of one simulation: the equations of motion with everything that stays the same worked out once.
pub struct Plant<'a, N> {
    input: &'a Input,
    lever_arm_m: f64,
    damping_kg_per_s: N,
    stiffness_n_per_m: N,
    /// 1 / (I_n + m l²).
    mobility: N,
    /// −l / (I_n + m l²).
    lever_mobility: N,
    acting_torque: ActingTorque<'a, N>,
    acting: Acting<'a, N>,
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
            input,
            lever_arm_m: lever,
            damping_kg_per_s: p[1],
            stiffness_n_per_m: p[2],
            mobility,
            lever_mobility: mobility * -lever,
            acting_torque: ActingTorque::new(parts, p, input),
            acting: Acting::new(parts, p),
            delayed: parts
                .iter()
                .filter_map(|part| part.effect.delayed(own(part)))
                .collect(),
            history: History::new(input.grid_interval_s()),
        }
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
        let at = self.instant(drive, state[0], state[1]);
        // Effects look up their own states by number: in a copy, so that the motion itself can stay in registers.
        let kept = *state;
        let hand_n = self.hand_force(&at, &kept);
        let acceleration = self.acceleration(drive, &at, hand_n, &kept);
        let mut rates = [N::from(0.0); S];
        if S > 2 {
            for actor in self.acting.on(Hook::Moving) {
                let (own, own_rates) = (actor.own(&kept), actor.own_mut(&mut rates));
                actor.law.rates(actor.p, &at, own, hand_n, own_rates);
            }
        }
        rates[0] = state[1];
        rates[1] = acceleration;
        rates
    }

    #[inline(always)]
    fn instant(&self, drive: &Drive<N>, angle_rad: N, velocity_rad_per_s: N) -> Instant<N> {
        let mut at = Instant {
            torque_nm: drive.torque_nm,
            x_m: angle_rad * self.lever_arm_m,
            v_m_per_s: velocity_rad_per_s * self.lever_arm_m,
            since_onset_s: drive.since_onset_s,
            lever_arm_m: self.lever_arm_m,
        };
        let mut torque_nm = at.torque_nm;
        for actor in self.acting.on(Hook::Torque) {
            if let Some(added) = actor.law.torque(actor.p, &at) {
                torque_nm += added;
            }
        }
        at.torque_nm = torque_nm;
        at
    }

    /// What the hand's spring and damper exert \[N\]: k (1 + Σ stiffening) d + c dd/dt.
    #[inline(always)]
    fn hand_force<const S: usize>(&self, at: &Instant<N>, state: &[N; S]) -> N {
        let mut seen = Deflection {
            x_m: at.x_m,
            v_m_per_s: at.v_m_per_s,
        };
        for actor in self.acting.on(Hook::Support) {
            if let Some(support) = actor.law.support(actor.p, actor.own(state)) {
                seen.x_m = seen.x_m - support.x_m;
                seen.v_m_per_s = seen.v_m_per_s - support.v_m_per_s;
            }
        }
        for actor in self.acting.on(Hook::Deflection) {
            seen = actor.law.deflection(actor.p, seen).unwrap_or(seen);
        }
        let mut stiffness = self.stiffness_n_per_m;
        for actor in self.acting.on(Hook::Stiffening) {
            if let Some(growth) = actor.law.stiffening(actor.p, at) {
                stiffness += self.stiffness_n_per_m * growth;
            }
        }
        stiffness * seen.x_m + self.damping_kg_per_s * seen.v_m_per_s
    }

    /// dω/dt = (T − l F) / (I_n + m l²).
    #[inline(always)]
    fn acceleration<const S: usize>(
        &self,
        drive: &Drive<N>,
        at: &Instant<N>,
        hand_n: N,
        state: &[N; S],
    ) -> N {
        let mut force = hand_n;
        for actor in self.acting.on(Hook::Force) {
            if let Some(more) = actor.law.force(actor.p, at, actor.own(state)) {
                force += more;
            }
        }
        if let Some(delayed) = drive.delayed_n {
            force += delayed;
        }
        for actor in self.acting.on(Hook::Limit) {
            force = actor.law.limit(actor.p, force).unwrap_or(force);
        }
        at.torque_nm * self.mobility + force * self.lever_mobility
    }
}

/// The effects' initial motion; all else at rest.
pub fn initial_state<N: Number, const S: usize>(parts: &[Part], p: &[N]) -> [N; S] {
    let mut state = [N::from(0.0); S];
    for part in parts {
        let (angle, velocity) = part.effect.initial(&p[part.parameters.clone()]);
        state[0] += angle;
        state[1] += velocity;
    }
    state
}
