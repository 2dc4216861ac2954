//! The equations of motion: tool, hand and arm with everything that effects add, evaluated at one stage of a step.

use crate::assembly::inputs::SimulationInputs;
use crate::assembly::layout::{Assembly, MAXIMUM_OWN_STATES, Part};
use crate::law::{Deflection, Delayed, Instant, Law};
use crate::numeric::lanewise::{Lanewise, Task};
use crate::numeric::number::{Number, OfOne};
use crate::simulate::dry_friction::Slowed;
use crate::simulate::history::History;
use crate::simulate::hook_set::HookSet;

/// Tool, hand and arm of one simulation: the equations of motion with everything that stays the same worked out once.
///
/// The motion is that of the grip, x = l θ and v = l ω, which is what the laws are written in.
pub struct Plant<'a, N: Number> {
    inputs: &'a SimulationInputs<'a, N::Real>,
    damping_kg_per_s: OfOne<N::Real>,
    stiffness_n_per_m: OfOne<N::Real>,
    /// l / (I_n + m l²).
    mobility: OfOne<N::Real>,
    /// −l² / (I_n + m l²).
    lever_mobility: OfOne<N::Real>,
    hook_set: HookSet<'a, N>,
    delayed: Vec<Delayed<N>>,
    /// Kept only where a delayed law looks back.
    history: History<N>,
    /// Whether the torque depends on no parameter.
    is_torque_known: bool,
}

/// Columns of the partial derivatives that [`Plant`] knows by number: m, c and k come first.
const MASS: usize = 0;
const DAMPING: usize = 1;
const STIFFNESS: usize = 2;

impl<'a, N: Number> Plant<'a, N> {
    /// The assembly with parameters `p` on a bench, its effects acting as the `hook_set` says.
    #[inline(always)]
    pub fn new(
        assembly: &'a Assembly,
        p: &'a [N],
        inputs: &'a SimulationInputs<'a, N::Real>,
        is_torque_known: bool,
        hook_set: HookSet<'a, N>,
    ) -> Self {
        let parts = assembly.parts();
        let lever = inputs.lever_arm_m;
        let inertia = p[0].times(lever * lever).plus(inputs.known_inertia_kg_m2);
        let mobility = N::from(lever) / inertia;
        let mut delayed = Vec::new();
        for part in parts {
            delayed.extend(part.effect.delayed(&p[part.parameters.clone()]));
        }
        let notes = match delayed.is_empty() {
            true => 0,
            false => inputs.torque_nm().len(),
        };
        Self {
            inputs,
            damping_kg_per_s: p[1].of_one::<DAMPING>(),
            stiffness_n_per_m: p[2].of_one::<STIFFNESS>(),
            mobility: mobility.of_one::<MASS>(),
            lever_mobility: mobility.times(-lever).of_one::<MASS>(),
            is_torque_known: is_torque_known && hook_set.torque.is_empty(),
            hook_set,
            delayed,
            history: History::new(inputs.interval_s, notes),
        }
    }

    /// Notes the motion at the next grid point, for laws that look back.
    #[inline(always)]
    pub fn note(&mut self, x_m: N, v_m_per_s: N) {
        if !self.delayed.is_empty() {
            self.history.note(x_m, v_m_per_s);
        }
    }

    /// Sets of the instant what does not follow from the motion: the time, `position` grid intervals after the first
    /// sample, and the torque, with what effects add to it.
    #[inline(always)]
    pub fn drive(&self, at: &mut Instant<N>, position: f64, torque_nm: N) {
        at.since_onset_s = (self.inputs).since_onset_s(self.inputs.interval_s * position);
        at.torque_nm = torque_nm;
        if !self.hook_set.torque.is_empty() {
            let mut whole = torque_nm;
            for hooked in &self.hook_set.torque {
                hooked.ask(
                    #[inline(always)]
                    |law, p, _| {
                        if let Some(more) = law.torque(p, at) {
                            whole += more;
                        }
                    },
                );
            }
            at.torque_nm = whole;
        }
    }

    /// dv/dt \[m/s²\], and the rates of the effects' `own` states.
    #[inline(always)]
    pub fn rates(&self, position: f64, at: &Instant<N>, own: &[N], own_rates: &mut [N]) -> N {
        let hand_n = self.hand_force(at, own);
        for hooked in &self.hook_set.rates {
            hooked.ask(
                #[inline(always)]
                |law, p, states| {
                    law.rates(p, at, &own[states.clone()], hand_n, &mut own_rates[states]);
                },
            );
        }
        let mut force = hand_n;
        for hooked in &self.hook_set.force {
            hooked.ask(
                #[inline(always)]
                |law, p, states| {
                    if let Some(more) = law.force(p, at, &own[states]) {
                        force += more;
                    }
                },
            );
        }
        let time_s = self.inputs.interval_s * position;
        for spring in &self.delayed {
            force += spring.stiffness_n_per_m * self.history.x_m(time_s, spring.delay_s);
        }
        for hooked in &self.hook_set.limit {
            hooked.ask(
                #[inline(always)]
                |law, p, _| {
                    if let Some(passed_on) = law.limit(p, force) {
                        force = passed_on;
                    }
                },
            );
        }
        // dv/dt = l (T − l F) / (I_n + m l²).
        let by_force = force.times_one::<MASS>(self.lever_mobility);
        if self.is_torque_known {
            by_force.plus_one::<MASS>(self.mobility.times(at.torque_nm.value()))
        } else {
            by_force + at.torque_nm.times_one::<MASS>(self.mobility)
        }
    }

    /// Whether anything holds as dry friction does.
    #[inline(always)]
    pub fn has_dry_friction(&self) -> bool {
        !self.hook_set.dry_friction_n.is_empty()
    }

    /// By how much what dry friction holds with would slow it \[m/s²\]. Out of line: a step asks thrice, and every law of the catalogue is worked
    /// out in it.
    #[inline(never)]
    pub fn held(&self, at: &Instant<N>) -> N {
        at.lever_arm_m.vectorize(Held { plant: self, at })
    }

    /// What dry friction makes of a step that begins `at` an instant. All else pushes it with `at_first_m_per_s2`, which foresees where it slides
    /// on, and with `on_average_m_per_s2` once that was `foreseen` and the step made with it. What it holds with goes with the speed, and is that
    /// half way.
    #[inline(always)]
    pub fn slowed(
        &self,
        at: &Instant<N>,
        at_first_m_per_s2: N,
        on_average_m_per_s2: N,
        foreseen: Option<Slowed<N>>,
    ) -> Slowed<N> {
        match foreseen {
            None => self.slowed_by(at, at_first_m_per_s2).foreseen(),
            Some(foreseen) => foreseen.or(self.slowed_by(at, on_average_m_per_s2)),
        }
    }

    #[inline(always)]
    fn slowed_by(&self, at: &Instant<N>, pushed_m_per_s2: N) -> Slowed<N> {
        let (v, h_s) = (at.v_m_per_s, self.inputs.interval_s);
        let at_first = Slowed::over(v, pushed_m_per_s2, self.held(at), h_s);
        let mut half_way = *at;
        half_way.v_m_per_s = (v + at_first.ends_m_per_s) * 0.5;
        Slowed::over(v, pushed_m_per_s2, self.held(&half_way), h_s)
    }

    /// What the hand's spring and damper exert \[N\]: k (1 + Σ stiffening) d + c dd/dt.
    #[inline(always)]
    fn hand_force(&self, at: &Instant<N>, own: &[N]) -> N {
        let hooks = &self.hook_set;
        if hooks.support.is_empty() && hooks.deflection.is_empty() && hooks.stiffening.is_empty() {
            return self.spring_and_damper(at.x_m, at.v_m_per_s);
        }
        let mut seen = Deflection {
            x_m: at.x_m,
            v_m_per_s: at.v_m_per_s,
        };
        for hooked in &hooks.support {
            hooked.ask(
                #[inline(always)]
                |law, p, states| {
                    if let Some(support) = law.support(p, &own[states]) {
                        seen.x_m = seen.x_m - support.x_m;
                        seen.v_m_per_s = seen.v_m_per_s - support.v_m_per_s;
                    }
                },
            );
        }
        for hooked in &hooks.deflection {
            hooked.ask(
                #[inline(always)]
                |law, p, _| {
                    if let Some(left) = law.deflection(p, seen, &self.inputs.corner) {
                        seen = left;
                    }
                },
            );
        }
        let mut stretched = seen.x_m;
        for hooked in &hooks.stiffening {
            hooked.ask(
                #[inline(always)]
                |law, p, _| {
                    if let Some(growth) = law.stiffening(p, at) {
                        stretched += growth * seen.x_m;
                    }
                },
            );
        }
        self.spring_and_damper(stretched, seen.v_m_per_s)
    }

    #[inline(always)]
    fn spring_and_damper(&self, x_m: N, v_m_per_s: N) -> N {
        x_m.times_one::<STIFFNESS>(self.stiffness_n_per_m)
            + v_m_per_s.times_one::<DAMPING>(self.damping_kg_per_s)
    }
}

/// What dry friction holds with at an instant.
struct Held<'a, 'p, N: Number> {
    plant: &'a Plant<'p, N>,
    at: &'a Instant<N>,
}

impl<N: Number> Task for Held<'_, '_, N> {
    type Output = N;
    #[inline(always)]
    fn run(self) -> N {
        let Self { plant, at } = self;
        let mut force = at.x_m.constant(0.0);
        for hooked in &plant.hook_set.dry_friction_n {
            hooked.ask(
                #[inline(always)]
                |law, p, _| {
                    if let Some(more) = law.dry_friction_n(p, at) {
                        force += more;
                    }
                },
            );
        }
        -force.times_one::<MASS>(plant.lever_mobility)
    }
}

/// The effects' own states as the motion begins with the instant `at`.
#[inline(never)]
pub fn own_states<N: Number>(parts: &[Part], p: &[N], at: &Instant<N>) -> [N; MAXIMUM_OWN_STATES] {
    let mut own = [at.x_m.constant(0.0); MAXIMUM_OWN_STATES];
    for part in parts.iter().filter(|part| part.answered.begins) {
        let begun = &mut own[part.states.clone()];
        part.effect.begins(&p[part.parameters.clone()], at, begun);
    }
    own
}

/// The effects' initial angle \[rad\] and angular velocity \[rad/s\]; at rest without them.
#[inline(always)]
pub fn initial_motion<N: Number>(parts: &[Part], p: &[N]) -> [N; 2] {
    let mut motion = [p[0].constant(0.0); 2];
    for part in parts {
        if let Some((angle, velocity)) = part.effect.initial(&p[part.parameters.clone()]) {
            motion[0] += angle;
            motion[1] += velocity;
        }
    }
    motion
}
